// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalWriter.h"

#include "private/dump/dump_input.h"
#include "private/local/lines.h"
#include "private/local/local_rows.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/writing/writer.h"

#include "granular/common/error.h"
#include "granular/formats/local/local_reader.h"
#include "granular/lines/line_columns.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalWriter);

namespace
{
constexpr const char* ArraysOfEnds[] = { "position1", "position2" };

/**
 * Lines of two points each, and nothing else.
 */
void CheckCells(vtkPolyData* input)
{
  const std::pair<vtkCellArray*, const char*> others[] = { { input->GetVerts(), "vertices" },
    { input->GetPolys(), "polygons" }, { input->GetStrips(), "triangle strips" } };
  for (const auto& [cells, name] : others)
  {
    if (cells && cells->GetNumberOfCells() > 0)
    {
      throw granular::UnsupportedError("expected lines to write and no other cells, got " +
        std::to_string(cells->GetNumberOfCells()) + " " + name);
    }
  }
  vtkCellArray* lines = input->GetLines();
  for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
  {
    if (lines->GetCellSize(line) != 2)
    {
      throw granular::UnsupportedError("expected lines of two points each to write, got " +
        std::to_string(lines->GetCellSize(line)) + " points in line " + std::to_string(line));
    }
  }
}

/**
 * Rows of contacts, bonds or anything else: of a table, or lines with their cell arrays, and with their ends as the
 * arrays position1 and position2 unless they have such arrays. Components of arrays that local_known_columns knows get
 * its names.
 */
class LocalInput : public RowsInput
{
public:
  /**
   * made: keep the cell arrays `length` and `row`, which readers and joins add to lines. Throws UnsupportedError for
   * other data and for cells that are not lines of two points; and what SeeArrays and ReadAbsolutePoints throw.
   */
  LocalInput(vtkDataObject* input, bool made, granular::Notices& notices)
    : RowsInput(input)
  {
    const LocalRows rows(input);
    auto* lines = vtkPolyData::SafeDownCast(input);
    auto* table = vtkTable::SafeDownCast(input);
    if (!lines && !table)
    {
      throw granular::UnsupportedError(
        "expected a vtkPolyData with lines, or a vtkTable, to write, got a " +
        std::string(input->GetClassName()) + ": the filter ExtractSurface makes lines of it");
    }
    if (lines)
    {
      CheckCells(lines);
      this->View.rows = lines->GetNumberOfCells();
      this->SeeArrays(lines->GetCellData(), notices);
    }
    else
    {
      this->View.rows = table->GetNumberOfRows();
      this->SeeArrays(table->GetRowData(), notices);
    }
    this->LeaveOut(rows);
    if (lines)
    {
      this->SeeLines(lines, made, rows, notices);
    }
    for (granular::ArrayView& array : this->View.arrays)
    {
      array.columns = granular::local_component_names(array.name, array.size());
      array.places = granular::is_end_array(array.name) && array.size() == 3;
    }
  }

private:
  /**
 * Rows that others have, and all parts of lines but the first.
 */
  void LeaveOut(const LocalRows& rows)
  {
    if (rows.Count() == this->View.rows)
    {
      return;
    }
    this->Ghosts.assign(
      static_cast<std::size_t>(this->View.rows), granular::FrameView::duplicate_row);
    for (const std::int64_t tuple : rows.FindBegins())
    {
      this->Ghosts[static_cast<std::size_t>(tuple)] = 0;
    }
    this->View.ghosts = this->Ghosts.data();
  }

  void SeeLines(vtkPolyData* lines, bool made, const LocalRows& rows, granular::Notices& notices)
  {
    if (this->View.rows == 0 && this->View.arrays.empty()) // nothing is known of them
    {
      if (rows.LackPlaces())
      {
        notices.push_back({ {},
          "the input has no lines, as its file does not say where these are: rows are on the "
          "second "
          "output of the reader" });
      }
      return;
    }
    if (!made)
    {
      this->LeaveOutMade(LengthName(lines->GetFieldData()));
    }
    this->AddEnds(lines, rows);
  }

  /**
 * Unless they are columns of the file that the lines are from.
 */
  void LeaveOutMade(const std::string& length)
  {
    std::erase_if(this->View.arrays,
      [&](const granular::ArrayView& array)
      {
        return (array.name == length || array.name == RowArray || array.name == PartArray) &&
          std::ranges::find(this->View.columns, array.name) == this->View.columns.end();
      });
  }

  /**
 * The first point of the first part, and the last one of the last.
 */
  void AddEnds(vtkPolyData* lines, const LocalRows& rows)
  {
    this->Ends.resize(static_cast<std::size_t>(6 * this->View.rows));
    const std::vector<double> points =
      rows.Count() > 0 ? ReadAbsolutePoints(lines) : std::vector<double>();
    const std::vector<std::int64_t> parts[] = { rows.FindBegins(), rows.FindEnds() };
    for (std::size_t end = 0; end < 2; ++end)
    {
      if (this->View.find(ArraysOfEnds[end]))
      {
        continue;
      }
      for (std::size_t row = 0; row < parts[0].size(); ++row)
      {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        lines->GetLines()->GetCellAtId(parts[end][row], count, ids);
        const auto tuple = static_cast<std::size_t>(parts[0][row]);
        std::copy_n(points.data() + 3 * ids[end], 3, this->Ends.data() + 6 * tuple + 3 * end);
      }
      granular::ArrayView view{ ArraysOfEnds[end], granular::ValueType::Float64, {}, 6 };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        view.components.push_back(this->Ends.data() + 3 * end + axis);
      }
      this->View.arrays.push_back(std::move(view));
    }
  }

  std::vector<unsigned char> Ghosts; ///< where some rows are left out
  std::vector<double> Ends;          ///< x y z of both ends of each line
};
}

vtkGranularPrintMacro(vtkGranularLocalWriter, Dialect, Label, Columns, NumberFormat);

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularLocalWriter::OpenFile(Internals& internals)
{
  granular::DumpFormat format =
    granular::format_of_name(this->FileName, this->Columns, this->NumberFormat);
  format.dialect = DialectOf(this->Dialect);
  format.style = granular::DumpStyle::Local;
  format.counted = this->Label == "Automatic" ? std::string() : this->Label;
  const bool chosen = !format.columns.empty();
  return std::make_unique<RowsFile>(this->FileName, format, internals.MakeOptions(this),
    internals.GetRanks(),
    [where = granular::Where{ this->FileName }, chosen](
      vtkDataObject* input, granular::Notices& notices)
    {
      std::unique_ptr<RowsInput> data;
      NameFile(where, [&] { data = std::make_unique<LocalInput>(input, chosen, notices); });
      return data;
    });
}
