// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/row_batches.h"

#include "granular/geometry/positions.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace granular
{
namespace
{
bool is_exact(NumberFormat format) noexcept
{
  constexpr int most_digits = 17; // that a double needs
  return format.digits == 0 || format.digits >= most_digits || format.exact;
}

/// The distance by which printing moves the corners of a box along each axis, at most.
Vector3 moved_corners(const Box& box, NumberFormat format)
{
  if (is_exact(format))
  {
    return {};
  }
  const auto lost = [&](double number) { return std::abs(as_printed(number, format) - number); };
  const BoxBounds b = box.bounds();
  Vector3 moved = { lost(b.xy) + lost(b.xz), lost(b.yz), 0 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    moved[axis] += std::max(lost(b.lo[axis]), lost(b.hi[axis]));
  }
  return moved;
}

NumberFormat box_numbers(const Box& box, const DumpFormat& format, const Vector3& limit)
{
  constexpr NumberFormat six = { 6 };
  constexpr double share = 0.1; // of the limit: the rest is left for the coordinates
  if (format.numbers == automatic_numbers)
  {
    return { 6, true };
  }
  bool enough = format.dialect == Dialect::Liggghts && !box.general;
  const Vector3 moved = enough ? moved_corners(box, six) : Vector3{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    enough = enough && moved[axis] <= share * limit[axis];
  }
  return enough ? six : NumberFormat{ 0 };
}
}

PrintLoss::PrintLoss(
  const ColumnPlan& plan, const Box& box, const DumpFormat& format, double smallest_radius)
  : numbers_(format.numbers)
{
  const Vector3 limit = largest_movement(box, smallest_radius);
  of_box_ = box_numbers(box, format, limit);
  if (format.binary || is_exact(numbers_))
  {
    return;
  }
  const Vector3 of_box = moved_corners(box, of_box_);
  const double part = 0.5 * std::pow(10, 1 - numbers_.digits); // half of the last digit of 1
  for (std::size_t i = 0; i < plan.columns.size(); ++i)
  {
    const ColumnSource& source = plan.columns[i];
    const bool scaled = is_scaled(source.role);
    const auto axis = static_cast<std::size_t>(source.axis);
    Column column{ i, HUGE_VAL, is_position(source.role), {}, {} };
    for (std::size_t k = 0; column.place && k < 3; ++k)
    {
      column.unit[k] = scaled ? std::abs(box.vectors[axis][k].hi) : k == axis ? 1.0 : 0.0;
      if (column.unit[k] > 0)
      {
        column.moved[k] = scaled ? of_box[k] : 0;
        column.safe = std::min(column.safe, (limit[k] - column.moved[k]) / (part * column.unit[k]));
      }
    }
    if (!column.place && part > RoundingLoss::of_value)
    {
      column.safe = 0;
    }
    if (column.safe < HUGE_VAL)
    {
      columns_.push_back(column);
    }
  }
}

void PrintLoss::measure(const RowValues& values, RoundingLoss& loss) const
{
  for (const Column& column : columns_)
  {
    const RowValues::Column& numbers = values.columns()[column.index];
    if (numbers.type != ValueType::Float64)
    {
      continue;
    }
    std::int64_t unsafe = 0; // of 64 bits, as the values: vector instructions count
    for (std::size_t row = 0; row < values.rows(); ++row)
    {
      unsafe += std::abs(numbers.at<double>(row)) > column.safe ? 1 : 0;
    }
    for (std::size_t row = 0; unsafe > 0 && row < values.rows(); ++row)
    {
      const double value = numbers.at<double>(row);
      const double rounded = as_printed(value, numbers_);
      for (std::size_t k = 0; column.place && k < 3; ++k)
      {
        loss.move(k, std::abs(rounded - value) * column.unit[k] + column.moved[k]);
      }
      const bool whole = numbers.whole && std::trunc(value) == value; // has all its digits
      if (!column.place && !whole)
      {
        loss.change(column.index, value, rounded);
      }
    }
  }
}

bool note_print_loss(const RoundingLoss& loss, const Box& box, const DumpFormat& format,
  const ColumnPlan& plan, Notices& notices)
{
  const bool local = format.style == DumpStyle::Local;
  const bool scaled = std::ranges::any_of(
    plan.columns, [](const ColumnSource& source) { return is_scaled(source.role); });
  const std::string setting = format.style == DumpStyle::Atom ? "Scaled=1" : "Style=Atom";
  return note_loss(loss.text(box, local ? "ends of lines" : "particles", plan.names()),
    "rounding to " + to_text(format.numbers),
    "NumberFormat=%.17g keeps all digits" +
      (local || scaled ? ""
                       : "; scaled coordinates (" + setting + ") need fewer far from the origin"),
    {}, "rounding", notices);
}
}
