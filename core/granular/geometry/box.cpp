// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/box.h"

#include "granular/common/error.h"

#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

namespace granular
{
namespace
{
Twofold sum(std::initializer_list<double> terms)
{
  CompensatedSum total;
  for (const double term : terms)
  {
    total.add(term);
  }
  return total.twofold();
}

bool less(Twofold a, Twofold b)
{
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

Twofold smallest(std::initializer_list<Twofold> values)
{
  Twofold best = *values.begin();
  for (const Twofold value : values)
  {
    best = less(value, best) ? value : best;
  }
  return best;
}

Twofold largest(std::initializer_list<Twofold> values)
{
  Twofold best = *values.begin();
  for (const Twofold value : values)
  {
    best = less(best, value) ? value : best;
  }
  return best;
}

Twofold add(Twofold a, Twofold b)
{
  CompensatedSum total;
  total.add(a);
  total.add(b);
  return total.twofold();
}

/// bound - shift
Twofold corner_of_bound(double bound, Twofold shift)
{
  CompensatedSum total;
  total.add(bound);
  total.add(Twofold{ -shift.hi, -shift.lo });
  return total.twofold();
}

/// (hi - high_shift) - (lo - low_shift)
Twofold edge(double lo, double hi, Twofold low_shift, Twofold high_shift)
{
  CompensatedSum total;
  total.add(hi);
  total.add(-lo);
  total.add(low_shift);
  total.add(Twofold{ -high_shift.hi, -high_shift.lo });
  return total.twofold();
}
}

Box Box::from_bounds(const Vector3& lo, const Vector3& hi)
{
  Box box;
  for (std::size_t i = 0; i < 3; ++i)
  {
    box.origin[i] = { lo[i], 0 };
    box.vectors[i][i] = edge(lo[i], hi[i], {}, {});
  }
  return box;
}

Box Box::from_tilted_bounds(const Vector3& lo, const Vector3& hi, double xy, double xz, double yz)
{
  const Twofold zero;
  const Twofold both = sum({ xy, xz });
  const Twofold x_lo = smallest({ zero, { xy, 0 }, { xz, 0 }, both });
  const Twofold x_hi = largest({ zero, { xy, 0 }, { xz, 0 }, both });
  const Twofold y_lo = smallest({ zero, { yz, 0 } });
  const Twofold y_hi = largest({ zero, { yz, 0 } });
  Box box;
  box.tilted = true;
  box.origin = { corner_of_bound(lo[0], x_lo), corner_of_bound(lo[1], y_lo), Twofold{ lo[2], 0 } };
  box.vectors[0] = { edge(lo[0], hi[0], x_lo, x_hi), zero, zero };
  box.vectors[1] = { Twofold{ xy, 0 }, edge(lo[1], hi[1], y_lo, y_hi), zero };
  box.vectors[2] = { Twofold{ xz, 0 }, Twofold{ yz, 0 }, edge(lo[2], hi[2], zero, zero) };
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

BoxBounds Box::bounds() const
{
  const auto& [a, b, c] = vectors;
  BoxBounds bounds;
  bounds.xy = b[0].value();
  bounds.xz = c[0].value();
  bounds.yz = c[1].value();
  const Twofold zero;
  const std::array<std::array<Twofold, 4>, 3> shifts = { {
    { zero, b[0], c[0], add(b[0], c[0]) },
    { zero, c[1], zero, zero },
    { zero, zero, zero, zero },
  } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto& [s0, s1, s2, s3] = shifts[axis];
    const Twofold end = add(origin[axis], vectors[axis][axis]);
    bounds.lo[axis] = add(origin[axis], smallest({ s0, s1, s2, s3 })).value();
    bounds.hi[axis] = add(end, largest({ s0, s1, s2, s3 })).value();
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
  const Twofold3& a = box.vectors[0];
  const Twofold3& b = box.vectors[1];
  const Twofold3& c = box.vectors[2];
  for (std::size_t axis = 0; !box.general && axis < 3; ++axis)
  {
    const double length = box.vectors[axis][axis].hi;
    if (!(std::abs(length) > 0))
    {
      throw Error("expected a box with a length along " + std::string(1, "xyz"[axis]) +
        " to scale coordinates by, got one of length " + (length == 0 ? "0" : "nan"));
    }
  }
  const auto minor = [&](std::size_t i, std::size_t j)
  { return b[i].value() * c[j].value() - b[j].value() * c[i].value(); };
  const double volume =
    a[0].value() * minor(1, 2) + a[1].value() * minor(2, 0) + a[2].value() * minor(0, 1);
  if (box.general && !(std::abs(volume) > 0))
  {
    throw Error("expected a box with a volume to scale coordinates by, got a flat one");
  }
}
}
