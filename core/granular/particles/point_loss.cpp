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

void note_box_loss(const FrameHeader& header, double radius, const Where& where, Notices& notices)
{
  RoundingLoss loss;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    loss.move(axis, header.box_rounding[axis]);
  }
  const std::string text = loss.text(RoundingLimit(header.box, radius), "points", {});
  if (!text.empty())
  {
    notices.push_back({ where,
      "the last digit of the bounds of the box, which scale the coordinates, " + text +
        "; dump x y z with more digits (dump_modify ID format \"%d %d %.12g ...\", a format for "
        "each column), or a binary file",
      "digits of the box" });
  }
}
}
