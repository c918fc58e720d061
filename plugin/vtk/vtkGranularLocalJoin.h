// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularLocalJoin
 * @brief   Draws contacts and bonds, which name two particles by id, as lines between the particles of a dump.
 *
 * Port 0 has the particles, a vtkPointSet with the point array `id`; port 1 the rows, each of which names two of them in
 * `id1` and `id2`: cells of a vtkPolyData or rows of a vtkTable. Ids are integers, in arrays of any type. Each row whose two particles are there becomes a line with two points of its own; others are left out,
 * with a warning that counts them. Parts of a row that was split, which have the same number in the array `row`, count
 * once. Of particles with the same id the first is taken, with a warning; duplicates of ghosts are left out.
 *
 * Cell arrays, besides those of the rows:
 * - `length` of the whole line, the shortest of its images but for AS_WRITTEN [m]
 * - `elongation` = length - l0 [m] and `strain` = elongation / l0 [-], where the equilibrium length l0 is known; nan where it is 0
 * - `A_mean`, `A_difference`: of the array A at both ends (second less first), see SetAverages
 * - `row`, only with SPLIT: the number of the row that a line is a part of
 *
 * all double, but for `row` (vtkTypeInt64Array).
 *
 * Lines are where the points are shown, whatever these are (see the field data of vtkGranularDumpReader: Unwrapped, Scaled,
 * PointOrigin): from unwrapped points they go to the nearest image of the other end; lengths are never scaled. Field
 * data are those of the particles, but for the Columns, which are the rows'.
 *
 * Warnings, once an update, also tell how many lines are not as long as their array `dist` says, and that the
 * timesteps of both inputs differ. After an error the output is empty and GetErrorCode() is not vtkErrorCode::NoError. A
 * request to abort holds for one update: the output is empty then, and the next update starts afresh.
 */

#ifndef vtkGranularLocalJoin_h
#define vtkGranularLocalJoin_h

#include "vtkGranularModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkAlgorithmOutput;
class vtkMultiProcessController;

class VTKGRANULAR_EXPORT vtkGranularLocalJoin : public vtkPolyDataAlgorithm
{
public:
  static vtkGranularLocalJoin* New();
  vtkTypeMacro(vtkGranularLocalJoin, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum PeriodicLinesType
  {
    MINIMUM_IMAGE = 0,
    SPLIT = 1,
    AS_WRITTEN = 2
  };

  /**
   * The rows: input port 1.
   */
  void SetLinesConnection(vtkAlgorithmOutput* output);

  ///@{
  /**
   * How lines across periodic faces of the box are drawn, which are those whose boundary flags are `pp`. MINIMUM_IMAGE, the
   * default: from the first end to the nearest image of the second, out of the box. SPLIT: from both ends to the faces between
   * them, in two parts or more; as MINIMUM_IMAGE from unwrapped points. AS_WRITTEN: from end to end, wherever they are.
   */
  vtkSetClampMacro(PeriodicLines, int, MINIMUM_IMAGE, AS_WRITTEN);
  vtkGetMacro(PeriodicLines, int);
  ///@}

  ///@{
  /**
   * Point arrays of the particles of which lines get A_mean, and A_difference: names separated by blanks or commas;
   * "*" stands for all arrays of numbers but id. None by default.
   */
  vtkSetStringMacro(Averages);
  vtkGetStringMacro(Averages);
  vtkSetStringMacro(Differences);
  vtkGetStringMacro(Differences);
  ///@}

  ///@{
  /**
   * The length of lines at rest [m]: the array of the rows of that name, of which the magnitude counts, as some programs
   * store it with a sign ("equilibrium_length" by default), or where they have none EquilibriumLength, 0 or more; 0, the
   * default: not known.
   */
  vtkSetStringMacro(EquilibriumLengthArray);
  vtkGetStringMacro(EquilibriumLengthArray);
  vtkSetMacro(EquilibriumLength, double);
  vtkGetMacro(EquilibriumLength, double);
  ///@}

  ///@{
  /**
   * Threads: how many work. 0, the default: the cores of the machine, divided by the processes of the Controller that run
   * on it. Changes no result. Below 0 is an error and changes nothing. Controller: the processes that join together, each with
   * its part of the particles and of the rows, in any way: all of them must set it, set the same properties, and update
   * together. Each gets the lines of its rows. What goes wrong on one of them is an error of all. The global controller by
   * default; null: this process is alone.
   */
  void SetThreads(int threads);
  vtkGetMacro(Threads, int);
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  /**
   * Stops the update that comes next, or that is running, on all processes of the Controller.
   */
  void SetAbortExecute(vtkTypeBool abort) override;

protected:
  vtkGranularLocalJoin();
  ~vtkGranularLocalJoin() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int requestFromOutputPort, vtkMTimeType* mtime) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularLocalJoin(const vtkGranularLocalJoin&) = delete;
  void operator=(const vtkGranularLocalJoin&) = delete;

  class Joiner;
  struct Internals;

  int PeriodicLines = MINIMUM_IMAGE;
  char* Averages = nullptr;
  char* Differences = nullptr;
  char* EquilibriumLengthArray = nullptr;
  double EquilibriumLength = 0;
  int Threads = 0;

  std::unique_ptr<Internals> Shared;
};

#endif
