// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/euler_dataset.h"

#include "granular/euler/cells.h"
#include "granular/grid/euler_grid.h"
#include "granular/vtk_files/vtk_corners.h"
#include "granular/vtk_files/vtk_sections.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace granular
{
namespace
{
constexpr std::string_view points = "POLYDATA";
constexpr std::string_view rectilinear = "RECTILINEAR_GRID";
constexpr std::string_view unstructured = "UNSTRUCTURED_GRID";

/// Line 2 of what LIGGGHTS and PFM write.
constexpr std::string_view liggghts_title = "LIGGGHTS mesh/VTK export";

/// The arrays that tell Euler cells from others.
constexpr std::string_view telling[] = { "v_avg", "volumefraction" };

bool is_telling(std::string_view name)
{
  return std::ranges::find(telling, name) != std::end(telling);
}

/// Reads one dataset, section by section.
class DatasetReader
{
public:
  DatasetReader(LegacyVtk& file, EulerRead what,
    const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset);

  void read();

private:
  static const VtkSection<DatasetReader> sections[];

  void read_header();
  void read_section();
  void end_sections(bool at_end);
  void read_points();
  void read_vertices();
  void read_dimensions();
  void read_coordinates();
  void read_cells();
  void read_types();
  void begin_data(bool of_cells);
  bool take(const VtkArray& array);
  void check(const VtkArray& array) const;
  void check_arrays();
  void find_centres();
  bool keep() const noexcept { return what_ == EulerRead::Values; }

  LegacyVtk& file_;
  EulerRead what_;
  const std::function<bool(std::string_view)>& wanted_;
  EulerDataset& dataset_;
  EulerFrame& frame_;
  VtkSections<DatasetReader> sections_;
  bool is_data_ = false;    ///< arrays are of the cells
  std::int64_t tuples_ = 0; ///< of the arrays at hand

  std::array<std::int64_t, 3> dimensions_ = {};
  std::array<std::int64_t, 3> counts_ = {}; ///< of coordinates
  VtkPlace dimensions_place_;

  std::vector<double> corners_;
  VtkCells cells_; ///< hexahedra
  std::int64_t types_ = 0;
  VtkPlace types_place_;
};

const VtkSection<DatasetReader> DatasetReader::sections[] = {
  { points, "POINTS", &DatasetReader::read_points },
  { points, "VERTICES", &DatasetReader::read_vertices, true },
  { rectilinear, "DIMENSIONS", &DatasetReader::read_dimensions },
  { rectilinear, "X_COORDINATES", &DatasetReader::read_coordinates },
  { rectilinear, "Y_COORDINATES", &DatasetReader::read_coordinates },
  { rectilinear, "Z_COORDINATES", &DatasetReader::read_coordinates },
  { unstructured, "POINTS", &DatasetReader::read_points },
  { unstructured, "CELLS", &DatasetReader::read_cells },
  { unstructured, "CELL_TYPES", &DatasetReader::read_types },
};

DatasetReader::DatasetReader(LegacyVtk& file, EulerRead what,
  const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset)
  : file_(file)
  , what_(what)
  , wanted_(wanted)
  , dataset_(dataset)
  , frame_(dataset.frame)
  , sections_(file, sections)
{
}

void DatasetReader::read()
{
  this->read_header();
  while (!(what_ == EulerRead::Look && dataset_.is_euler()) && file_.next())
  {
    this->read_section();
  }
  this->end_sections(true);
  this->check_arrays();
  if (this->keep())
  {
    this->find_centres();
  }
}

void DatasetReader::read_header()
{
  dataset_.header = file_.read_header();
  const std::string& kind = dataset_.header.dataset;
  const std::string expected = "DATASET POLYDATA, RECTILINEAR_GRID or UNSTRUCTURED_GRID";
  if (kind.empty())
  {
    file_.fail_missing(expected);
  }
  if (kind != points && kind != rectilinear && kind != unstructured)
  {
    file_.fail(expected, kind);
  }
}

void DatasetReader::read_section()
{
  if (file_.is("CELL_DATA") || file_.is("POINT_DATA"))
  {
    this->begin_data(file_.is("CELL_DATA"));
  }
  else if (!sections_.read(dataset_.header.dataset, *this))
  {
    const bool is_table = file_.is("LOOKUP_TABLE"); // of colours
    const auto take = [this](const VtkArray& array) { return this->take(array); };
    if (!file_.take_arrays(tuples_, is_table ? LegacyVtk::TakeArray() : take))
    {
      file_.fail("a section of Euler cells", file_.words().front());
    }
  }
}

/// All sections must have been there, and agree.
void DatasetReader::end_sections(bool at_end)
{
  sections_.end(dataset_.header.dataset, at_end);
  if (dataset_.header.dataset == rectilinear && counts_ != dimensions_)
  {
    const auto text = [](const std::array<std::int64_t, 3>& counts)
    {
      return std::to_string(counts[0]) + " " + std::to_string(counts[1]) + " " +
        std::to_string(counts[2]);
    };
    throw FormatError(
      "expected DIMENSIONS " + text(counts_) + " as of the coordinates, got " + text(dimensions_),
      file_.where(dimensions_place_));
  }
  if (dataset_.header.dataset == rectilinear)
  {
    frame_.cells = cells_between(counts_);
  }
  else if (dataset_.header.dataset == unstructured && types_ != frame_.cells)
  {
    throw FormatError("expected CELL_TYPES of " + std::to_string(frame_.cells) + " cells, got " +
        std::to_string(types_),
      file_.where(types_place_));
  }
}

void DatasetReader::read_points()
{
  const VtkArray array = file_.values(3);
  const bool are_centres = dataset_.header.dataset == points;
  frame_.cells = are_centres ? array.tuples : 0;
  file_.take(array, this->keep(), are_centres ? frame_.centres : corners_);
}

/// Values are of points: what the vertices are does not matter, as long as there is nothing wrong with them.
void DatasetReader::read_vertices()
{
  const std::int64_t first = file_.count(1);
  const std::int64_t second = file_.count(2);
  const VtkCells vertices = file_.cells(this->keep());
  dataset_.has_vertices =
    vertices.counted ? second / 2 == first && second % 2 == 0 : second == vertices.size;
  const auto& numbers = vertices.connectivity;
  const auto other = std::find_if(numbers.begin(), numbers.end(),
    [this](std::int64_t number) { return number < 0 || number >= frame_.cells; });
  if (other != numbers.end())
  {
    const auto after =
      std::upper_bound(vertices.offsets.begin(), vertices.offsets.end(), other - numbers.begin());
    const std::int64_t vertex = after - vertices.offsets.begin() - 1;
    throw FormatError("expected points from 0 to " + std::to_string(frame_.cells - 1) +
        " in vertex " + std::to_string(vertex) + ", got " + std::to_string(*other),
      file_.where_of(vertices, vertex));
  }
}

void DatasetReader::read_dimensions()
{
  dimensions_ = { file_.count(1), file_.count(2), file_.count(3) };
  dimensions_place_ = file_.line_place();
}

void DatasetReader::read_coordinates()
{
  const VtkArray array = file_.values(1);
  const auto axis = static_cast<std::size_t>((file_.words().front().front() | 0x20) - 'x');
  if (array.tuples < 2)
  {
    file_.fail("at least 2 coordinates", file_.words()[1]);
  }
  counts_[axis] = array.tuples;
  file_.take(array, this->keep(), frame_.faces[axis]);
}

void DatasetReader::read_cells()
{
  cells_ = read_eight_point_cells(file_, this->keep());
  frame_.cells = cells_.size;
}

void DatasetReader::read_types()
{
  const VtkArray array = { {}, ValueType::Int32, 1, file_.count(1) };
  types_ = array.tuples;
  types_place_ = file_.line_place();
  std::vector<std::int64_t> types;
  const VtkPlace first = file_.place();
  file_.take(array, what_ != EulerRead::Names, types);
  check_types(types, [&](std::int64_t cell) { return file_.where_of(first, array, cell); });
}

void DatasetReader::begin_data(bool of_cells)
{
  this->end_sections(false);
  const bool by_points = dataset_.header.dataset == points;
  tuples_ = file_.count(1);
  is_data_ = of_cells != by_points;
  if (is_data_ && tuples_ != frame_.cells)
  {
    file_.fail("data of " + std::to_string(frame_.cells) + (by_points ? " points" : " cells"),
      file_.words()[1]);
  }
}

/// Reads an array that is wanted.
bool DatasetReader::take(const VtkArray& array)
{
  if (!is_data_)
  {
    return false;
  }
  if (!is_number(array.type))
  {
    dataset_.texts.push_back(array.name);
    return false;
  }
  this->check(array);
  dataset_.names.push_back(array.name);
  if (!this->keep() || !wanted_(array.name))
  {
    return false;
  }
  EulerValues values = { array.name, static_cast<int>(array.components), {} };
  file_.read(array, values.values);
  frame_.arrays.push_back(std::move(values));
  return true;
}

void DatasetReader::check(const VtkArray& array) const
{
  const auto known = std::ranges::find(euler_arrays(), array.name, &EulerArray::name);
  const bool is_known = known != euler_arrays().end();
  const bool fits = is_known
    ? array.components == known->components
    : array.components > 0 && array.components <= std::numeric_limits<int>::max();
  if (!fits || array.tuples != frame_.cells)
  {
    const std::string components =
      is_known ? std::to_string(known->components) + " x " : "any number x ";
    file_.fail("values of '" + array.name + "', " + components + std::to_string(frame_.cells),
      std::to_string(array.components) + " x " + std::to_string(array.tuples));
  }
  if (dataset_.has(array.name))
  {
    file_.fail("one array of the name", array.name);
  }
}

/// A file that ends between two arrays may still be growing: LIGGGHTS writes all that it knows.
void DatasetReader::check_arrays()
{
  for (const EulerArray& array : euler_arrays())
  {
    const bool needed = dataset_.has_title() ? !array.optional : is_telling(array.name);
    if (what_ != EulerRead::Look && needed && frame_.cells > 0 && !dataset_.has(array.name))
    {
      file_.fail_missing("an array '" + std::string(array.name) + "'");
    }
  }
}

/// The middle of cells that have faces.
void DatasetReader::find_centres()
{
  const auto add = [this](double x, double y, double z) {
    frame_.centres.insert(frame_.centres.end(), { x, y, z });
  };
  if (dataset_.header.dataset == rectilinear)
  {
    const auto middle = [&](std::size_t axis, std::int64_t cell)
    {
      const double* const face = frame_.faces[axis].data() + cell;
      return std::midpoint(face[0], face[1]);
    };
    CellRange{ {}, { counts_[0] - 1, counts_[1] - 1, counts_[2] - 1 } }.each(
      [&](const std::array<std::int64_t, 3>& cell)
      { add(middle(0, cell[0]), middle(1, cell[1]), middle(2, cell[2])); });
  }
  for (std::int64_t cell = 0; dataset_.header.dataset == unstructured && cell < frame_.cells;
       ++cell)
  {
    const std::array<Vector3, corners_of_voxel> corners = corners_of(
      corners_, cells_, cell, [&](std::int64_t at) { return file_.where_of(cells_, at); });
    // the opposite corners of a box have the same middle, which is then rounded once
    const auto middle = [&](std::size_t axis)
    {
      const auto of = [&](std::size_t a, std::size_t b)
      { return std::midpoint(corners[a][axis], corners[b][axis]); };
      return std::midpoint(std::midpoint(of(0, 6), of(1, 7)), std::midpoint(of(2, 4), of(3, 5)));
    };
    add(middle(0), middle(1), middle(2));
  }
}
}

bool EulerDataset::has(std::string_view name) const noexcept
{
  return std::ranges::find(names, name) != names.end();
}

bool EulerDataset::is_euler() const noexcept
{
  return std::ranges::all_of(telling, [this](std::string_view name) { return this->has(name); });
}

bool EulerDataset::may_become_euler() const noexcept
{
  return this->has_title() && has_vertices &&
    std::ranges::all_of(names, [](const std::string& name) { return is_telling(name); });
}

bool EulerDataset::has_title() const noexcept
{
  return header.title == liggghts_title;
}

void read_dataset(LegacyVtk& file, EulerRead what,
  const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset)
{
  DatasetReader(file, what, wanted, dataset).read();
}
}
