# SPDX-License-Identifier: BSD-3-Clause
"""Files of any name."""
import os


def save(proxy, path, time=None, **properties):
    """Writes what a source or filter shows as a particle dump, whatever the name of the file.

    proxy       a source or filter of paraview.simple, or one of its output ports
    path        the file to write; `*` stands for the timestep, `%` for the process. Binary where it ends in
                .bin or .lammpsbin, compressed where it ends in .gz or .zst, else text.
    time        the time to write. None: the one that proxy was last updated or shown with, or, if it
                never was, its first; the animation's time counts for what is shown only.
    properties  of the proxy GranularDumpWriter: Style, Dialect, Columns, NumberFormat, WriteTimeSteps, ...

    SaveData does the same for names that end in .dump, .lammpstrj, .bin, .lammpsbin, .gz or .zst, but says
    nothing when it fails. Raises AttributeError for a property that there is not, RuntimeError if the file
    could not be written: what was wrong is in the messages of ParaView.
    """
    from paraview import servermanager

    writer = servermanager.writers.GranularDumpWriter(Input=proxy, FileName=os.fspath(path))
    for name, value in properties.items():
        words = name == "Columns" and not isinstance(value, str)
        setattr(writer, name, " ".join(value) if words else value)
    if time is not None:
        getattr(proxy, "Proxy", proxy).UpdatePipeline(time)  # of an output port its proxy
    writer.UpdateVTKObjects()
    writer.UpdatePipeline()
    writer.UpdatePropertyInformation()
    if not writer.GetPropertyValue("Written"):
        raise RuntimeError(f"{path} could not be written: see the messages above")
