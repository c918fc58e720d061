# SPDX-License-Identifier: BSD-3-Clause
"""Files of any name."""
import os

# The writer of data of this class that have these cell arrays, for names with these endings: the first that fits.
_WRITERS = (
    ("GranularDecompositionWriter", "vtkUnstructuredGrid", ("nlocal",), (".vtk", ".vtu")),
    ("GranularDecompositionWriter", "vtkUnstructuredGrid", (), (".decomposition",)),
)
_OTHERWISE = "GranularDumpWriter"


def _choose(proxy, path):
    rows = [row for row in _WRITERS if path.endswith(row[3])]
    if not rows:
        return _OTHERWISE
    if not proxy.GetDataInformation().GetCellDataInformation().GetNumberOfArrays():
        getattr(proxy, "Proxy", proxy).UpdatePipeline()  # of what nobody has looked at yet no arrays are known
    data = proxy.GetDataInformation()
    cells = data.GetCellDataInformation()
    return next((name for name, kind, arrays, _ in rows
                 if data.GetDataClassName() == kind
                 and all(cells.GetArrayInformation(each) for each in arrays)), _OTHERWISE)


def save(proxy, path, time=None, writer=None, **properties):
    """Writes what a source or filter shows as a particle dump, or as a decomposition, whatever the name of the file.

    proxy       a source or filter of paraview.simple, or one of its output ports
    path        the file to write; `*` stands for the timestep. Of dumps `%` stands for the process, and they
                are binary where the name ends in .bin or .lammpsbin, compressed where it ends in .gz or .zst.
    time        the time to write. None: the one that proxy was last updated or shown with, or, if it
                never was, its first; the animation's time counts for what is shown only.
    writer      GranularDumpWriter or GranularDecompositionWriter. None: by what there is to write:

                data                                              name ends in      writer
                an unstructured grid with the cell array nlocal   .vtk .vtu         GranularDecompositionWriter
                an unstructured grid                              .decomposition    GranularDecompositionWriter
                all other                                                           GranularDumpWriter
    properties  of the writer's proxy: WriteTimeSteps, Dialect, Style, Columns, NumberFormat, ...

    SaveData does the same for names that end in .dump, .lammpstrj, .bin, .lammpsbin, .gz, .zst or .decomposition, but
    says nothing when it fails. Raises AttributeError for a property, or a writer, that there is not, RuntimeError if the
    file could not be written: what was wrong is in the messages of ParaView.
    """
    from paraview import servermanager

    path = os.fspath(path)
    if time is not None:
        getattr(proxy, "Proxy", proxy).UpdatePipeline(time)  # of an output port its proxy
    kind = getattr(servermanager.writers, writer or _choose(proxy, path))
    written = kind(Input=proxy, FileName=path)
    for name, value in properties.items():
        words = name == "Columns" and not isinstance(value, str)
        setattr(written, name, " ".join(value) if words else value)
    written.UpdateVTKObjects()
    written.UpdatePipeline()
    written.UpdatePropertyInformation()
    if not written.GetPropertyValue("Written"):
        raise RuntimeError(f"{path} could not be written: see the messages above")
