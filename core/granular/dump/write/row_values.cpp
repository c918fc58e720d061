// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/row_values.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace granular
{
namespace
{
using Kind = ColumnSource::Kind;
using Rows = std::span<const std::int64_t>;

/// LAMMPS and LIGGGHTS add the image count and 512 to a scaled coordinate, and then take 512 off.
constexpr double image_rounding = 0x1p-44;

void check_unsigned(const ColumnSource& source, Rows rows)
{
  const auto* values = static_cast<const std::uint64_t*>(source.values.data);
  for (const std::int64_t row : rows)
  {
    if (values[row * source.values.step] > std::numeric_limits<std::int64_t>::max())
    {
      throw LimitError(
        "expected integers below 2^63, got " + std::to_string(values[row * source.values.step]),
        { .column = source.name });
    }
  }
}

void load_array(const ColumnSource& source, Rows rows, bool as_doubles, RowValues::Column& column)
{
  const ValueSource& values = source.values;
  if (values.type == ValueType::Text)
  {
    const auto* texts = static_cast<const std::string*>(values.data);
    column.type = ValueType::Text;
    column.texts.resize(rows.size());
    std::transform(rows.begin(), rows.end(), column.texts.begin(),
      [&](std::int64_t row) { return texts + row * values.step; });
  }
  else if (is_integer(values.type) && values.factor == 1 &&
    !(as_doubles && values.type < ValueType::Int64))
  {
    if (values.type == ValueType::UInt64)
    {
      check_unsigned(source, rows);
    }
    column.type = ValueType::Int64;
    column.integers.resize(rows.size());
    load_numbers(values, rows, column.integers.data());
  }
  else
  {
    column.type = ValueType::Float64;
    column.reals.resize(rows.size());
    load_numbers(values, rows, column.reals.data());
    for (double& value : column.reals)
    {
      value *= values.factor;
    }
  }
}

std::int64_t as_image(double count, const std::string& name)
{
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  if (!(std::abs(count) <= most) || std::trunc(count) != count)
  {
    throw LimitError(
      "expected image counts of whole numbers below 2^31, got " + std::to_string(count),
      { .column = name });
  }
  return static_cast<std::int64_t>(count);
}

std::size_t form_of(ColumnRole role) noexcept
{
  return static_cast<std::size_t>(role) - static_cast<std::size_t>(ColumnRole::Position);
}

/// How far a coordinate of the form may be from what another program or an earlier rounding made of the same
/// point, for a coordinate of 0 and no crossing, along each axis: the sum of the magnitudes of all terms.
Vector3 magnitudes(const Box& box, const Box& moved, ColumnRole role) noexcept
{
  Vector3 sums;
  for (std::size_t k = 3; k-- > 0;)
  {
    sums[k] = std::abs(box.origin[k].hi) + std::abs(moved.origin[k].hi - box.origin[k].hi);
    for (const Twofold3& edge : box.vectors)
    {
      sums[k] += std::abs(edge[k].hi);
    }
    for (std::size_t j = k + 1; is_scaled(role) && j < 3; ++j)
    {
      sums[k] += std::abs(box.vectors[j][k].hi) * sums[j];
    }
    if (is_scaled(role))
    {
      sums[k] = box.general ? 0 : sums[k] / std::abs(box.vectors[k][k].hi);
    }
  }
  return sums;
}

/// Whether a coordinate depends on no other, nor on image counts.
bool scales_alone(const ColumnSource& source, const FrameView& frame, const Box& box) noexcept
{
  return source.role == ColumnRole::ScaledPosition && !source.own && source.kept_digits() == 0 &&
    !box.tilted && frame.coordinates == Coordinates::Absolute;
}

/// Replaces a value by the number with so many digits, or by 0, if that is within what is allowed.
void put_back_digits(double& value, int digits, double allowed) noexcept
{
  const double printed = std::abs(value) <= allowed ? 0 : as_printed(value, { digits });
  value = std::abs(printed - value) <= allowed ? printed : value;
}
}

void RowValues::load_points(const FrameView& frame, const ColumnPlan& plan)
{
  own_.resize(rows_);
  points_.resize(frame.points ? 3 * rows_ : 0);
  images_.assign(3 * rows_, 0);
  const auto load_axis = [&](const ValueSource& source, std::size_t axis, std::vector<double>& to)
  {
    load_numbers(source, std::span(kept_).first(rows_), own_.data());
    for (std::size_t i = 0; i < rows_; ++i)
    {
      to[3 * i + axis] = own_[i];
    }
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (frame.points)
    {
      load_axis(point_values(frame, axis), axis, points_);
    }
    if (plan.images[axis])
    {
      load_axis(*plan.images[axis], axis, images_);
    }
  }
  if (plan.wraps)
  {
    count_crossings(box_, points_, images_);
  }
  std::ranges::for_each(forms_, [](std::vector<double>& form) { form.clear(); });
}

std::span<const double> RowValues::coordinates(const FrameView& frame, ColumnRole role)
{
  std::vector<double>& form = forms_[form_of(role)];
  if (form.empty())
  {
    const bool same_units = is_scaled(role) == (frame.coordinates == Coordinates::Scaled);
    const auto& [x, y, z] = frame.point_origin;
    form = points_;
    convert_positions(plan_form(frame.coordinates, role), box_,
      same_units ? Vector3{ -x, -y, -z } : Vector3{}, images_, form);
  }
  return form;
}

void RowValues::load_coordinate(
  const FrameView& frame, const Box& box, const ColumnSource& source, std::vector<double>& to)
{
  const std::span<const double> all = this->coordinates(frame, source.role);
  const auto axis = static_cast<std::size_t>(source.axis);
  to.resize(rows_);
  for (std::size_t i = 0; i < rows_; ++i)
  {
    to[i] = all[3 * i + axis];
  }
  if (!source.own && source.kept_digits() == 0)
  {
    return;
  }
  // the file's own number, where it is that of the point within rounding: its last digits are its own
  if (source.own)
  {
    load_numbers(source.values, std::span(kept_).first(rows_), own_.data());
  }
  const double unit = frame.points->type == ValueType::Float32 ? 0x1p-22 : 0x1p-50;
  const double magnitude = magnitudes(box, box_, source.role)[axis];
  const double biased = source.role == ColumnRole::ScaledUnwrappedPosition ? image_rounding : 0;
  for (std::size_t i = 0; i < rows_; ++i)
  {
    const double* image = images_.data() + 3 * i;
    const double crossed = std::max({ std::abs(image[0]), std::abs(image[1]), std::abs(image[2]) });
    const double allowed = unit * (magnitude * (1 + crossed) + std::abs(to[i])) + biased;
    if (source.own)
    {
      to[i] = std::abs(own_[i] - to[i]) <= allowed ? own_[i] : to[i];
    }
    else
    {
      put_back_digits(to[i], source.kept_digits(), allowed);
    }
  }
}

void RowValues::load(const FrameView& frame, const ColumnPlan& plan, const Box& box,
  std::int64_t first, std::int64_t count, std::int64_t row_number)
{
  kept_.resize(most_rows);
  rows_ = static_cast<std::size_t>(count);
  std::iota(kept_.begin(), kept_.begin() + count, first);
  if (frame.ghosts)
  {
    const auto end = std::remove_if(kept_.begin(), kept_.begin() + count,
      [&](std::int64_t row) { return frame.is_duplicate(row); });
    rows_ = static_cast<std::size_t>(end - kept_.begin());
  }
  const Rows rows = std::span(kept_).first(rows_);
  columns_.resize(plan.columns.size());
  const auto is_derived = [&](const ColumnSource& source)
  {
    return source.kind == Kind::Image ||
      (source.kind == Kind::Coordinate && !scales_alone(source, frame, box));
  };
  box_ = frame.point_origin == Vector3{} ? box : box_of_points(frame, box);
  if (std::any_of(plan.columns.begin(), plan.columns.end(), is_derived))
  {
    this->load_points(frame, plan);
  }
  for (std::size_t i = 0; i < columns_.size(); ++i)
  {
    const ColumnSource& source = plan.columns[i];
    Column& column = columns_[i];
    column.type = ValueType::Float64;
    column.whole = source.whole;
    switch (source.kind)
    {
      case Kind::Array:
        load_array(source, rows, plan.binary, column);
        if (source.kept_digits() > 0 && source.values.type == ValueType::Float32)
        {
          constexpr double half_unit = 0x1p-24;
          std::ranges::for_each(column.reals,
            [&](double& value)
            { put_back_digits(value, source.kept_digits(), half_unit * std::abs(value)); });
        }
        break;
      case Kind::Coordinate:
        if (scales_alone(source, frame, box))
        {
          const auto axis = static_cast<std::size_t>(source.axis);
          column.reals.resize(rows_);
          load_numbers(point_values(frame, axis), rows, column.reals.data());
          scale_aligned(box_, axis, column.reals);
          break;
        }
        this->load_coordinate(frame, box, source, column.reals);
        break;
      case Kind::Image:
        column.type = ValueType::Int64;
        column.integers.resize(rows_);
        for (std::size_t row = 0; row < rows_; ++row)
        {
          column.integers[row] =
            as_image(images_[3 * row + static_cast<std::size_t>(source.axis)], source.name);
        }
        break;
      case Kind::RowNumber:
        column.type = ValueType::Int64;
        column.integers.resize(rows_);
        std::iota(column.integers.begin(), column.integers.end(), row_number + 1);
        break;
      case Kind::One:
        column.type = ValueType::Int64;
        column.integers.assign(rows_, 1);
        break;
    }
  }
}
}
