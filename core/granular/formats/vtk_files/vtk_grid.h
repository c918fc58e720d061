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
#include <string>
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
  bool has_vertices = false;     ///< of one point each
  std::array<VtkCells, 4> parts; ///< VERTICES, LINES, POLYGONS, TRIANGLE_STRIPS

  std::array<std::int64_t, 3> dimensions = {}; ///< as DIMENSIONS says
  VtkPlace dimensions_place;
  std::array<std::int64_t, 3> counts = {};             ///< of coordinates
  std::array<std::vector<double>, 3> coordinates = {}; ///< in any order

  VtkCells voxels; ///< of eight points each, all of them there
};

/// Reads a dataset section by section: those of the grid, each of which may occur once, and the arrays of its points or cells.
/// A derived class tells what a dataset of its format must have besides.
class VtkGridReader
{
public:
  virtual ~VtkGridReader() = default;

  /// Reads from the header to the next one or to the end. kinds: of datasets that may be; whose: sections, for messages; cause:
  /// see LegacyVtk::fail_missing. Throws FormatError for another dataset, a section that is unknown, missing or repeated, a cell
  /// without eight points, and data of other numbers of points or cells; UnsupportedError for other types of cells.
  void read(std::span<const std::string_view> kinds, const std::string& whose,
    const std::string& cause = "");

protected:
  /// keep: store the numbers. check: read the types of cells, which must be voxels or hexahedra, and of
  /// surfaces the cells. surfaces: POLYDATA may have other parts than vertices.
  VtkGridReader(
    LegacyVtk& file, VtkGrid& grid, bool keep, bool check, bool surfaces = false) noexcept
    : file_(file)
    , keep_(keep)
    , check_(check)
    , surfaces_(surfaces)
    , grid_(grid)
  {
  }

  virtual bool is_enough() const { return false; } ///< no more has to be read
  virtual void begin_section() {}                  ///< a line of any but data
  virtual void end_grid() {}                       ///< all sections of the grid were there
  virtual void begin_data() {}                     ///< behind CELL_DATA or POINT_DATA
  virtual bool take(const VtkArray& array) = 0;    ///< see LegacyVtk::TakeArray

  /// Takes the arrays that the line begins. Returns false if it begins none.
  bool take_arrays();

  LegacyVtk& file_;
  bool keep_;
  bool check_;
  bool surfaces_;
  bool of_cells_ = false; ///< the data at hand
  bool is_data_ = false;  ///< these are of the cells, or of the points where these stand for cells

private:
  void read_points();
  void read_parts();
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
    bool is_surface = false;
  };
  static const Section sections[];

  bool read_section();
  void read_data(bool of_cells);
  void end_sections(bool at_end);

  VtkGrid& grid_;
  std::int64_t tuples_ = 0; ///< of the arrays at hand
  std::uint32_t seen_ = 0;  ///< a bit each
  std::int64_t types_ = 0;
  VtkPlace types_place_;
};
}
#endif
