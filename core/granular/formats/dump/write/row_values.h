// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_row_values_h
#define granular_formats_dump_write_row_values_h

#include "granular/formats/dump/write/column_plan.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The values of some rows of a frame, column by column, for the columns of a dump.
class RowValues
{
public:
  static constexpr std::size_t most_rows = 256; ///< at a time: they stay in the nearest cache

  RowValues() = default;
  RowValues(RowValues&&) = default; // a copy would show the numbers of the other
  RowValues& operator=(RowValues&&) = default;

  /// One column: integers, real numbers or texts.
  struct Column
  {
    ValueType type = ValueType::Float64; ///< Int32, Int64, Float64 or Text
    bool whole = false;                  ///< reals: integral ones are shown with all their digits
    const void* data =
      nullptr; ///< of numbers: in the arrays of the frame or of this, until the next load
    std::int64_t step = 1; ///< numbers from one row to the next
    std::vector<const std::string*> texts = {};

    /// Returns where the number of a row is. The type must be that of the column.
    template <class Number>
    const Number* from(std::size_t row) const noexcept
    {
      return static_cast<const Number*>(data) + static_cast<std::int64_t>(row) * step;
    }
    template <class Number>
    Number at(std::size_t row) const noexcept
    {
      return *this->from<Number>(row);
    }
  };

  /// Loads rows [first, first + count) of the view without duplicates, count <= most_rows. row_number: of the first row that
  /// is kept, from 0, among the rows of all ranks. Throws LimitError for integers of 2^63 and more.
  void load(const FrameView& frame, const ColumnPlan& plan, const Box& box, std::int64_t first,
    std::int64_t count, std::int64_t row_number);

  std::size_t rows() const noexcept { return rows_; } ///< that are kept
  std::span<const Column> columns() const noexcept { return columns_; }

private:
  template <class Number>
  std::span<Number> make(std::vector<std::vector<Number>>& all, std::size_t column);
  bool find_in_place(const ColumnSource& source, Column& column) const noexcept;
  void load_array(const ColumnSource& source, std::size_t column, bool as_doubles);
  void load_points(const FrameView& frame, const ColumnPlan& plan);
  std::span<const double> coordinates(const FrameView& frame, ColumnRole role);
  void load_coordinate(
    const FrameView& frame, const Box& box, const ColumnSource& source, std::span<double> to);

  std::span<const std::int64_t> kept() const noexcept { return std::span(kept_).first(rows_); }

  std::vector<std::int64_t> kept_; ///< rows of the view
  std::size_t rows_ = 0;
  bool contiguous_ = true; ///< the rows that are kept
  std::vector<Column> columns_;
  std::vector<std::vector<std::int64_t>> integers_; ///< of columns that are made
  std::vector<std::vector<double>> reals_;          ///< of columns that are made
  Box box_;                                  ///< in the coordinates of the points, see point_origin
  std::vector<double> points_;               ///< three of each row
  std::vector<double> images_;               ///< three of each row
  std::array<std::vector<double>, 4> forms_; ///< of the points, if needed: see form_of
  std::vector<double> own_;
};
}
#endif
