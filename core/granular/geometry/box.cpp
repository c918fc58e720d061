// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/box.h"

#include "granular/common/error.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace granular
{
namespace
{
Twofold sum(std::initializer_list<Twofold> terms)
{
  CompensatedSum total;
  for (const Twofold term : terms)
  {
    total.add(term);
  }
  return total.twofold();
}

bool less(Twofold a, Twofold b)
{
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}
}

Box Box::from_bounds(const Vector3& lo, const Vector3& hi)
{
  Box box;
  for (std::size_t i = 0; i < 3; ++i)
  {
    box.origin[i] = { lo[i], 0 };
    box.vectors[i][i] = sum({ { hi[i] }, { -lo[i] } });
  }
  return box;
}

Box Box::from_tilted_bounds(const Vector3& lo, const Vector3& hi, double xy, double xz, double yz)
{
  const Twofold zero;
  const auto [x_lo, x_hi] = std::minmax({ zero, { xy }, { xz }, sum({ { xy }, { xz } }) }, less);
  const auto [y_lo, y_hi] = std::minmax({ zero, { yz } }, less);
  Box box;
  box.tilted = true;
  box.origin = { sum({ { lo[0] }, -x_lo }), sum({ { lo[1] }, -y_lo }), Twofold{ lo[2] } };
  box.vectors[0] = { sum({ { hi[0] }, { -lo[0] }, x_lo, -x_hi }), zero, zero };
  box.vectors[1] = { Twofold{ xy }, sum({ { hi[1] }, { -lo[1] }, y_lo, -y_hi }), zero };
  box.vectors[2] = { Twofold{ xz }, Twofold{ yz }, sum({ { hi[2] }, { -lo[2] } }) };
  return box;
}

Box Box::from_vectors(const Vector3& origin, const std::array<Vector3, 3>& vectors)
{
  Box box;
  box.tilted = true;
  box.general = true;
  for (std::size_t i = 0; i < 3; ++i)
  {
    box.origin[i] = { origin[i], 0 };
    for (std::size_t j = 0; j < 3; ++j)
    {
      box.vectors[i][j] = { vectors[i][j], 0 };
    }
  }
  return box;
}

Box Box::from_edges(const Vector3& origin, const std::array<Vector3, 3>& edges)
{
  Box box = from_vectors(origin, edges);
  box.general = edges[0][1] != 0 || edges[0][2] != 0 || edges[1][2] != 0;
  box.tilted = box.general || edges[1][0] != 0 || edges[2][0] != 0 || edges[2][1] != 0;
  return box;
}

BoxBounds Box::bounds() const
{
  const auto& [a, b, c] = vectors;
  BoxBounds bounds;
  bounds.xy = b[0].value();
  bounds.xz = c[0].value();
  bounds.yz = c[1].value();
  const Twofold zero;
  const std::array<std::array<Twofold, 4>, 3> shifts = { {
    { zero, b[0], c[0], sum({ b[0], c[0] }) },
    { zero, c[1], zero, zero },
    { zero, zero, zero, zero },
  } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::ranges::minmax(shifts[axis], less);
    const Twofold end = sum({ origin[axis], vectors[axis][axis] });
    bounds.lo[axis] = sum({ origin[axis], low }).value();
    bounds.hi[axis] = sum({ end, high }).value();
  }
  return bounds;
}

Vector3 Box::corner(int i, int j, int k, const Vector3& less) const
{
  const std::array<int, 3> steps = { i, j, k };
  Vector3 point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    CompensatedSum total;
    total.add(origin[axis]);
    for (std::size_t edge = 0; edge < 3; ++edge)
    {
      if (steps[edge] != 0)
      {
        total.add(vectors[edge][axis]);
      }
    }
    total.add(-less[axis]);
    point[axis] = total.value();
  }
  return point;
}

std::string parse_boundary(const std::string& text)
{
  constexpr std::string_view flags = "pfsm";
  std::string long_form = text;
  if (text.size() == 5)
  {
    long_form = { text[0], text[0], text[1], text[2], text[2], text[3], text[4], text[4] };
  }
  bool right = long_form.size() == 8;
  for (std::size_t i = 0; right && i < long_form.size(); ++i)
  {
    right = i % 3 == 2 ? long_form[i] == ' ' : flags.find(long_form[i]) != flags.npos;
  }
  if (!right)
  {
    throw FormatError(
      "expected boundaries as in 'pp pp ff' or 'p p f', of p, f, s and m, got '" + text + "'");
  }
  return long_form;
}

void check_bounds(const Box& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = box.vectors[axis][axis].value();
    if (!box.general && !(length >= 0))
    {
      throw Error("expected a box with its upper bound above the lower one along " +
        std::string(1, "xyz"[axis]) + ", got a length of " + std::to_string(length));
    }
  }
}

void check_volume(const Box& box)
{
  for (std::size_t axis = 0; !box.general && axis < 3; ++axis)
  {
    const double length = box.vectors[axis][axis].hi;
    if (!(std::abs(length) > 0))
    {
      throw Error("expected a box with a length along " + std::string(1, "xyz"[axis]) +
        " to scale coordinates by, got one of length " + (length == 0 ? "0" : "nan"));
    }
  }
  const double volume =
    dot(values_of(box.vectors[0]), cross(values_of(box.vectors[1]), values_of(box.vectors[2])));
  if (box.general && !(std::abs(volume) > 0))
  {
    throw Error("expected a box with a volume to scale coordinates by, got a flat one");
  }
}
}
