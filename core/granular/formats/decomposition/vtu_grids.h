// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_decomposition_vtu_grids_h
#define granular_formats_decomposition_vtu_grids_h

#include "granular/formats/decomposition/decomposition_grid.h"
#include "granular/formats/vtk_files/vtk_xml.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The bytes of a .vtu file that are looked at: the names of its arrays, mostly not their values.
inline constexpr std::size_t vtu_head_bytes = std::size_t{ 1 } << 16;

/// Returns true if a text begins as a .vtu file does.
bool is_vtu(std::string_view text);

/// The unstructured grids (pieces) in a .vtu file. Grids without cells are left out.
class VtuGrids
{
public:
  /// Finds the grids in a text, which must outlive this object, as far as the text goes and is right. path is used in errors.
  VtuGrids(std::string_view text, const std::string& path);

  /// Throws the Error that ended the search for grids, if any.
  void check() const;

  std::size_t size() const noexcept { return pieces_.size(); }
  std::int64_t cells() const noexcept { return cells_; } ///< of all

  /// Returns true if all pieces have points, at most eight a cell, and there is an array nlocal of cells.
  bool may_be_subdomains() const noexcept;

  /// Returns true if there is an array proc or procID of cells.
  bool has_ranks() const noexcept;

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

  void find_grids();
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
  bool fits_ = true;
  std::array<bool, array_kinds> seen_ = {}; ///< in any piece
  std::exception_ptr error_;
};
}
#endif
