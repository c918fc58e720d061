// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_line_rows_h
#define granular_lines_line_rows_h

#include "granular/common/progress.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
/// Rows that name particles at the ends of lines: contacts and bonds, each of which counts once. Of lines that were split at periodic
/// faces, which are several cells with integers `part`, those with part 0 count. Duplicates are left out.
class LineRows
{
public:
  /// The cells, or rows of a table, must outlive this. are_lines: they are lines, which may be split.
  LineRows(const FrameView& cells, bool are_lines);

  const FrameView& cells() const { return *cells_; }
  std::int64_t count() const { return are_all_ ? cells_->rows : std::ssize(own_); }

  /// Returns true if each cell is a row.
  bool are_all_cells() const { return are_all_; }

  /// Returns the cell of a row; for a split line the first one.
  std::int64_t cell_of(std::int64_t row) const
  {
    return are_all_ ? row : own_[static_cast<std::size_t>(row)];
  }

  /// Returns the cells at which each row begins and ends. Throws Error if the parts of a line are not consecutive.
  std::vector<std::int64_t> find_begins() const;
  std::vector<std::int64_t> find_ends() const;

  /// Keeps rows [first, last).
  void keep(std::pair<std::int64_t, std::int64_t> range);

  bool has(std::string_view name) const { return cells_->find(name) != nullptr; }

  /// Returns true if an array has one number per row.
  bool has_numbers(std::string_view name) const;

  /// Returns true if there are parts of split lines.
  bool has_parts() const;

  /// Returns true for lines of a reader whose file names the ends by id alone: there are none, and the rows are elsewhere.
  bool lack_places() const;

  /// Returns the ids of all rows. Throws Error if the array is missing or holds other numbers; Cancelled.
  std::vector<std::int64_t> read_ids(const std::string& name, Progress& progress) const;

  /// Returns an array with so many numbers for each row: in place if they lie so in memory, otherwise in `own`. Throws Error if there
  /// are other numbers, or texts.
  std::span<const double> read_tuples(
    const std::string& name, int numbers, std::vector<double>& own) const;

private:
  const ArrayView& see(const std::string& name, int numbers = 1) const;
  std::vector<double> parts() const;

  const FrameView* cells_;
  bool are_lines_;
  bool are_all_ = true;           ///< each cell is a row
  std::vector<std::int64_t> own_; ///< cells of the rows, where not all are
};

/// Returns what to tell if particles and rows are of different timesteps; nothing if one of them does not say.
std::string compare_timesteps(
  std::optional<std::int64_t> particles, std::optional<std::int64_t> rows);
}
#endif
