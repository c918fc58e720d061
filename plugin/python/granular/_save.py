# SPDX-License-Identifier: BSD-3-Clause
"""Files of any name."""
import os

# Which writer has names of which endings; all others are those of dumps.
_WRITERS = {".bonds": "GranularLocalWriter",
            ".decomposition": "GranularDecompositionWriter",
            ".euler": "GranularEulerWriter",
            ".vtk": "GranularDecompositionWriter",
            ".vtu": "GranularDecompositionWriter"}


def save(proxy, path, time=None, writer=None, **properties):
    """Writes what a source or filter shows as a particle dump, as a dump of contacts or bonds, as a decomposition or as
    Euler cells, whatever the name of the file.

    proxy       a source or filter of paraview.simple, or one of its output ports
    path        the file to write; `*` stands for the timestep. Of dumps `%` stands for the process, and they are
                compressed where the name ends in .gz or .zst; those of particles are binary where it ends in .bin
                or .lammpsbin.
    time        the time to write. None: the one that proxy was last updated or shown with, or, if it
                never was, its first; the animation's time counts for what is shown only.
    writer      GranularDumpWriter, GranularLocalWriter, GranularDecompositionWriter or GranularEulerWriter. None: by
                the name, the second where it ends in .bonds, the third in .decomposition, .vtk or .vtu, the last in
                .euler, else the first.
    properties  of the writer's proxy: WriteTimeSteps, Dialect, Style, Label, Columns, NumberFormat, ...

    SaveData does the same for names that end in .dump, .lammpstrj, .bin, .lammpsbin, .gz, .zst, .bonds, .decomposition
    or .euler, but says nothing when it fails. Raises AttributeError for a property, or a writer, that there is not,
    RuntimeError if the file could not be written: what was wrong is in the messages of ParaView.
    """
    from paraview import servermanager

    path = os.fspath(path)
    if time is not None:
        getattr(proxy, "Proxy", proxy).UpdatePipeline(time)  # of an output port its proxy
    ending = os.path.splitext(path)[1]
    kind = getattr(servermanager.writers, writer or _WRITERS.get(ending, "GranularDumpWriter"))
    written = kind(Input=proxy, FileName=path)
    for name, value in properties.items():
        words = name == "Columns" and not isinstance(value, str)
        setattr(written, name, " ".join(value) if words else value)
    written.UpdateVTKObjects()
    written.UpdatePipeline()
    written.UpdatePropertyInformation()
    if not written.GetPropertyValue("Written"):
        raise RuntimeError(f"{path} could not be written: see the messages above")
