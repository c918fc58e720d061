// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEulerWriter.h"

#include "private/dump/dump_input.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/writing/writer.h"

#include "granular/common/error.h"
#include "granular/formats/euler/euler_text.h"
#include "granular/grid/cells.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/trade.h"
#include "granular/writing/file_names.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularEulerWriter);

namespace
{
static_assert(
  vtkGranularEulerWriter::LIGGGHTS == static_cast<int>(granular::EulerDialect::Liggghts) &&
  vtkGranularEulerWriter::WIDE == static_cast<int>(granular::EulerDialect::Wide) &&
  vtkGranularEulerWriter::AUTOMATIC == static_cast<int>(granular::EulerDialect::Automatic));

/**
 * Consecutive cells along x, identified by the place of the first one in a grid that ranks share.
 */
struct CellRun
{
  std::array<std::int64_t, 3> Place = {}; ///< along z, y and x
  std::int64_t Count = 0;
  std::int64_t First = 0; ///< number of the first one among all that are gathered
};

/**
 * The cells of a rank.
 */
struct EulerInput
{
  granular::EulerCells Cells;
  std::vector<CellRun> Runs;           ///< of a grid; else none: cells are as they come
  vtkSmartPointer<vtkPointSet> Points; ///< with the field data that the input has
};

/**
 * The middles of a grid's cells along each axis, and the number of the first one.
 */
struct Middles
{
  std::array<std::vector<double>, 3> Along;
  std::array<int, 3> First = {};
};

/**
 * A grid that is flat along an axis has one cell there, in its plane.
 */
template <typename Middle>
std::vector<double> MiddlesOf(int first, int last, const Middle& middle)
{
  std::vector<double> middles;
  for (int i = first; i < std::max(last, first + 1) && last >= first; ++i)
  {
    middles.push_back(middle(i - first, last == first));
  }
  return middles;
}

Middles MiddlesOf(vtkImageData* image)
{
  if (!image->GetDirectionMatrix()->IsIdentity())
  {
    throw granular::UnsupportedError("expected an image along the axes, got a turned one");
  }
  Middles middles;
  const int* extent = image->GetExtent();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double origin = image->GetOrigin()[axis];
    const double spacing = image->GetSpacing()[axis];
    const int first = middles.First[axis] = extent[2 * axis];
    middles.Along[axis] = MiddlesOf(first, extent[2 * axis + 1],
      [&](int i, bool flat) { return origin + (first + i + (flat ? 0 : 0.5)) * spacing; });
  }
  return middles;
}

Middles MiddlesOf(vtkRectilinearGrid* grid)
{
  Middles middles;
  const int* extent = grid->GetExtent();
  vtkDataArray* const coordinates[] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
    grid->GetZCoordinates() };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    vtkDataArray* faces = coordinates[axis];
    const int first = middles.First[axis] = extent[2 * axis];
    middles.Along[axis] = MiddlesOf(first, extent[2 * axis + 1],
      [&](int i, bool flat)
      {
        const double from = faces->GetComponent(i, 0);
        return flat ? from : from + (faces->GetComponent(i + 1, 0) - from) / 2;
      });
  }
  return middles;
}

/**
 * Values of a data set that are to be written: a value for each of its points, or of its cells.
 */
struct Source
{
  vtkSmartPointer<vtkPointSet> Points;
  vtkDataSetAttributes* Data = nullptr;
  vtkUnsignedCharArray* Ghosts = nullptr;
  std::vector<CellRun> Lines;   ///< of a grid: all its cells along x
  vtkCellData* Cells = nullptr; ///< of points: what CellCenters would take
};

Source MakeGridSource(vtkDataSet* grid, const Middles& middles)
{
  Source source;
  source.Data = grid->GetCellData();
  source.Ghosts = grid->GetCellGhostArray();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto& [x, y, z] = middles.Along;
  for (std::size_t k = 0; k < z.size(); ++k)
  {
    for (std::size_t j = 0; j < y.size() && !x.empty(); ++j)
    {
      for (const double middle : x)
      {
        points->InsertNextPoint(middle, y[j], z[k]);
      }
      source.Lines.push_back(
        { { middles.First[2] + static_cast<std::int64_t>(k),
            middles.First[1] + static_cast<std::int64_t>(j), middles.First[0] },
          std::ssize(x) });
    }
  }
  source.Points = vtkSmartPointer<vtkPolyData>::New();
  source.Points->SetPoints(points);
  return source;
}

