// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularParticleReader
 * @brief   Base class of readers of particles: which of them are read, in which order, and where their points are.
 */

#ifndef vtkGranularParticleReader_h
#define vtkGranularParticleReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

#include <memory> // for std::unique_ptr

class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularParticleReader : public vtkGranularSeriesReader
{
public:
  vtkTypeMacro(vtkGranularParticleReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the particles.
   */
  vtkPolyData* GetOutput();

  enum CoordinatesType
  {
    ABSOLUTE = 0,
    UNWRAPPED = 1,
    SCALED = 2
  };

  ///@{
  /**
   * Sets the form of the points, which are computed if the file holds another form. ABSOLUTE, the default: in the box, as
   * the simulation holds them. UNWRAPPED: plus the image counts times the box vectors. SCALED: in units of the box
   * vectors, 0 to 1 inside the box.
   */
  vtkGranularSetRangeMacro(Coordinates, int, ABSOLUTE, SCALED);
  vtkGetMacro(Coordinates, int);
  ///@}

  ///@{
  /**
   * Sets a point that is subtracted from the points and from the corners of the box, in double precision and before any
   * rounding. Unit: length, or box vectors where Coordinates is SCALED. Any finite numbers; (0, 0, 0) by default.
   */
  vtkSetVector3Macro(PointOrigin, double);
  vtkGetVector3Macro(PointOrigin, double);
  ///@}

  ///@{
  /**
   * Sorts the particles of a frame by id. Files without ids keep their order. Off by default.
   */
  vtkSetMacro(SortById, bool);
  vtkGetMacro(SortById, bool);
  vtkBooleanMacro(SortById, bool);
  ///@}

  ///@{
  /**
   * Sets the stride: n keeps the particles whose id is a multiple of n; without ids, every n-th row from the first.
   * Numbers below 1 are an error and change nothing. 1 by default: all particles.
   */
  vtkGranularSetRangeMacro(Stride, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(Stride, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Sets a region, xmin xmax ymin ymax zmin zmax in absolute coordinates, faces included: only particles whose centres are
   * inside are kept. An axis of 0 0, or with min > max, is not restricted. (1, -1, 1, -1, 1, -1), all particles, by default.
   */
  vtkSetVector6Macro(RegionOfInterest, double);
  vtkGetVector6Macro(RegionOfInterest, double);
  ///@}

protected:
  explicit vtkGranularParticleReader(std::unique_ptr<Internals> internals);
  ~vtkGranularParticleReader() override = default;

  int Coordinates = ABSOLUTE;
  double PointOrigin[3] = { 0, 0, 0 };
  bool SortById = false;
  vtkTypeInt64 Stride = 1;
  double RegionOfInterest[6] = { 1, -1, 1, -1, 1, -1 };

private:
  vtkGranularParticleReader(const vtkGranularParticleReader&) = delete;
  void operator=(const vtkGranularParticleReader&) = delete;
};

#endif
