// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/rounding_loss.h"

#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"
#include "granular/particles/point_forms.h"

#include <optional>

namespace granular
{
namespace
{
std::string short_text(double value)
{
  return to_text(value, { 3 });
}

/// The extent of a box along an axis.
double length_of(const Box& box, std::size_t axis) noexcept
{
  double length = 0;
  for (const Twofold3& edge : box.vectors)
  {
    length += std::abs(edge[axis].hi);
  }
  return length;
}
}

void RoundingLoss::change(std::size_t of_column, double value, double rounded) noexcept
{
  RoundingLoss one;
  one.changed = std::abs(rounded - value) / std::abs(value);
  one.column = of_column;
  this->add(one);
}

void RoundingLoss::add(const RoundingLoss& other) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->move(axis, other.moved[axis]);
  }
  if (other.changed > changed || (other.changed == changed && other.column < column))
  {
    changed = other.changed;
    column = other.column;
  }
  this->add_radius(other.radius);
}

std::string RoundingLoss::text(
  const Box& box, const char* points, std::span<const std::string> names) const
{
  const Vector3 limit = largest_movement(box, radius);
  std::size_t worst = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    worst = moved[axis] / limit[axis] > moved[worst] / limit[worst] ? axis : worst;
  }
  std::string text;
  if (moved[worst] > limit[worst])
  {
    text = std::string("moves ") + points + " by up to " + short_text(moved[worst]) + " along " +
      "xyz"[worst] + ", where " +
      (radius < HUGE_VAL ? "the smallest radius is " + short_text(radius)
                         : "the box is " + short_text(length_of(box, worst)) + " long");
  }
  if (changed > of_value)
  {
    text += (text.empty() ? "changes '" : ", and changes '") + names[column] + "' by up to " +
      short_text(100 * changed) + " % of itself";
  }
  return text;
}

Vector3 largest_movement(const Box& box, double smallest_radius) noexcept
{
  constexpr double of_radius = 0.01;
  constexpr double of_box = 1e-4;
  Vector3 distance;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = length_of(box, axis);
    const bool known = length > 0 && std::isfinite(length);
    distance[axis] = smallest_radius < HUGE_VAL ? of_radius * smallest_radius
      : known                                   ? of_box * length
                                                : HUGE_VAL;
  }
  return distance;
}

double smallest_radius(const FrameView& frame)
{
  const std::optional<ValueSource> radii = find_values(frame, "radius");
  RoundingLoss loss;
  if (!radii || radii->type == ValueType::Text)
  {
    return loss.radius;
  }
  for_each_number(*radii, frame.rows, [&](double radius) { loss.add_radius(radius); });
  return loss.radius;
}

RoundingLoss add_ranks(RoundingLoss own, Communicator& ranks)
{
  RoundingLoss sum;
  for (const RoundingLoss& loss : gather(ranks, own))
  {
    sum.add(loss);
  }
  return sum;
}

bool note_loss(const std::string& losses, const std::string& cause, const std::string& remedy,
  const Where& where, const std::string& topic, Notices& notices)
{
  if (!losses.empty())
  {
    notices.push_back({ where, cause + " " + losses + "; " + remedy, topic });
  }
  return !losses.empty();
}
}
