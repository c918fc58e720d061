// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularLocalRows_h
#define vtkGranularLocalRows_h

#include "private/arrays/array_views.h"
#include "private/request/request_task.h"

#include "granular/common/progress.h"
#include "granular/lines/line_rows.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkFieldData;
class vtkPointSet;
class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * Throws UnsupportedError if a cell is no line.
 */
void CheckLine(vtkDataSet* data, vtkIdType cell);

/**
 * Adds cells of the input to the lines of the output: each with points of its own, which are doubles. Throws what CheckLine throws.
 */
void AddLines(vtkPointSet* input, const std::vector<std::int64_t>& cells, vtkPolyData* output);

/**
 * The cells of some rows: lines that were split have several.
 */
struct ChosenCells
{
  std::vector<std::int64_t> All;
  std::vector<std::int64_t> Rows; ///< of each
};

/**
 * The rows of a data object that name particles at the ends of lines: of a table, or cells of lines; and their arrays.
 */
class LocalRows
{
public:
  /**
   * Throws UnsupportedError if the data are neither a vtkDataSet nor a vtkTable, and what ArrayViews throws.
   */
  explicit LocalRows(vtkDataObject* input);
  LocalRows(const LocalRows&) = delete;
  void operator=(const LocalRows&) = delete;

  granular::LineRows& Get() { return *this->Rows; }

  vtkIdType Count() const { return this->Rows->count(); }
  bool AreAllCells() const { return this->Rows->are_all_cells(); }
  std::vector<std::int64_t> FindBegins() const { return this->Rows->find_begins(); }
  std::vector<std::int64_t> FindEnds() const { return this->Rows->find_ends(); }
  bool Has(const char* name) const { return this->Rows->has(name); }
  bool HasParts() const { return this->Rows->has_parts(); }
  bool LackPlaces() const { return this->Rows->lack_places(); }
  std::vector<std::int64_t> ReadIds(const char* name, granular::Progress& progress) const
  {
    return this->Rows->read_ids(name, progress);
  }
  std::span<const double> ReadTuples(const char* name, int numbers, std::vector<double>& own) const
  {
    return this->Rows->read_tuples(name, numbers, own);
  }

  /**
   * Adds all arrays, with the values of some cells, or tuples of the table, in any order; all: of all, whatever cells are.
   */
  void PassCells(
    const std::vector<std::int64_t>& cells, vtkDataSetAttributes* to, bool all = false) const;

  /**
   * Adds the lines of some rows: see the function of this name. Throws what FindBegins and CheckLine throw.
   */
  ChosenCells AddLines(
    vtkPointSet* input, const std::vector<std::int64_t>& rows, vtkPolyData* output) const;

  vtkFieldData* GetFieldData() const { return this->Field; }

private:
  vtkDataSetAttributes* Data = nullptr;
  vtkFieldData* Field = nullptr;
  ArrayViews Arrays{ "rows" };
  granular::FrameView Cells;
  std::optional<granular::LineRows> Rows;
};

/**
 * Returns the timestep in field data, if there is one.
 */
std::optional<std::int64_t> TimestepOf(vtkFieldData* data);

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
