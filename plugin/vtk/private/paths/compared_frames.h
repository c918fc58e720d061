// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularComparedFrames_h
#define vtkGranularComparedFrames_h

#include "private/dump/input_frames.h"

#include "granular/parallel/communicator.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataObject;
class vtkDataSetAttributes;
class vtkIdList;

namespace vtkGranularPrivate
{
/**
 * The data of all connected inputs of an algorithm at one time. Shallow copies: an input may go on to other times.
 */
using FrameData = std::vector<vtkSmartPointer<vtkDataObject>>;

/**
 * Frames of the inputs of an algorithm, kept between updates, so that a frame that many updates need is read once. Frames
 * are forgotten when an input has changed.
 */
class KeptFrames
{
public:
  /**
   * Begins an update with the frame that is shown. Throws Error if the ranks have different times. Collective.
   */
  void Begin(vtkAlgorithm* consumer, const InputFrames::Part& part, granular::Communicator& ranks);

  /**
   * Returns the shown frame.
   */
  const FrameData& GetShown() const { return this->Shown; }

  /**
   * Returns the times of the first input, and the number of the shown one; 0 without times.
   */
  const std::vector<double>& GetTimes() const { return this->Times; }
  std::size_t GetShownNumber() const { return this->ShownNumber; }

  /**
   * Returns the frame with this number: the shown one, a kept one, or one that is requested from the inputs, which then
   * return to the shown time. Throws Error if an input cannot make it; Cancelled. Collective.
   */
  FrameData Get(vtkAlgorithm* consumer, std::size_t number, granular::Communicator& ranks);

  /**
   * Returns the number of the first frame whose first input has points; that of the shown one, if none has before. Collective.
   */
  std::size_t FindFirst(vtkAlgorithm* consumer, granular::Communicator& ranks);

  /**
   * Ends an update: keeps the frame that was returned last, and on request the shown frame, too.
   */
  void End(bool keepShown);

private:
  FrameData Read(vtkAlgorithm* consumer, double time, granular::Communicator& ranks) const;

  InputFrames::Part Part;
  std::vector<vtkMTimeType> Changed; ///< of the pipelines of the inputs
  std::vector<double> Times;
  std::size_t ShownNumber = 0;
  std::size_t Last = 0;  ///< number of the frame that Get returned last
  std::size_t Empty = 0; ///< so many frames at the beginning have no points, or more
  FrameData Shown;
  std::map<double, FrameData> Kept; ///< by their times
};

/**
 * The name and kind of an array.
 */
struct ArrayForm
{
  std::string Name;
  int Type = 0;
  int Components = 1;
};

/**
 * Rows of the current frame, and behind them the lost ones of a reference frame.
 */
class ChangedRows
{
public:
  /**
   * rows, lost: the tuples of the current and the reference frame.
   */
  ChangedRows(const std::vector<std::int64_t>& rows, const std::vector<std::int64_t>& lost);

  vtkIdType Count() const;

  /**
   * Returns an array with the values of both; `current` itself if it has exactly these. Rows without a value, because an
   * array is null or of another kind, get nan, 0 or an empty text.
   */
  vtkSmartPointer<vtkAbstractArray> Combine(
    const ArrayForm& form, vtkAbstractArray* current, vtkAbstractArray* reference) const;

  /**
   * Adds the arrays that the current rows of all ranks have: those of the first rank with current rows; if none has any, of
   * the first one with rows of the reference frame. Ghosts are left out. The current attributes, such as pedigree ids, remain
   * what they are. Collective.
   */
  void Pass(vtkDataSetAttributes* current, vtkDataSetAttributes* reference,
    granular::Communicator& ranks, vtkDataSetAttributes* output) const;

private:
  vtkNew<vtkIdList> Rows;
  vtkNew<vtkIdList> Lost;
};
}

#endif
