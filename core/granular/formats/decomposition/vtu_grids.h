// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_decomposition_vtu_grids_h
#define granular_formats_decomposition_vtu_grids_h

#include "granular/formats/decomposition/decomposition_grid.h"
#include "granular/formats/vtk_files/vtk_xml.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The bytes of a .vtu file that are looked at: the names of its arrays, mostly not their values.
inline constexpr std::size_t vtu_head_bytes = std::size_t{ 1 } << 16;

/// The tags at the beginning of a file.
struct VtuHead
{
  bool unstructured = false;  ///< it is a .vtu file
  std::int64_t cells = 0;     ///< the sum of NumberOfCells of the pieces
  bool fits = true;           ///< all pieces have points, at most eight a cell
  bool has_particles = false; ///< there is an array nlocal of cells
  bool has_ranks = false;     ///< there is an array proc or procID of cells
};

/// Reads the tags as long as the text goes and they are right.
VtuHead look_at(std::string_view text);

/// The unstructured grids (pieces) in a .vtu file. Grids without cells are left out.
class VtuGrids
{
public:
  /// Finds the grids in a text, which must outlive this object. path is used in errors. Throws Error.
  VtuGrids(std::string_view text, const std::string& path);

  std::size_t size() const noexcept { return pieces_.size(); }
  std::int64_t cells() const noexcept { return cells_; } ///< of all

  /// Returns a grid. Throws Error.
  DecompositionGrid read(std::size_t grid) const;

  /// Returns the place of a cell of a grid, for messages.
  Where where_of(std::size_t grid, std::int64_t cell) const;

private:
  static constexpr std::size_t array_kinds = 7;

  struct Piece
  {
    std::int64_t points = 0;
    std::int64_t cells = 0;
    std::size_t begin = 0; ///< the byte of its tag
    std::array<std::optional<VtkXmlArray>, array_kinds> arrays;
  };

  void add_piece();
  void add_array();
  const VtkXmlArray& need(const Piece& piece, std::size_t kind) const;
  void read_cells(const Piece& piece, DecompositionGrid& grid) const;
  void read_data(const Piece& piece, DecompositionGrid& grid) const;
  void check_components(const VtkXmlArray& array, std::int64_t components) const;

  VtkXml file_;
  std::vector<Piece> pieces_;
  std::int64_t cells_ = 0;
  bool keep_ = false; ///< arrays of the piece at hand: it has cells
};
}
#endif
