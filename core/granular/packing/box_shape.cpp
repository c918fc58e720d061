// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/box_shape.h"

#include "granular/common/error.h"
#include "granular/common/words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
Vector3 rounded(const Twofold3& vector)
{
  return { vector[0].value(), vector[1].value(), vector[2].value() };
}

bool is_side(std::string_view word)
{
  const bool known = word.find_first_not_of("pfsm") == word.npos;
  return known && (word.size() == 1 || (word.size() == 2 && (word[0] == 'p') == (word[1] == 'p')));
}
}

BoxShape::BoxShape(const Box& box)
  : origin(rounded(box.origin))
  , vectors{ rounded(box.vectors[0]), rounded(box.vectors[1]), rounded(box.vectors[2]) }
  , periodic{ box.boundary[0] == 'p', box.boundary[3] == 'p', box.boundary[6] == 'p' }
  , aligned(true)
{
  volume = std::abs(dot(vectors[0], cross(vectors[1], vectors[2])));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Vector3 face = cross(vectors[(axis + 1) % 3], vectors[(axis + 2) % 3]);
    heights[axis] = volume / std::sqrt(dot(face, face));
    const double towards = dot(face, vectors[axis]);
    faces[axis] = { face[0] / towards, face[1] / towards, face[2] / towards };
    double least = origin[axis];
    double most = origin[axis];
    for (const Vector3& vector : vectors)
    {
      least += std::min(vector[axis], 0.0);
      most += std::max(vector[axis], 0.0);
    }
    reach = std::max({ reach, -least, most });
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Twofold& edge = box.vectors[axis][k];
      aligned = aligned && edge.lo == 0 && (k == axis ? edge.hi > 0 : edge.hi == 0);
    }
    aligned = aligned && box.origin[axis].lo == 0;
    // nan fails as well
    if (!(heights[axis] > 0) || !std::isfinite(heights[axis]) || !std::isfinite(origin[axis]))
    {
      throw LimitError(
        "expected a box of three finite lengths greater than 0, got one that is flat "
        "or not finite");
    }
  }
}

Vector3 BoxShape::point(const Vector3& scaled) const noexcept
{
  const Vector3 from_origin = this->edge(scaled);
  return { origin[0] + from_origin[0], origin[1] + from_origin[1], origin[2] + from_origin[2] };
}

double BoxShape::rounding() const noexcept
{
  return 8 * std::numeric_limits<double>::epsilon() * reach;
}

bool BoxShape::adds(std::initializer_list<double> numbers) const noexcept
{
  const double unit = std::ldexp(std::numeric_limits<double>::epsilon(), std::ilogb(reach));
  return aligned &&
    std::ranges::all_of(numbers, [unit](double number) { return std::fmod(number, unit) == 0; });
}

std::string checked_boundary(const std::string& boundary)
{
  const std::vector<std::string_view> words = split_words(boundary);
  if (words.size() != 3 || !std::all_of(words.begin(), words.end(), is_side))
  {
    throw LimitError("expected a boundary such as 'pp pp ff', of the letters p, f, s and m and p "
                     "never with another, got '" +
      boundary + "'");
  }
  std::string text;
  for (const std::string_view word : words)
  {
    text += text.empty() ? "" : " ";
    text += word.front();
    text += word.back();
  }
  return text;
}
}
