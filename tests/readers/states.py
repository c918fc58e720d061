# SPDX-License-Identifier: BSD-3-Clause
"""A state file that an earlier build has saved opens with all that was set in it."""
import os
import shutil

from paraview.simple import GetSources

import vtkgranular as vg

DATA = os.environ["GRANULAR_DATA"]
SET = {
    "GranularDumpReader": ("good/grains.bin", {
        "TimestepSize": 2e-5, "ColumnNames": "id type x y z ix iy iz vx vy vz radius", "RepeatedSteps": "Last", "Coordinates": "Unwrapped",
        "PointOrigin": [1, 2, 3], "SortById": 1, "Stride": 3, "RegionOfInterest": [0, 1, 1, -1, 0, 2], "PointPrecision": "Single",
        "Vertices": "None", "Threads": 2, "RefreshOnUpdate": 1, "PointArrayStatus": ["id"]}),
    "GranularLocalReader": ("good/local/contacts.dump", {
        "TimestepSize": 3e-5, "Preset": "AsNamed", "ColumnMap": "x1 y1 z1 x2 y2 z2 id1 id2 periodic forcex forcey forcez",
        "PeriodicLines": "AsWritten", "PointOrigin": [1, 0, 0], "CellArrayStatus": ["id1"]}),
    "GranularRestartReader": ("good/restart/fibres.restart", {
        "HistoryLayout": "Numbered", "PeriodicLines": "Split", "PointOrigin": [0, 1, 0], "PointArrayStatus": ["id"], "CellArrayStatus": ["id2"]}),
    "GranularDataFileReader": ("good/data_file/sphere.data", {
        "AtomStyle": "sphere", "Boundary": "p p f", "Coordinates": "Scaled", "Stride": 2, "SortById": 1, "PeriodicLines": "AsWritten"}),
    "GranularDecompositionReader": ("good/decomposition_1000.vtk", {"TimestepSize": 4e-5}),
    "GranularEulerReader": ("good/euler_1000.vtk", {"TimestepSize": 5e-5}),
}


def main():
    for file, _ in SET.values():
        os.makedirs(os.path.dirname(file), exist_ok=True)
        shutil.copy(os.path.join(DATA, file), file)
    shutil.copy(os.path.join(DATA, "good/states/readers.pvsm"), "readers.pvsm")
    vg.load_state("readers.pvsm")
    loaded = {proxy.GetXMLName(): proxy for proxy in GetSources().values()}
    assert set(loaded) == set(SET), loaded
    for name, (_, properties) in SET.items():
        for key, value in properties.items():
            found = getattr(loaded[name], key)
            assert (list(found) if isinstance(value, list) else found) == value, (name, key, found)
    dump = loaded["GranularDumpReader"]
    dump.UpdatePipeline()
    arrays = dump.GetClientSideObject().GetOutput().GetPointData()
    assert [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())] == ["id"], arrays


if __name__ == "__main__":
    main()
