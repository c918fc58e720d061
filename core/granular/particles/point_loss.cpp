// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/point_loss.h"

#include "granular/numbers/number_print.h"

#include <string>

namespace granular
{
void add_rounding(
  std::int64_t rows, const Box& box, const Vector3& origin, RoundingLoss& loss) noexcept
{
  const bool rounds = rows > 0 && origin != Vector3{};
  const Vector3 moved = rounds ? rounding_of_points(box, origin) : Vector3{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    loss.move(axis, moved[axis]);
  }
}

void note_point_loss(const RoundingLoss& loss, const Box& box, const Vector3& origin, bool single,
  const Where& where, Notices& notices)
{
  const std::string text = loss.text(RoundingLimit(box, loss.radius()), "points", {});
  if (text.empty())
  {
    return;
  }
  const std::string precision = single ? "single" : "double";
  std::string topic = precision;
  for (const double coordinate : origin)
  {
    topic += " " + to_text(coordinate);
  }
  notices.push_back({ where,
    "rounding to " + precision + " precision " + text + "; set PointOrigin near the particles" +
      (single ? ", or PointPrecision=Double" : ""),
    topic });
}
}
