// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularPathAlgorithm
 * @brief   Base class of filters that follow particles through all times of their input.
 *
 * The input has particles, a vtkPointSet with the point array `id`, at several times. If it is the output of vtkGranularDumpReader,
 * the filter reads the frames from the files: only the columns that it needs, several frames at a time. From any other input it
 * requests one time after the other. Ghost duplicates are left out. An id that repeats in a frame is an error.
 *
 * Selected are the particles that fulfil all of SetIds, SetEveryNth, SetRegionOfInterest and SetNumberOfSamples. Frames are those in
 * the TimeWindow, of which FrameStride leaves every n-th.
 *
 * Places are unwrapped: each path begins where the input shows the particle, and goes on by the image counts `image` (ix iy iz) where
 * the frames have them, otherwise to the nearest image of the place before; a warning counts steps longer than a quarter of a period.
 * Unwrapped points stay as they are. A periodic box that changes its size or tilt carries particles along; one that LAMMPS has flipped
 * is recognised.
 */

#ifndef vtkGranularPathAlgorithm_h
#define vtkGranularPathAlgorithm_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <string> // for std::string

class VTKGRANULAR_EXPORT vtkGranularPathAlgorithm : public vtkGranularAlgorithm
{
public:
  vtkTypeMacro(vtkGranularPathAlgorithm, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Sets the ids: ids and ranges, separated by blanks or commas. 10-20 is a range with both ends, 100-900:50 every fiftieth
   * id from 100 on. Empty, the default: all ids.
   */
  vtkSetStdStringFromCharMacro(Ids);
  vtkGetCharFromStdStringMacro(Ids);
  ///@}

  ///@{
  /**
   * Sets n of the particles whose id is a multiple of n, at least 1. 1 by default: all.
   */
  vtkGranularSetRangeMacro(EveryNth, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(EveryNth, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Sets the number of particles to be chosen at random among those of the SelectionFrame, in which fewer may be. 0, the
   * default: all. -1: a few, as a picture shows them well, if nothing else chooses particles. The choice depends on the ids and the Seed alone, not on the order of particles or the ranks.
   */
  vtkGranularSetRangeMacro(NumberOfSamples, vtkTypeInt64, -1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(NumberOfSamples, vtkTypeInt64);
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Sets a region in the SelectionFrame, xmin xmax ymin ymax zmin zmax in absolute coordinates, faces included: particles
   * whose centres are inside are selected. An axis of 0 0, or with min > max, is not restricted. (1, -1, 1, -1, 1, -1), all
   * particles, by default.
   */
  vtkSetVector6Macro(RegionOfInterest, double);
  vtkGetVector6Macro(RegionOfInterest, double);
  ///@}

  ///@{
  /**
   * Sets the frame in which RegionOfInterest and NumberOfSamples choose: its number, from 0, among all of the input; negative
   * numbers count from the end. Numbers of no frame are an error of the update. -1, the last, by default: runs often begin
   * without particles.
   */
  vtkSetMacro(SelectionFrame, int);
  vtkGetMacro(SelectionFrame, int);
  ///@}

  ///@{
  /**
   * Sets the first and last time of the frames. (1, -1), the default, or any others with first > last: all.
   */
  vtkSetVector2Macro(TimeWindow, double);
  vtkGetVector2Macro(TimeWindow, double);
  ///@}

  ///@{
  /**
   * Sets n of every n-th frame in the TimeWindow, from its first on; at least 1. 1 by default: all.
   */
  vtkGranularSetRangeMacro(FrameStride, int, 1, VTK_INT_MAX);
  vtkGetMacro(FrameStride, int);
  ///@}

  ///@{
  /**
   * Sets the point arrays of the input that are followed: names separated by blanks or commas; "*" stands for all numeric
   * arrays but id that the input has at the current time. None by default.
   */
  vtkSetStdStringFromCharMacro(Arrays);
  vtkGetCharFromStdStringMacro(Arrays);
  ///@}

protected:
  vtkGranularPathAlgorithm() = default;
  ~vtkGranularPathAlgorithm() override = default;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Returns true if the output goes through all times, whatever the current one is.
   */
  virtual bool IsTheSameAtAllTimes() const { return true; }

  std::string Ids;
  vtkTypeInt64 EveryNth = 1;
  vtkTypeInt64 NumberOfSamples = 0;
  int Seed = 0;
  double RegionOfInterest[6] = { 1, -1, 1, -1, 1, -1 };
  int SelectionFrame = -1;
  double TimeWindow[2] = { 1, -1 };
  int FrameStride = 1;
  std::string Arrays;

  class PathTask; ///< from which the tasks of the filters derive

private:
  vtkGranularPathAlgorithm(const vtkGranularPathAlgorithm&) = delete;
  void operator=(const vtkGranularPathAlgorithm&) = delete;
};

#endif
