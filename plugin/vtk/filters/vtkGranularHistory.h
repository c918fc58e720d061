// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularHistory
 * @brief   Makes tables of particles against time, for charts.
 *
 * See vtkGranularPathAlgorithm for the choice of particles and frames. The output is a table with a row for each frame: `time`
 * (double) and `timestep` (vtkTypeInt64Array), then what Output says.
 *
 * PARTICLES: for each selected particle, in the order of ids, `position (id N)`, unwrapped (3 components), and `A (id N)` of each
 * chosen array A; double, nan where the particle is absent. At most 1000 particles.
 *
 * STATISTICS: over all selected particles of the frame. `particles`: their number; for each component of each chosen array A `A_mean`,
 * `A_min`, `A_max` and `A_Q` for each quantile Q, such as `A_0.5`. nan and infinite numbers are left out.
 *
 * With MeanSquareDisplacement: `msd` and its parts `msd_xyz` (3 components) over the selected particles that are in the first frame
 * that has any, too, and `msd_particles`, their number: the definition of compute msd of LAMMPS, unwrapped.
 *
 * Sums are correctly rounded, so results are the same for any order of particles, threads and ranks. Rank 0 has the table.
 */

#ifndef vtkGranularHistory_h
#define vtkGranularHistory_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularPathAlgorithm.h"

#include <string> // for std::string

class vtkTable;

class VTKGRANULAR_EXPORT vtkGranularHistory : public vtkGranularPathAlgorithm
{
public:
  static vtkGranularHistory* New();
  vtkTypeMacro(vtkGranularHistory, vtkGranularPathAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the table.
   */
  vtkTable* GetOutput();

  enum OutputTypes
  {
    PARTICLES = 0,
    STATISTICS = 1
  };

  ///@{
  /**
   * Sets the columns: of single PARTICLES, or STATISTICS over all; see the class. PARTICLES by default.
   */
  vtkGranularSetRangeMacro(OutputType, int, PARTICLES, STATISTICS);
  vtkGetMacro(OutputType, int);
  ///@}

  ///@{
  /**
   * Sets the quantiles of STATISTICS: numbers from 0 to 1, separated by blanks or commas. The quantile q is the smallest of
   * the numbers up to which at least the part q of them lies. "0.5" by default: the median.
   */
  vtkSetStdStringFromCharMacro(Quantiles);
  vtkGetCharFromStdStringMacro(Quantiles);
  ///@}

  ///@{
  /**
   * On: the columns of the mean square displacement, too. Off by default.
   */
  vtkSetMacro(MeanSquareDisplacement, bool);
  vtkGetMacro(MeanSquareDisplacement, bool);
  vtkBooleanMacro(MeanSquareDisplacement, bool);
  ///@}

protected:
  vtkGranularHistory();
  ~vtkGranularHistory() override = default;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularHistory(const vtkGranularHistory&) = delete;
  void operator=(const vtkGranularHistory&) = delete;

  class Task;

  int OutputType = PARTICLES;
  std::string Quantiles = "0.5";
  bool MeanSquareDisplacement = false;
};

#endif
