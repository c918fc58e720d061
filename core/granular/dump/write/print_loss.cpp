// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/print_loss.h"

#include "granular/geometry/positions.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace granular
{
namespace
{
constexpr int most_digits = 17; ///< that a double needs
constexpr int few_digits = 3; ///< 0.5 of the last of them can be more than RoundingLimit::of_value

bool is_exact(NumberFormat format) noexcept
{
  return format.digits == 0 || format.digits >= most_digits || format.exact;
}

/// The box that is read from numbers in that format.
Box printed_box(const Box& box, NumberFormat format)
{
  BoxBounds b = box.bounds();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    b.lo[axis] = as_printed(b.lo[axis], format);
    b.hi[axis] = as_printed(b.hi[axis], format);
  }
  return box.tilted ? Box::from_tilted_bounds(b.lo, b.hi, as_printed(b.xy, format),
                        as_printed(b.xz, format), as_printed(b.yz, format))
                    : Box::from_bounds(b.lo, b.hi);
}

/// A number up to which so many digits are wrong by no more than a distance.
double safe_magnitude(double distance, int digits) noexcept
{
  if (!(distance > 0))
  {
    return 0;
  }
  constexpr double most = 300; // no double has an exponent beyond that, but for a few
  double exponent = std::clamp(std::floor(std::log10(2 * distance)) + digits, -most, most);
  while (exponent > -most && 0.5 * std::pow(10, exponent - digits) > distance)
  {
    --exponent;
  }
  return std::pow(10, exponent) * (1 - 1e-12);
}
}

double smallest_radius(const FrameView& frame)
{
  const std::optional<ValueSource> radii = find_values(frame, "radius");
  RoundingLoss loss;
  if (!radii || radii->type == ValueType::Text)
  {
    return loss.radius();
  }
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  std::array<double, RowValues::most_rows> values;
  std::array<std::int64_t, RowValues::most_rows> rows;
  for (std::int64_t first = 0; first < frame.rows; first += most)
  {
    const std::int64_t count = std::min(frame.rows - first, most);
    std::iota(rows.begin(), rows.begin() + count, first);
    load_numbers(*radii, std::span(rows).first(static_cast<std::size_t>(count)), values.data());
    std::for_each(values.begin(), values.begin() + count,
      [&](double radius) { loss.add_radius(radius * radii->factor); });
  }
  return loss.radius();
}

NumberFormat box_numbers(const Box& box, Dialect dialect, const RoundingLimit& limit)
{
  constexpr NumberFormat all = { 0 };
  constexpr NumberFormat six = { 6 };
  constexpr double share = 0.1; // the rest is left for the coordinates
  if (dialect == Dialect::Lammps || box.general)
  {
    return all;
  }
  const Box read = printed_box(box, six);
  const Vector3 moved = distance_of_corners(box, read);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = box.vectors[axis][axis].value();
    const double change = std::abs(read.vectors[axis][axis].value() - length);
    if (moved[axis] > share * limit.distance[axis] || change > RoundingLimit::of_value * length)
    {
      return all;
    }
  }
  return six;
}

bool note_print_loss(const RoundingLoss& loss, const RoundingLimit& limit, const DumpFormat& format,
  const ColumnPlan& plan, Notices& notices)
{
  const bool local = format.style == DumpStyle::Local;
  const bool scaled = std::ranges::any_of(
    plan.columns, [](const ColumnSource& source) { return is_scaled(source.role); });
  const char* const setting = format.style == DumpStyle::Atom ? "Scaled=1" : "Style=Atom";
  const std::string text = loss.text(limit, local ? "ends of lines" : "particles", plan.names());
  if (text.empty())
  {
    return false;
  }
  Notice& notice = notices.emplace_back();
  notice.topic = "rounding";
  notice.text = std::string("rounding to ") +
    (format.binary ? "doubles " : to_text(format.numbers) + " ") + text +
    (format.binary ? "" : "; NumberFormat=%.17g keeps all digits") +
    (local || scaled
        ? ""
        : std::string("; scaled coordinates (") + setting + ") need fewer far from the origin");
  return true;
}

