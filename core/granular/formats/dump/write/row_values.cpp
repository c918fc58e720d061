// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/row_values.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>

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

/// Programs read no text whose ids are other numbers. In binary dumps all are doubles.
void check_ids(const RowValues::Column& column, std::size_t rows, const std::string& name)
{
  for (std::size_t row = 0; column.type == ValueType::Float64 && row < rows; ++row)
  {
    const auto id = column.at<double>(row);
    if (std::trunc(id) != id || !(std::abs(id) < 0x1p63))
    {
      throw LimitError(
        "expected ids of whole numbers below 2^63, got " + to_text(id), { .column = name });
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

/// Returns the distance that a coordinate of the form may be from what another program or an earlier rounding made of the same
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

/// Returns true if a coordinate depends on no other, nor on image counts.
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

/// Room for the numbers of a column that are made.
template <class Number>
std::span<Number> RowValues::make(std::vector<std::vector<Number>>& all, std::size_t column)
{
  std::vector<Number>& made = all[column];
  made.resize(rows_);
  columns_[column].type = std::is_same_v<Number, double> ? ValueType::Float64 : ValueType::Int64;
  columns_[column].data = made.data();
  columns_[column].step = 1;
  return made;
}

/// Returns true if the numbers of a column can be written as they are in their array; if so the column shows them there.
bool RowValues::find_in_place(const ColumnSource& source, Column& column) const noexcept
{
  const ValueSource& values = source.values;
  const bool kept_type = values.type == ValueType::Int32 || values.type == ValueType::Int64 ||
    values.type == ValueType::Float64;
  if (!contiguous_ || rows_ == 0 || !kept_type || values.factor != 1)
  {
    return false;
  }
  const auto bytes = static_cast<std::int64_t>(size_of(values.type));
  column.type = values.type;
  column.step = values.step;
  column.data = static_cast<const char*>(values.data) + kept_.front() * values.step * bytes;
  return true;
}

void RowValues::load_array(const ColumnSource& source, std::size_t column, bool as_doubles)
{
  const ValueSource& values = source.values;
  if (this->find_in_place(source, columns_[column]))
  {
    return;
  }
  if (values.type == ValueType::Text)
  {
    const auto* first = static_cast<const std::string*>(values.data);
    std::vector<const std::string*>& texts = columns_[column].texts;
    columns_[column].type = ValueType::Text;
    texts.resize(rows_);
    std::ranges::transform(
      this->kept(), texts.begin(), [&](std::int64_t row) { return first + row * values.step; });
  }
  else if (is_integer(values.type) && values.factor == 1 &&
    !(as_doubles && values.type < ValueType::Int64))
  {
    if (values.type == ValueType::UInt64)
    {
      check_unsigned(source, this->kept());
    }
    load_numbers(values, this->kept(), this->make(integers_, column).data());
  }
  else
  {
    const std::span<double> reals = this->make(reals_, column);
    load_numbers(values, this->kept(), reals.data());
    for (double& value : reals)
    {
      value *= values.factor;
    }
    if (source.kept_digits() > 0 && values.type == ValueType::Float32)
    {
      constexpr double half_unit = 0x1p-24;
      std::ranges::for_each(reals,
        [&](double& value)
        { put_back_digits(value, source.kept_digits(), half_unit * std::abs(value)); });
    }
  }
}

void RowValues::load_points(const FrameView& frame, const ColumnPlan& plan)
{
  own_.resize(rows_);
  points_.resize(frame.points ? 3 * rows_ : 0);
  images_.resize(3 * rows_);
  if (frame.points)
  {
    load_point_rows(frame, this->kept(), points_.data());
  }
  load_image_rows(plan.images, this->kept(), images_.data());
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
  const FrameView& frame, const Box& box, const ColumnSource& source, std::span<double> to)
{
  const std::span<const double> all = this->coordinates(frame, source.role);
  const auto axis = static_cast<std::size_t>(source.axis);
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
    load_numbers(source.values, this->kept(), own_.data());
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
  contiguous_ = is_consecutive(this->kept());
  columns_.resize(plan.columns.size());
  integers_.resize(columns_.size());
  reals_.resize(columns_.size());
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
    columns_[i].whole = source.whole;
    switch (source.kind)
    {
      case Kind::Array:
        this->load_array(source, i, plan.binary);
        if (source.role == ColumnRole::Id && !plan.binary)
        {
          check_ids(columns_[i], rows_, source.name);
        }
        break;
      case Kind::Coordinate:
        if (scales_alone(source, frame, box))
        {
          const auto axis = static_cast<std::size_t>(source.axis);
          const std::span<double> reals = this->make(reals_, i);
          load_numbers(point_values(frame, axis), this->kept(), reals.data());
          scale_aligned(box_, axis, reals);
          break;
        }
        this->load_coordinate(frame, box, source, this->make(reals_, i));
        break;
      case Kind::Image:
      {
        const std::span<std::int64_t> counts = this->make(integers_, i);
        for (std::size_t row = 0; row < rows_; ++row)
        {
          counts[row] =
            as_image(images_[3 * row + static_cast<std::size_t>(source.axis)], source.name);
        }
        break;
      }
      case Kind::RowNumber:
      {
        const std::span<std::int64_t> numbers = this->make(integers_, i);
        std::iota(numbers.begin(), numbers.end(), row_number + 1);
        break;
      }
      case Kind::One:
        std::ranges::fill(this->make(integers_, i), 1);
        break;
    }
  }
}
}