Source MakeSource(vtkDataObject* input)
{
  if (auto* points = vtkPointSet::SafeDownCast(input))
  {
    Source source;
    source.Points.TakeReference(points->NewInstance());
    source.Points->CopyStructure(points);
    source.Data = points->GetPointData();
    source.Cells = points->GetCellData();
    source.Ghosts = points->GetPointGhostArray();
    return source;
  }
  if (auto* image = vtkImageData::SafeDownCast(input))
  {
    return MakeGridSource(image, MiddlesOf(image));
  }
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(input))
  {
    return MakeGridSource(grid, MiddlesOf(grid));
  }
  throw granular::UnsupportedError(
    "expected points, a vtkImageData or a vtkRectilinearGrid of cells to write, got a " +
    std::string(input->GetClassName()));
}

/**
 * The values of those that are kept, behind the others.
 */
void ReadArray(const Source& source, const std::vector<vtkIdType>& kept,
  const granular::EulerArray& array, std::vector<double>& values)
{
  const std::string name(array.name);
  auto* data = source.Data->GetArray(name.c_str());
  const bool cells = !source.Lines.empty();
  if (!data && array.optional)
  {
    return;
  }
  if (!data)
  {
    throw granular::UnsupportedError("expected the array in the data of the " +
        std::string(cells ? "cells" : "points") + ", got none" +
        (source.Cells && source.Cells->HasArray(name.c_str())
            ? ": the filter CellCenters makes points of cells"
            : ""),
      { .column = name });
  }
  if (data->GetNumberOfComponents() != array.components ||
    data->GetNumberOfTuples() != source.Points->GetNumberOfPoints())
  {
    throw granular::UnsupportedError("expected " + std::to_string(array.components) +
        " components for each of " + std::to_string(source.Points->GetNumberOfPoints()) +
        (cells ? " cells" : " points") + ", got " + std::to_string(data->GetNumberOfComponents()) +
        " for " + std::to_string(data->GetNumberOfTuples()),
      { .column = name });
  }
  for (const vtkIdType i : kept)
  {
    for (int component = 0; component < array.components; ++component)
    {
      values.push_back(data->GetComponent(i, component));
    }
  }
}

/**
 * The runs of the cells that are kept, which increase.
 */
void AddRuns(
  const std::vector<CellRun>& lines, const std::vector<vtkIdType>& kept, std::vector<CellRun>& runs)
{
  vtkIdType next = -1;
  for (const vtkIdType cell : kept)
  {
    const CellRun& line = lines[cell / lines.front().Count];
    const std::int64_t along = cell % lines.front().Count;
    if (cell != next || along == 0)
    {
      const auto& [z, y, x] = line.Place;
      runs.push_back({ { z, y, x + along } });
    }
    ++runs.back().Count;
    next = cell + 1;
  }
}

/**
 * Adds a data set without fields of its own to what there is.
 */
void Read(vtkDataObject* data, vtkFieldData* fields, bool runs, EulerInput& to)
{
  Source source = MakeSource(data);
  source.Points->SetFieldData(fields);
  constexpr int duplicate = vtkDataSetAttributes::DUPLICATECELL;
  static_assert(duplicate == int{ vtkDataSetAttributes::DUPLICATEPOINT });
  std::vector<vtkIdType> kept;
  for (vtkIdType i = 0; i < source.Points->GetNumberOfPoints(); ++i)
  {
    const int ghost = source.Ghosts ? source.Ghosts->GetValue(i) : 0;
    if ((ghost & duplicate) == 0)
    {
      kept.push_back(i);
    }
  }
  if (kept.empty())
  {
    return; // and perhaps no arrays
  }
  const std::vector<double> centres = ReadAbsolutePoints(source.Points);
  for (const vtkIdType i : kept)
  {
    to.Cells.centres.insert(
      to.Cells.centres.end(), centres.begin() + 3 * i, centres.begin() + 3 * i + 3);
  }
  for (const granular::EulerArray& array : granular::euler_arrays())
  {
    ReadArray(source, kept, array, to.Cells.*array.values);
  }
  if (runs && !source.Lines.empty())
  {
    AddRuns(source.Lines, kept, to.Runs);
  }
}

/**
 * Puts cells into the order of the grid, of which they are these runs.
 */