PrintLoss::PrintLoss(const ColumnPlan& plan, const FrameView& frame, const Box& box,
  const DumpFormat& format, const RoundingLimit& limit)
  : box_(box)
  , of_box_(format.numbers == automatic_numbers
        ? NumberFormat{ 6, true }
        : box_numbers(box, format.dialect.value_or(Dialect::Lammps), limit))
  , numbers_(format.binary ? NumberFormat{ 0 } : format.numbers)
{
  const bool exact_box = format.binary || is_exact(of_box_);
  const Vector3 of_box =
    exact_box ? Vector3{} : distance_of_corners(box, printed_box(box, of_box_));
  const bool is_sum = frame.point_origin != Vector3{} || frame.coordinates != Coordinates::Absolute;
  const Vector3 of_sums = is_sum ? rounding_of_points(box, {}) : Vector3{};
  for (std::size_t i = 0; i < plan.columns.size(); ++i)
  {
    if (is_position(plan.columns[i].role))
    {
      this->add_place(plan.columns[i], i, of_box, of_sums, limit);
    }
    else if (numbers_.digits > 0 && numbers_.digits <= few_digits)
    {
      values_.push_back(i);
    }
  }
}

void PrintLoss::add_place(const ColumnSource& source, std::size_t column, const Vector3& of_box,
  const Vector3& of_sums, const RoundingLimit& limit)
{
  const auto axis = static_cast<std::size_t>(source.axis);
  Place place{ column, {}, {}, HUGE_VAL };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const bool scaled = is_scaled(source.role);
    place.unit[k] = scaled ? std::abs(box_.vectors[axis][k].hi) : k == axis ? 1.0 : 0.0;
    place.moved[k] = place.unit[k] > 0 ? (scaled ? of_box : of_sums)[k] : 0;
    const double left = limit.distance[k] - place.moved[k];
    if (place.unit[k] > 0 && left < HUGE_VAL)
    {
      const bool exact = is_exact(numbers_) && left >= 0;
      const double safe = exact ? HUGE_VAL : safe_magnitude(left / place.unit[k], numbers_.digits);
      place.safe = std::min(place.safe, safe);
    }
  }
  if (place.safe < HUGE_VAL)
  {
    places_.push_back(place);
  }
}

void PrintLoss::measure(const RowValues& values, RoundingLoss& loss) const
{
  const auto is_real = [&](std::size_t column)
  { return values.columns()[column].type == ValueType::Float64; };
  for (const Place& place : places_)
  {
    if (is_real(place.column))
    {
      this->measure_place(place, values, loss);
    }
  }
  for (const std::size_t column : values_)
  {
    if (is_real(column))
    {
      this->measure_values(column, values, loss);
    }
  }
}

void PrintLoss::measure_place(const Place& place, const RowValues& values, RoundingLoss& loss) const
{
  const RowValues::Column& column = values.columns()[place.column];
  std::int64_t unsafe = 0; // of 64 bits, as the values: vector instructions count
  for (std::size_t row = 0; row < values.rows(); ++row)
  {
    unsafe += std::abs(column.at<double>(row)) > place.safe ? 1 : 0;
  }
  for (std::size_t row = 0; unsafe > 0 && row < values.rows(); ++row)
  {
    const double value = column.at<double>(row);
    const double moved = std::abs(as_printed(value, numbers_) - value);
    for (std::size_t k = 0; k < 3; ++k)
    {
      loss.move(k, moved * place.unit[k] + place.moved[k]);
    }
  }
}

void PrintLoss::measure_values(
  std::size_t column, const RowValues& values, RoundingLoss& loss) const
{
  const RowValues::Column& numbers = values.columns()[column];
  for (std::size_t row = 0; row < values.rows(); ++row)
  {
    const double value = numbers.at<double>(row);
    const bool whole = numbers.whole && std::trunc(value) == value;
    if (!whole)
    {
      loss.change(column, value, as_printed(value, numbers_));
    }
  }
}
}
