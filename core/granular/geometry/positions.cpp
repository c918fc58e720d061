// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/positions.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace granular
{
namespace
{
constexpr std::size_t choices_per_kind = 6;

/// A way to get a coordinate: from the column of a role, adding or subtracting image counts.
struct Choice
{
  ColumnRole role;
  int shift;
  Coordinates gives;
};

using enum ColumnRole;
using enum Coordinates;

/// By what is wanted, best first.
constexpr Choice choices[3][choices_per_kind] = {
  {
    { Position, 0, Absolute },
    { ScaledPosition, 0, Absolute },
    { UnwrappedPosition, -1, Absolute },
    { ScaledUnwrappedPosition, -1, Absolute },
    { UnwrappedPosition, 0, Unwrapped },
    { ScaledUnwrappedPosition, 0, Unwrapped },
  },
  {
    { UnwrappedPosition, 0, Unwrapped },
    { ScaledUnwrappedPosition, 0, Unwrapped },
    { Position, 1, Unwrapped },
    { ScaledPosition, 1, Unwrapped },
    { Position, 0, Absolute },
    { ScaledPosition, 0, Absolute },
  },
  {
    { ScaledPosition, 0, Scaled },
    { Position, 0, Scaled },
    { ScaledUnwrappedPosition, -1, Scaled },
    { UnwrappedPosition, -1, Scaled },
    { ScaledUnwrappedPosition, 0, Scaled },
    { UnwrappedPosition, 0, Scaled },
  },
};

/// The columns of a frame that choices are made from.
struct Columns
{
  const ColumnSchema& schema;
  bool tilted; ///< a shift along one axis moves all coordinates

  int find(const Choice& choice, int axis) const noexcept
  {
    const bool counted = tilted
      ? schema.find(Image, 0) >= 0 && schema.find(Image, 1) >= 0 && schema.find(Image, 2) >= 0
      : schema.find(Image, axis) >= 0;
    return choice.shift != 0 && !counted ? -1 : schema.find(choice.role, axis);
  }

  bool complete(const Choice& choice) const noexcept
  {
    return find(choice, 0) >= 0 && find(choice, 1) >= 0 && find(choice, 2) >= 0;
  }
};

/// The choice of each axis: one for all if that can be, else the best of each; null: no column.
std::array<const Choice*, 3> choose(const Columns& columns, std::span<const Choice> order)
{
  std::array<const Choice*, 3> chosen = {};
  for (const Choice& choice : order)
  {
    if (columns.complete(choice))
    {
      return { &choice, &choice, &choice };
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!chosen[axis] && columns.find(choice, static_cast<int>(axis)) >= 0)
      {
        chosen[axis] = &choice;
      }
    }
  }
  return chosen;
}

/// Returns true if the axes are not all made in the same way. In a tilted box one coordinate alone, or one
/// image count alone, says nothing of the others.
bool mixed(std::span<const Choice* const> chosen) noexcept
{
  const Choice* const some = *std::ranges::find_if(chosen, [](const Choice* one) { return one; });
  return std::ranges::any_of(
    chosen, [&](const Choice* choice) { return choice && choice->role != some->role; });
}

void note(const PositionPlan& plan, std::span<const Choice* const> chosen, Coordinates wanted,
  const Where& where, Notices& notices)
{
  std::string missing;
  bool uncounted = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    missing += chosen[axis] ? "" : std::string(missing.empty() ? "" : " ") + "xyz"[axis];
    uncounted = uncounted ||
      (wanted == Scaled && chosen[axis] && is_unwrapped(chosen[axis]->role) &&
        chosen[axis]->shift == 0);
  }
  if (!missing.empty())
  {
    notices.push_back({ where, "no column for the coordinate " + missing + "; it is set to 0" });
  }
  if (plan.coordinates != wanted || uncounted)
  {
    notices.push_back({ where,
      std::string("expected image counts ix iy iz to make ") + to_string(wanted) +
        " coordinates, got none; the points are " +
        (uncounted ? "Scaled and unwrapped" : to_string(plan.coordinates)) });
  }
}
}

bool is_scaled(ColumnRole role) noexcept
{
  return role == ScaledPosition || role == ScaledUnwrappedPosition;
}

bool is_unwrapped(ColumnRole role) noexcept
{
  return role == UnwrappedPosition || role == ScaledUnwrappedPosition;
}

const char* to_string(Coordinates coordinates) noexcept
{
  constexpr const char* names[] = { "Absolute", "Unwrapped", "Scaled" };
  return names[static_cast<std::size_t>(coordinates)];
}

void check_scale(const PositionPlan& plan, const Box& box, const Where& where)
{
  const bool scales = std::ranges::any_of(
    plan.axes, [&](const PositionPlan::Axis& axis) { return is_rescaled(plan, axis); });
  const auto is_finite = [](const Twofold3& edge)
  { return std::ranges::all_of(edge, [](const Twofold& part) { return std::isfinite(part.hi); }); };
  if (!scales || !std::ranges::all_of(box.vectors, is_finite))
  {
    return; // where the box has no numbers, coordinates have none either
  }
  try
  {
    check_volume(box);
  }
  catch (const Error& error)
  {
    throw FormatError(error.text(), where);
  }
}

PositionPlan plan_positions(const ColumnSchema& schema, const Box& box, Coordinates wanted,
  const Where& where, Notices& notices)
{
  const Columns columns{ schema, box.tilted };
  const auto chosen = choose(columns, choices[static_cast<std::size_t>(wanted)]);
  PositionPlan plan;
  plan.coordinates = wanted;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (const Choice* choice = chosen[k])
    {
      plan.axes[k] = { columns.find(*choice, static_cast<int>(k)), is_scaled(choice->role),
        choice->shift };
      plan.coordinates = choice->gives == wanted ? plan.coordinates : choice->gives;
    }
  }
  if (std::ranges::count(chosen, nullptr) == 3)
  {
    throw FormatError(
      "expected columns of coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu), got '" +
        schema.text() + "'",
      where);
  }
  if (box.tilted && mixed(chosen))
  {
    throw UnsupportedError(
      "expected all coordinates of a tilted box in one form, got '" + schema.text() + "'", where);
  }
  if (std::ranges::any_of(plan.axes, [](const auto& axis) { return axis.shift != 0; }))
  {
    plan.images = { schema.find(Image, 0), schema.find(Image, 1), schema.find(Image, 2) };
  }
  note(plan, chosen, wanted, where, notices);
  return plan;
}
}
