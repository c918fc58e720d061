# SPDX-License-Identifier: BSD-3-Clause
"""What the ranks of a script have together."""
import os

import vtkgranular as vg
from paraview.simple import servermanager
from vtkmodules.vtkIOXML import vtkXMLPImageDataReader, vtkXMLPPolyDataReader, vtkXMLPUnstructuredGridReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController

ranks = vtkMultiProcessController.GetGlobalController()
symmetric = servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
_FILES = {"vtkImageData": (".pvti", vtkXMLPImageDataReader),
          "vtkPolyData": (".pvtp", vtkXMLPPolyDataReader),
          "vtkUnstructuredGrid": (".pvtu", vtkXMLPUnstructuredGridReader)}


def wait():
    """Until all ranks that run the script are here."""
    if symmetric:
        ranks.Barrier()


def whole(proxy, time=None, kind="vtkPolyData"):
    """The data of all ranks, by way of a file that ParaView writes and reads; it keeps the doubles of points."""
    proxy.UpdatePipeline(*([] if time is None else [time]))
    ending, reader = _FILES[kind]
    name = os.path.abspath("whole" + ending)
    vg.save(proxy, name)
    wait()
    file = reader()
    file.SetFileName(name)
    file.Update()
    wait()
    return file.GetOutput()
