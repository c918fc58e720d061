// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularTrajectories
 * @brief   Draws the paths of particles through time as polylines.
 *
 * See vtkGranularPathAlgorithm for the choice of particles and frames. The output has a polyline for each particle, in the order of
 * ids; where a particle is absent for some frames, one for each stretch; a stretch of one frame is a vertex. Points are those of the
 * input minus its PointOrigin, in absolute coordinates where the input is Scaled.
 *
 * Point arrays:
 * - `time` (double) and `timestep` (vtkTypeInt64Array)
 * - `speed`: the length of the steps from the place before and to the place after, divided by the time that they take [m/s]; 0 for a
 *   single place
 * - `displacement`: from the first place of the particle in these frames, unwrapped (3 components) [m]
 * - the chosen arrays: integers as vtkTypeInt64Array, all others as double; nan or 0 in frames that lack them
 *
 * Cell arrays: `id` (vtkTypeInt64Array) and `length`, of the whole stretch [m].
 *
 * With SPLIT paths stay in the box, cut at periodic faces into several polylines; at the cuts numbers are interpolated linearly, and
 * integers are those of the frame before.
 *
 * On several ranks each has its own particles, lower ranks smaller ids. Together they are what one rank makes.
 */

#ifndef vtkGranularTrajectories_h
#define vtkGranularTrajectories_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularPathAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularTrajectories : public vtkGranularPathAlgorithm
{
public:
  static vtkGranularTrajectories* New();
  vtkTypeMacro(vtkGranularTrajectories, vtkGranularPathAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the paths.
   */
  vtkPolyData* GetOutput();

  enum PeriodicLinesType
  {
    UNWRAPPED = 0,
    SPLIT = 1
  };

  ///@{
  /**
   * Sets how paths across periodic faces are drawn. UNWRAPPED, the default: on, out of the box. SPLIT: cut at the faces, in
   * the box; paths between unwrapped points are not split.
   */
  vtkGranularSetRangeMacro(PeriodicLines, int, UNWRAPPED, SPLIT);
  vtkGetMacro(PeriodicLines, int);
  ///@}

  ///@{
  /**
   * Sets the number of frames before the current time that paths reach back, so that in an animation particles have tails.
   * 0, the default: paths through all frames, whatever the current time is. The frames of the tail are kept, and only new
   * ones are read for the next time.
   */
  vtkGranularSetRangeMacro(Tail, int, 0, VTK_INT_MAX);
  vtkGetMacro(Tail, int);
  ///@}

protected:
  vtkGranularTrajectories();
  ~vtkGranularTrajectories() override;
  bool IsTheSameAtAllTimes() const override { return this->Tail == 0; }
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularTrajectories(const vtkGranularTrajectories&) = delete;
  void operator=(const vtkGranularTrajectories&) = delete;

  class Task;
  struct TailFrames;

  int PeriodicLines = UNWRAPPED;
  int Tail = 0;
  std::unique_ptr<TailFrames> Kept;
};

#endif
