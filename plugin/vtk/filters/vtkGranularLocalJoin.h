// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularLocalJoin
 * @brief   Draws contacts and bonds, which name two particles by id, as lines between the particles of a dump.
 *
 * Port 0 has the particles, a vtkPointSet with the point array `id`. Port 1 has the rows, each of which names two particles in `id1`
 * and `id2`: cells of a vtkDataSet or rows of a vtkTable. Ids are integers, in arrays of any type. Each row with both particles present
 * becomes a line with two points of its own. Other rows are left out, with a warning that counts them. Of a line that was split, only
 * the first part counts, whose integer `part` is 0. Among particles with the same id the first one is taken, with a warning. Ghost
 * duplicates are left out.
 *
 * Cell arrays, besides those of the rows:
 * - `length` of the whole line, of its shortest image except with AS_WRITTEN [m]; `length_2` if the rows' file has a column `length`
 * - `elongation` = length - l0 [m] and `strain` = elongation / l0 [-], if the equilibrium length l0 is known; nan where it is 0
 * - `A_mean`, `A_difference`: mean and difference of the array A at both ends (second minus first), see SetAverages
 * - `row` and `part`, only with SPLIT: the number of the row, from 0, and the number of the part, 0 at the first end
 *
 * all double, except `row` (vtkTypeInt64Array) and `part` (vtkTypeInt32Array).
 *
 * Lines connect the points as shown (see the field data of vtkGranularDumpReader: Unwrapped, Scaled, PointOrigin). From unwrapped
 * points they go to the nearest image of the other end; lengths are never scaled. The box is that of the particles' field data, or of
 * the rows' if the particles have none. The field data are those of the particles, with the Columns of the rows.
 *
 * Rows of many times are those with the timestep of the particles, or the last before it, even where the rows' file gives timesteps
 * other times than that of the particles (ITEM: TIME).
 *
 * Warnings also tell that the lines have no places (the rows are another output of the reader), how many lines differ from their array `dist`, and that the timesteps of both inputs differ, if the rows have
 * several times. A warning is repeated only after inputs or properties have changed, or when it came back.
 */

#ifndef vtkGranularLocalJoin_h
#define vtkGranularLocalJoin_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <string> // for std::string

class vtkAlgorithmOutput;
class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularLocalJoin : public vtkGranularAlgorithm
{
public:
  static vtkGranularLocalJoin* New();
  vtkTypeMacro(vtkGranularLocalJoin, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the lines.
   */
  vtkPolyData* GetOutput();

  enum PeriodicLinesType
  {
    MINIMUM_IMAGE = 0,
    SPLIT = 1,
    AS_WRITTEN = 2
  };

  /**
   * Sets the rows: input port 1.
   */
  void SetLinesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  ///@{
  /**
   * Sets how lines across periodic faces (boundary flags `pp`) are drawn. MINIMUM_IMAGE, the default: from the first end
   * to the nearest image of the second; the line is short and may leave the box. SPLIT: from both ends to the faces, in
   * two or more parts; lines between unwrapped points are not split. AS_WRITTEN: from end to end.
   */
  vtkGranularSetRangeMacro(PeriodicLines, int, MINIMUM_IMAGE, AS_WRITTEN);
  vtkGetMacro(PeriodicLines, int);
  ///@}

  ///@{
  /**
   * Sets the point arrays of the particles for which lines get A_mean and A_difference: names separated by blanks or
   * commas; "*" stands for all numeric arrays but id. None by default.
   */
  vtkSetStdStringFromCharMacro(Averages);
  vtkGetCharFromStdStringMacro(Averages);
  vtkSetStdStringFromCharMacro(Differences);
  vtkGetCharFromStdStringMacro(Differences);
  ///@}

  ///@{
  /**
   * Sets the length of lines at rest [m]: the array of the rows with this name, whose sign is ignored because programs
   * differ in it ("equilibrium_length" by default). Without it EquilibriumLength counts, 0 or more; 0, the default: not
   * known.
   */
  vtkSetStdStringFromCharMacro(EquilibriumLengthArray);
  vtkGetCharFromStdStringMacro(EquilibriumLengthArray);
  vtkSetMacro(EquilibriumLength, double);
  vtkGetMacro(EquilibriumLength, double);
  ///@}

protected:
  vtkGranularLocalJoin();
  ~vtkGranularLocalJoin() override = default;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularLocalJoin(const vtkGranularLocalJoin&) = delete;
  void operator=(const vtkGranularLocalJoin&) = delete;

  class Task;

  int PeriodicLines = MINIMUM_IMAGE;
  std::string Averages;
  std::string Differences;
  std::string EquilibriumLengthArray = "equilibrium_length";
  double EquilibriumLength = 0;
};

#endif