void Sort(granular::EulerCells& cells, std::vector<CellRun> runs)
{
  std::int64_t count = 0;
  for (CellRun& run : runs)
  {
    run.First = count;
    count += run.Count;
  }
  if (count != cells.count())
  {
    throw granular::UnsupportedError("expected grids on all processes, got a grid for " +
      std::to_string(count) + " of " + std::to_string(cells.count()) + " cells");
  }
  std::ranges::stable_sort(runs, {}, &CellRun::Place);
  const auto sort = [&](std::vector<double>& values, int components)
  {
    std::vector<double> sorted;
    sorted.reserve(values.size());
    for (const CellRun& run : runs)
    {
      const auto first = values.begin() + run.First * components;
      sorted.insert(sorted.end(), first, first + run.Count * components);
    }
    values = std::move(sorted);
  };
  sort(cells.centres, 3);
  for (const granular::EulerArray& array : granular::euler_arrays())
  {
    std::vector<double>& values = cells.*array.values;
    if (!values.empty())
    {
      sort(values, array.components);
    }
  }
}

/**
 * Reads points with point arrays, or a vtkImageData or vtkRectilinearGrid with cell arrays, where each cell counts at
 * its centre, or a composite of such data. Positions are absolute: a subtracted origin is added. Duplicate ghosts are
 * left out. Throws UnsupportedError for other data, and if an array is missing.
 */
EulerInput ReadCells(vtkDataObject* input)
{
  EulerInput result;
  vtkFieldData* fields = input->GetFieldData();
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    Read(input, fields, true, result);
  }
  else
  {
    auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
    {
      vtkDataObject* block = blocks->GetCurrentDataObject();
      const auto has = [&](const char* name) { return block->GetFieldData()->HasArray(name) != 0; };
      Read(block, (has("Coordinates") ? block : input)->GetFieldData(), false, result);
      if (has("timestep") && fields->HasArray("timestep") == 0)
      {
        fields = block->GetFieldData();
      }
    }
  }
  for (const granular::EulerArray& array : granular::euler_arrays())
  {
    std::vector<double>& values = result.Cells.*array.values;
    if (static_cast<std::int64_t>(values.size()) != array.components * result.Cells.count())
    {
      values.clear(); // some blocks have it
    }
  }
  result.Points = vtkSmartPointer<vtkPolyData>::New();
  result.Points->SetFieldData(fields);
  return result;
}

/**
 * Returns all cells on rank 0: of a grid z slowest, then y, then x; otherwise in the order of the ranks. Collective.
 */
granular::EulerCells GatherCells(EulerInput&& own, granular::Communicator& ranks)
{
  std::vector<CellRun> runs;
  for (const std::vector<CellRun>& part : granular::gather(ranks, own.Runs))
  {
    runs.insert(runs.end(), part.begin(), part.end());
  }
  granular::EulerCells cells = granular::gather_cells(own.Cells, ranks);
  if (ranks.rank() == 0 && !runs.empty())
  {
    Sort(cells, std::move(runs));
  }
  return cells;
}
}

//------------------------------------------------------------------------------
/**
 * Cells that are being written.
 */
class vtkGranularEulerWriter::File : public WholeFile
{
public:
  File(vtkGranularEulerWriter* self, Internals& internals)
    : WholeFile(self->FileName, false, internals.MakeOptions(self), internals.GetRanks())
    , Dialect(static_cast<granular::EulerDialect>(self->Dialect))
  {
  }

protected:
  std::unique_ptr<RowsInput> Take(
    vtkDataObject* input, granular::Notices& vtkNotUsed(notices)) override
  {
    NameFile({ this->Path }, [&] { this->Own = ReadCells(input); });
    return std::make_unique<RowsInput>(this->Own.Points, this->Own.Cells.count());
  }

  void Gather(granular::Notices&, granular::Progress&) override
  {
    NameFile(
      { this->Path }, [&] { this->All = GatherCells(std::exchange(this->Own, {}), this->Ranks); });
  }

  std::string Encode(
    std::optional<double>, granular::Notices& notices, granular::Progress& progress) override
  {
    return granular::encode_euler(this->All, this->Dialect, notices, progress);
  }

private:
  const granular::EulerDialect Dialect;
  EulerInput Own;
  granular::EulerCells All;
};

vtkGranularPrintMacro(vtkGranularEulerWriter, Dialect);

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularEulerWriter::OpenFile(Internals& internals)
{
  const std::string path = this->FileName;
  if (granular::is_name_of_ranks(path))
  {
    throw granular::UnsupportedError(
      "expected a name without '%': one file holds the cells of all processes", { path });
  }
  return std::make_unique<File>(this, internals);
}
