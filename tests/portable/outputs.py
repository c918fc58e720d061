# SPDX-License-Identifier: BSD-3-Clause
"""Writes what a plugin makes of files: outputs.py PLUGIN FOLDER FILE...

FOLDER/outputs.json has all ports of up to four frames of each file, in each of some settings: points, cells, arrays with their types,
components and ranges, field data, times and choices of arrays. Beside it are files that the writers made of some of them.
"""
import json
import os
import sys

from paraview import servermanager, simple

plugin, folder, *files = sys.argv[1:]
simple.LoadPlugin(plugin)

import vtkgranular as vg  # noqa: E402 (which the plugin brings along)
from told_data import of_data  # noqa: E402
from vtkgranular._options import READERS  # noqa: E402

READER_OF = dict(zip(("dump", "local", "restart", "data", "decomposition", "euler"), READERS)) | {"grid": "GranularEulerReader"}
SETTINGS = {
    "GranularDumpReader": [{}, {"Coordinates": "Unwrapped", "SortById": 1, "PointOrigin": [0.1, 0.2, 0.3]},
                           {"Coordinates": "Scaled", "PointPrecision": "Single", "Vertices": "PolyVertex", "TimestepSize": 2e-5},
                           {"Stride": 3, "RegionOfInterest": [-1e3, 0.05, 1, -1, 1, -1], "Vertices": "None"}],
    "GranularLocalReader": [{}, {"PeriodicLines": "Split", "TimestepSize": 1e-3}, {"PeriodicLines": "AsWritten", "PointOrigin": [1, 2, 3]},
                            {"Preset": "AsNamed"}, {"Preset": "ContactsForce"}],
    "GranularRestartReader": [{}, {"PeriodicLines": "Split"}],
    "GranularDataFileReader": [{}, {"PeriodicLines": "Split", "Stride": 2}, {"Coordinates": "Unwrapped", "SortById": 1}],
    "GranularDecompositionReader": [{}],
    "GranularEulerReader": [{}, {"Output": "Points"}],
}

told = {}
for path in files:
    kind = vg.kind_of(path)
    name = READER_OF.get(kind)
    for settings in SETTINGS.get(name, ()) if name in dir(simple) else ():
        key = f"{path} {settings}"
        reader = getattr(simple, name)(FileNames=[path])
        for prop, value in settings.items():
            setattr(reader, prop, value)
        reader.UpdatePipelineInformation()
        times = list(reader.TimestepValues)
        facts = told[key] = {"times": repr(times), "error": reader.GetPropertyValue("ErrorMessage"), "frames": []}
        algorithm = reader.GetClientSideObject()
        for choice in ("PointArrayStatus", "CellArrayStatus"):
            if reader.SMProxy.GetProperty(choice):
                facts[choice] = repr(list(reader.GetPropertyValue(choice)))
        for time in times[:2] + times[-2:]:
            ports = []
            for port in range(reader.SMProxy.GetNumberOfOutputPorts()):
                reader.UpdatePipeline(time)
                ports.append(of_data(algorithm.GetOutputDataObject(port)))
            facts["frames"].append([time, ports, reader.GetPropertyValue("ErrorMessage")])
        simple.Delete(reader)

# Each writer: the frames of one file, text, packed and binary, and with settings that change the bytes.
WRITTEN = {"GranularDumpReader": [("text.dump", {}), ("packed.dump.gz", {}), ("binary.bin", {}), ("sorted.dump", {"SortById": 1, "NumberFormat": "%g"}),
                                  ("atom.dump", {"Style": "Atom", "Scaled": 0, "Image": 1, "WriteTime": 1})],
           "GranularLocalReader": [("lines.bonds", {}), ("named.bonds", {"Label": "BONDS", "NumberFormat": "shortest"})],
           "GranularEulerReader": [("cells.euler", {}), ("wide_*.euler", {"Dialect": "Wide"})],
           "GranularDecompositionReader": [("voxels_*.vtk", {}), ("public.decomposition", {"Dialect": "PUBLIC"}), ("voxels_*.vtu", {})]}
MOST = 8  # files of each kind that are written
for name, forms in WRITTEN.items():
    for path in [path for path in files if READER_OF.get(vg.kind_of(path)) == name][:MOST]:
        for ending, settings in forms:
            reader = getattr(simple, name)(FileNames=[path])
            target = os.path.join(folder, f"{os.path.basename(path)}.{ending}")
            # not by SaveData, which takes ParaView's writers for some endings
            writer = getattr(servermanager.writers, name.replace("Reader", "Writer"))(Input=servermanager.OutputPort(reader, 0))
            for prop, value in {"WriteTimeSteps": int("*" in ending or ending[-5:] != "euler"), **settings, "FileName": target}.items():
                setattr(writer, prop, value)
            writer.UpdatePipeline()
            writer.UpdatePropertyInformation()
            told[target.replace(folder, "")] = [writer.GetPropertyValue("Written"),
                                                writer.GetPropertyValue("ErrorMessage").replace(folder, "")]
            simple.Delete(reader)

with open(os.path.join(folder, "outputs.json"), "w", encoding="utf-8") as file:
    json.dump(told, file, indent=1, sort_keys=True)
