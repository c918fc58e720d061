// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularSeriesReader
 * @brief   Base class of readers of the files of a run: files, frames and times.
 *
 * All frames of all files form one run, ordered by timestep. Files may be compressed with gzip or Zstandard, under any name. An
 * incomplete last frame is left out, because the simulation is still writing it. Files with `boundingBox` in their names, which LIGGGHTS
 * writes beside some dumps, are skipped.
 *
 * Frames of one timestep in several files are pieces of one frame (one file per rank, `%` in the name of a dump), or repetitions of a
 * restarted run: see SetRepeatedSteps.
 *
 * The time is ITEM: TIME if every frame has one and it strictly increases, otherwise timestep x TimestepSize: the double nearest to the
 * product of the decimal numbers, so that 3 x 1e-5 is 3e-05. An ITEM: TIME that equals this product but for rounding becomes that
 * double, too. Timesteps from 2^53 that would share a time get the next doubles, with a warning. A request for a time shows the last
 * frame at or before it, or the first frame.
 *
 * The reader looks at the files when FileNames changes and at Refresh; with RefreshOnUpdate at every update. It then reads what was
 * appended, and does not read earlier frames again. A file that shrank or was replaced is read again from its beginning. The frames of
 * a file that is gone disappear, with a warning.
 */

#ifndef vtkGranularSeriesReader_h
#define vtkGranularSeriesReader_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <memory> // for std::unique_ptr

class vtkDataArraySelection;

class VTKGRANULAR_EXPORT vtkGranularSeriesReader : public vtkGranularAlgorithm
{
public:
  vtkTypeMacro(vtkGranularSeriesReader, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RepeatedStepsType
  {
    AUTO = 0,
    MERGE = 1,
    LAST = 2
  };

  ///@{
  /**
   * Sets the files of one run. Null and empty names are ignored. None by default.
   */
  void AddFileName(VTK_FILEPATH const char* fileName);
  void ClearFileNames();
  int GetNumberOfFileNames();
  VTK_FILEPATH const char* GetFileName(int index);
  ///@}

  ///@{
  /**
   * Returns the selection of the point or the cell arrays. UpdateInformation() fills it with those that the files have. The
   * choice stays when the files are read again.
   */
  virtual vtkDataArraySelection* GetPointDataArraySelection();
  virtual vtkDataArraySelection* GetCellDataArraySelection();
  ///@}

  /**
   * Makes the next update look at the files again, without reading earlier frames again.
   */
  void Refresh();

  ///@{
  /**
   * On: every update looks for changed files and then acts like Refresh. Off by default.
   */
  vtkSetMacro(RefreshOnUpdate, bool);
  vtkGetMacro(RefreshOnUpdate, bool);
  vtkBooleanMacro(RefreshOnUpdate, bool);
  ///@}

  ///@{
  /**
   * Sets the meaning of several frames with the same timestep in different files. MERGE: pieces of one frame; a timestep
   * with fewer pieces than others is left out. LAST: repetitions, of which the one in the last file counts. AUTO, the
   * default: pieces if the names differ in one number that counts from 0, and if the files share the first and most
   * timesteps, the boxes and the columns, but no particles; otherwise repetitions.
   */
  vtkGranularSetRangeMacro(RepeatedSteps, int, AUTO, LAST);
  vtkGetMacro(RepeatedSteps, int);
  ///@}

  ///@{
  /**
   * Sets the time of one timestep, in seconds (or the run's unit of time), for files without ITEM: TIME. Finite and
   * greater than 0; anything else is an error and changes nothing. A size that makes the time of a frame infinite is an
   * error of the next update. 1 by default.
   */
  void SetTimestepSize(double size);
  vtkGetMacro(TimestepSize, double);
  ///@}

  /**
   * Sets the ranks that read together, each its piece. All of them must set the controller and the same properties, and
   * update the reader in the same order, even those that have nothing to read. Rank 0 looks at the files for all. An error
   * on one rank is an error on all. Default: the global controller; null: this rank reads alone.
   */
  void SetController(vtkMultiProcessController* controller) override;

protected:
  struct Internals;

  explicit vtkGranularSeriesReader(std::unique_ptr<Internals> internals);
  ~vtkGranularSeriesReader() override;

  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int requestFromOutputPort, vtkMTimeType* mtime) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  bool RefreshOnUpdate = false;
  int RepeatedSteps = AUTO;
  double TimestepSize = 1;
  const std::unique_ptr<Internals> Series;

private:
  friend class vtkGranularWriter; ///< does not replace files that are still read

  vtkGranularSeriesReader(const vtkGranularSeriesReader&) = delete;
  void operator=(const vtkGranularSeriesReader&) = delete;
};

#endif
