// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularVTKParticleReader
 * @brief   Reads particles that LIGGGHTS and LAMMPS write as VTK files.
 *
 * Reads `dump custom/vtk` and `custom/vtm` of LIGGGHTS and `dump vtk` of LAMMPS, one file a timestep: .vtk, also compressed with gzip or
 * Zstandard, .vtp, .vtu, .pvtp, .pvtu and .vtm. The timestep is the last number in the file name that differs between the files; another
 * one that counts from 0 is the rank of a piece. vtkGranularSeriesReader tells which frames there are, and their times. Only the wanted frame
 * is read. Text with too few numbers, as a running simulation leaves it, is an error, and XML without its end is left out.
 *
 * The outputs are those of vtkGranularDumpReader: port 0 has the particles (vtkPolyData), with the arrays of the file, port 1 the box
 * (vtkUnstructuredGrid) from the `boundingBox` file beside it; without that, the box is empty, and not in the field data. A frame without
 * particles has the arrays of a later one. Each rank reads the whole frame and keeps its share of the rows.
 */

#ifndef vtkGranularVTKParticleReader_h
#define vtkGranularVTKParticleReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

#include <string> // for std::string

class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularVTKParticleReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularVTKParticleReader* New();
  vtkTypeMacro(vtkGranularVTKParticleReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the particles.
   */
  vtkPolyData* GetOutput();

  ///@{
  /**
   * Sets the boundaries of the box, which the files do not hold: a letter for each axis as in the command boundary, "p p f", or two.
   * Empty, the default: not known, which filters take for not periodic. Anything else is an error of the next update.
   */
  vtkSetStdStringFromCharMacro(Boundary);
  vtkGetCharFromStdStringMacro(Boundary);
  ///@}

  /**
   * Returns 1 if the file holds particles: points with an array `id`, no lines or polygons, and the title of LIGGGHTS or LAMMPS, the file of
   * their box, or in XML a number in the name. A file without points is one if that of its box is there. Never fails.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularVTKParticleReader();
  ~vtkGranularVTKParticleReader() override = default;

private:
  vtkGranularVTKParticleReader(const vtkGranularVTKParticleReader&) = delete;
  void operator=(const vtkGranularVTKParticleReader&) = delete;

  std::string Boundary;

  struct Internals;
};

#endif
