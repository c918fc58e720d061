// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularKeptPieces_h
#define vtkGranularKeptPieces_h

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace vtkGranularPrivate
{
/**
 * Lets ParaView's ranks keep the pieces that they request, where a reader finds new frames within an update. Call in
 * RequestInformation.
 *
 * UpdatePipeline of ParaView asks for information, sets the piece of the rank, and updates, which asks for information
 * again. If a file has changed in between, information is made anew, and VTK then sets the request to the whole: each rank
 * would read every particle. A key on the outputs goes downstream with the information, notes the pieces before VTK
 * overwrites them, and sets them again when the time is requested, which is the next step.
 */
void KeepPieces(vtkAlgorithm* self, vtkInformationVector* outputs);

/**
 * Forgets the pieces of earlier requests of an output. Call after UpdateInformation, before another piece is requested.
 */
void ForgetPieces(vtkInformation* output);
}

#endif
