// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLocalRows_h
#define vtkGranularLocalRows_h

#include "private/arrays/array_views.h"
#include "private/request/request_task.h"

#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkFieldData;
class vtkIdList;
class vtkPointSet;
class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * Throws UnsupportedError if a cell is no line.
 */
void CheckLine(vtkDataSet* data, vtkIdType cell);

/**
 * The cells of some rows: lines that were split have several.
 */
struct ChosenCells
{
  std::vector<std::int64_t> All;
  std::vector<std::int64_t> Rows; ///< of each
};

/**
 * Rows that name particles at the ends of lines: of a table, or cells of lines. Each row counts once: if there are
 * integers `part`, as AddParts makes them, only those with part 0 count. Duplicate ghosts are left out.
 */
class LocalRows
{
public:
  /**
   * Throws UnsupportedError if the data are neither a vtkDataSet nor a vtkTable.
   */
  explicit LocalRows(vtkDataObject* input);

  vtkIdType Count() const { return this->AreAll ? this->AllTuples : std::ssize(this->Tuples); }

  /**
   * Returns true if each cell, or tuple of the table, is a row.
   */
  bool AreAllCells() const { return this->AreAll; }

  /**
   * Returns the cells, or tuples of the table, at which each row begins and ends. Throws Error if the parts of a line
   * are not consecutive.
   */
  std::vector<vtkIdType> FindBegins() const;
  std::vector<vtkIdType> FindEnds() const;

  /**
   * Keeps rows [first, last).
   */
  void Keep(std::pair<vtkTypeInt64, vtkTypeInt64> range);

  bool Has(const char* name) const;

  /**
   * Returns true if an array has one number per row.
   */
  bool HasNumbers(const char* name) const;

  /**
   * Returns true if there are parts of split lines.
   */
  bool HasParts() const;

  /**
   * Returns true for lines of a reader whose file names the ends by id alone: there are none, and the rows are elsewhere.
   */
  bool LackPlaces() const;

  /**
   * Returns the ids of all rows. Throws Error if the array is missing or holds other numbers; granular::Cancelled.
   */
  std::vector<std::int64_t> ReadIds(const char* name, granular::Progress& progress);

  /**
   * Returns an array with so many numbers for each row: in place if they lie so in memory, otherwise in `own`. Throws
   * Error if there are other numbers, or texts.
   */
  std::span<const double> ReadTuples(const char* name, int numbers, std::vector<double>& own);

  /**
   * Returns all arrays, with the values of as many rows, in any order.
   */
  void Pass(const std::vector<std::int64_t>& rows, vtkIdType count, vtkDataSetAttributes* to) const;

  /**
   * Returns all arrays, with the values of some cells, or tuples of the table, in any order.
   */
  void PassCells(const std::vector<std::int64_t>& cells, vtkDataSetAttributes* to) const;

  /**
   * Adds the lines of some rows, cells of the input, to those of the output: each cell with points of its own, which are
   * doubles. Throws what FindBegins and CheckLine throw.
   */
  ChosenCells AddLines(
    vtkPointSet* input, const std::vector<std::int64_t>& rows, vtkPolyData* output) const;

  vtkFieldData* GetFieldData() const { return this->Field; }

private:
  granular::ArrayView See(const char* name, int numbers = 1);
  void FindTuples();
  void PassTuples(vtkIdList* tuples, vtkDataSetAttributes* to) const;

  vtkIdType TupleOf(std::int64_t row) const
  {
    return this->AreAll ? row : this->Tuples[static_cast<std::size_t>(row)];
  }

  vtkDataSetAttributes* Data = nullptr;
  bool MayBeSplit = false; ///< they are lines
  vtkFieldData* Field = nullptr;
  ArrayViews Arrays{ "rows" };
  vtkIdType AllTuples = 0;
  bool AreAll = true;            ///< each is a row
  std::vector<vtkIdType> Tuples; ///< of the rows, where not all are
};

/**
 * Returns the rows of an input of many times that have the timestep of the particles, or else the last one before it that is found. The
 * rows of the shown time may have another one: a file with ITEM: TIME and a file without give a timestep different times. Collective.
 */
vtkSmartPointer<vtkDataObject> RowsOfTimestep(vtkAlgorithm* consumer, int port,
  vtkDataObject* particles, const PieceRequest& piece, granular::Communicator& ranks);

/**
 * Returns what to tell if the particles and the rows are of different timesteps; nothing if one of them does not say.
 */
std::string CompareTimesteps(vtkFieldData* particles, vtkFieldData* rows);
}

#endif
