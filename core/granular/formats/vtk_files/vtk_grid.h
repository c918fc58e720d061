// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_vtk_files_vtk_grid_h
#define granular_formats_vtk_files_vtk_grid_h

#include "granular/common/error.h"
#include "granular/formats/vtk_files/legacy_vtk.h"
#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace granular
{
inline constexpr std::string_view vtk_points = "POLYDATA";
inline constexpr std::string_view vtk_rectilinear = "RECTILINEAR_GRID";
inline constexpr std::string_view vtk_unstructured = "UNSTRUCTURED_GRID";

/// The number of points of a voxel or hexahedron.
inline constexpr int corners_of_voxel = 8;

/// Returns the place of a value of a list, for messages.
using WhereOf = std::function<Where(std::int64_t)>;

/// Reads the cells that the current line of the file begins. keep: store their points. Throws FormatError if a cell
/// does not have eight points.
VtkCells read_eight_point_cells(LegacyVtk& file, bool keep);

/// Throws FormatError: a cell has another number of points.
[[noreturn]] void fail_points_of_cell(std::int64_t points, const Where& where);

/// Throws UnsupportedError if a cell is neither a voxel nor a hexahedron.
void check_types(const std::vector<std::int64_t>& types, const WhereOf& where_of);

/// Returns the eight points of a cell in its order. points: x y z of each point. Throws FormatError if a point is
/// missing.
std::array<Vector3, corners_of_voxel> corners_of(std::span<const double> points,
  const VtkCells& cells, std::int64_t cell, const WhereOf& where_of);

/// Points, a rectilinear grid or an unstructured one, as it stands in a file. Vectors are filled only if they were to be kept.
struct VtkGrid
{
  VtkHeader header;
  std::int64_t cells = 0; ///< of POLYDATA points
  std::vector<double> points;
  bool has_vertices = false; ///< of one point each

  std::array<std::int64_t, 3> dimensions = {}; ///< as DIMENSIONS says
  VtkPlace dimensions_place;
  std::array<std::int64_t, 3> counts = {};             ///< of coordinates
  std::array<std::vector<double>, 3> coordinates = {}; ///< in any order

  VtkCells voxels; ///< of eight points each, all of them there
};

/// Reads the sections of a grid, each of which may occur once, from the lines of a file.
class VtkGridReader
{
public:
  /// keep: store the numbers. check: read the types of cells, which must be voxels or hexahedra. grid has the header.
  VtkGridReader(LegacyVtk& file, VtkGrid& grid, bool keep, bool check) noexcept
    : file_(file)
    , grid_(grid)
    , keep_(keep)
    , check_(check)
  {
  }

  /// Reads the section that the line begins. Returns false if the line begins no section of this dataset. Throws
  /// FormatError for a repeated section; UnsupportedError for other types of cells.
  bool read();

  /// Counts the cells. Throws FormatError if a section is missing at the end, or before the current line, which begins the
  /// data, or if there are not as many types as cells.
  void end(bool at_end);

private:
  void read_points();
  void read_vertices();
  void read_dimensions();
  void read_coordinates();
  void read_cells();
  void read_types();

  struct Section
  {
    std::string_view dataset;
    const char* keyword;
    void (VtkGridReader::*read)();
    bool optional = false;
  };
  static const Section sections[];

  LegacyVtk& file_;
  VtkGrid& grid_;
  bool keep_;
  bool check_;
  std::uint32_t seen_ = 0; ///< a bit each
  std::int64_t types_ = 0;
  VtkPlace types_place_;
};
}
#endif
