// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/minimum_image.h"

#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace granular
{
namespace
{
/// Makes a vector perpendicular to another one.
void remove_part(Vector3& vector, const Vector3& along) noexcept
{
  const double part = dot(vector, along) / dot(along, along);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    vector[axis] -= part * along[axis];
  }
}

/// Part of the length of a vector that rounding may have changed.
constexpr double rounding = 0x1p-48;

/// Counts beyond have no meaning: of a vector, and of the short sums of box vectors.
constexpr double most_counts = 0x1p50;
constexpr double most_counts_of_sum = 0x1p40;

bool are_below(const Vector3& counts, double limit) noexcept
{
  return std::abs(counts[0]) < limit && std::abs(counts[1]) < limit && std::abs(counts[2]) < limit;
}

Vector3 sum(const Vector3& a, const Vector3& b) noexcept
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

/// By their sum, then by those of the last axes; the sign decides at last.
bool is_smaller(const Vector3& a, const Vector3& b) noexcept
{
  const auto all = [](const Vector3& counts)
  { return std::abs(counts[0]) + std::abs(counts[1]) + std::abs(counts[2]); };
  if (all(a) != all(b))
  {
    return all(a) < all(b);
  }
  for (std::size_t axis = 3; axis-- > 0;)
  {
    if (std::abs(a[axis]) != std::abs(b[axis]))
    {
      return std::abs(a[axis]) < std::abs(b[axis]);
    }
  }
  return a > b;
}

BoxCounts to_integers(const Vector3& counts) noexcept
{
  return { static_cast<std::int64_t>(counts[0]), static_cast<std::int64_t>(counts[1]),
    static_cast<std::int64_t>(counts[2]) };
}
}

MinimumImage::MinimumImage(const Box& box)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (!granular::is_periodic(box, i) || !has_length(box.vectors[i]))
    {
      continue;
    }
    vectors_[i] = box.vectors[i];
    Vector3 one = {};
    one[i] = 1;
    reduced_.push_back(this->make_sum(one));
    const Vector3& vector = reduced_.back().vector;
    per_length_[i] = 1 / vector[i];
    straight_ = straight_ && vector[(i + 1) % 3] == 0 && vector[(i + 2) % 3] == 0;
  }
  if (!straight_)
  {
    this->reduce();
    this->make_steps();
  }
  periodic_ = !reduced_.empty();
}

MinimumImage::Sum MinimumImage::make_sum(const Vector3& counts) const noexcept
{
  const Vector3 vector = this->moved({}, to_integers(counts), {});
  return { counts, vector, dot(vector, vector) };
}

Vector3 MinimumImage::moved_far(
  const Vector3& point, const BoxCounts& counts, const Vector3& less) const noexcept
{
  Vector3 result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    CompensatedSum total;
    total.add(point[axis]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      total.add_product(static_cast<double>(counts[i]), vectors_[i][axis]);
    }
    total.add(-less[axis]);
    result[axis] = total.value();
  }
  return result;
}

/// Adds multiples of the next and the last one to one of the vectors, if that makes it shorter.
bool MinimumImage::shorten(std::size_t which, double j_times, double k_times) noexcept
{
  const std::size_t size = reduced_.size();
  const Vector3& j = reduced_[(which + 1) % size].counts;
  const Vector3& k = reduced_[(which + 2) % size].counts;
  Vector3 counts = reduced_[which].counts;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    counts[axis] += j_times * j[axis] + (k_times != 0 ? k_times * k[axis] : 0);
  }
  if (!are_below(counts, most_counts_of_sum))
  {
    return false;
  }
  const Sum shorter = this->make_sum(counts);
  const bool is_shorter = shorter.square < (1 - 0x1p-30) * reduced_[which].square;
  if (is_shorter)
  {
    reduced_[which] = shorter;
  }
  return is_shorter;
}

/// Until no vector can be made shorter by the others, once or more each. Three such vectors, or fewer, are a basis that is
/// reduced in Minkowski's sense: their own multiples by -1, 0 and 1 are all that need be compared (P. Q. Nguyen, D.
/// Stehle, "Low-dimensional lattice basis reduction revisited", ACM Trans. Algorithms 5, 2009).
void MinimumImage::reduce() noexcept
{
  const auto times = [this](std::size_t i, std::size_t j)
  { return -std::nearbyint(dot(reduced_[i].vector, reduced_[j].vector) / reduced_[j].square); };
  const std::size_t size = reduced_.size();
  for (bool changed = size > 1; changed;)
  {
    changed = false;
    for (std::size_t i = 0; i < size; ++i)
    {
      changed = this->shorten(i, times(i, (i + 1) % size), 0) || changed;
      if (size == 3)
      {
        changed = this->shorten(i, 0, times(i, (i + 2) % size)) || changed;
        for (const double sign : { -1., 1. })
        {
          changed = this->shorten(i, sign, -1) || this->shorten(i, sign, 1) || changed;
        }
      }
    }
  }
  std::erase_if(reduced_, [](const Sum& one) { return one.vector == Vector3{}; });
}

/// Two images of a vector that both are the shortest, or one and its better neighbour, are no farther from each other than
/// a box of the reduced vectors' lengths is long, and at most two of each of them.
void MinimumImage::make_steps()
{
  std::array<Vector3, 3> vectors = {};
  std::array<bool, 3> chosen = {};
  double farthest = 0;
  double shortest = reduced_.empty() ? 0 : reduced_.front().square;
  for (std::size_t i = 0; i < reduced_.size(); ++i)
  {
    vectors[i] = reduced_[i].vector;
    chosen[i] = true;
    farthest += reduced_[i].square;
    shortest = std::min(shortest, reduced_[i].square);
  }
  const std::array<Vector3, 3> parts = own_parts(vectors, chosen);
  for (std::size_t i = 0; i < reduced_.size(); ++i)
  {
    // reduced vectors stand out by more than half their length
    const Vector3& own = parts[i];
    const double square = dot(own, own);
    if (!(square > reduced_[i].square / 4))
    {
      reduced_.clear();
      return;
    }
    duals_.push_back({ own[0] / square, own[1] / square, own[2] / square });
  }
  surely_shortest_ = shortest / 4 * (1 - 0x1p-30);
  const int size = static_cast<int>(reduced_.size());
  for (int number = 0, all = size == 3 ? 125 : size == 2 ? 25 : 5; number < all; ++number)
  {
    Vector3 counts = {};
    int rest = number;
    for (const Sum& one : reduced_)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        counts[axis] += (rest % 5 - 2) * one.counts[axis];
      }
      rest /= 5;
    }
    const Sum step = this->make_sum(counts);
    if (step.square > 0 && step.square <= farthest * (1 + 0x1p-30))
    {
      steps_.push_back(step);
    }
  }
}

/// Each axis by itself.
BoxCounts MinimumImage::find_straight(const Vector3& vector) const noexcept
{
  BoxCounts counts = {};
  if (!std::isfinite(vector[0]) || !std::isfinite(vector[1]) || !std::isfinite(vector[2]))
  {
    return counts;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lengths = vector[axis] * per_length_[axis];
    const double size = std::abs(lengths);
    if (size > 0.5 && size < most_counts)
    {
      const double count = std::ceil(size - 0.5 - rounding * (size + 1));
      counts[axis] = static_cast<std::int64_t>(lengths > 0 ? -count : count);
    }
  }
  return counts;
}

/// Rounds in the reduced basis, and goes to neighbours from there.
BoxCounts MinimumImage::find_tilted(const Vector3& vector) const noexcept
{
  const double square = dot(vector, vector);
  if (reduced_.empty() || square <= surely_shortest_ || !std::isfinite(square))
  {
    return {};
  }
  Vector3 counts = {};
  for (std::size_t i = 0; i < reduced_.size(); ++i)
  {
    const double count = std::nearbyint(dot(duals_[i], vector));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      counts[axis] -= count * reduced_[i].counts[axis];
    }
  }
  if (!are_below(counts, most_counts))
  {
    return {};
  }
  Vector3 rest = this->moved(vector, to_integers(counts), {});
  if (dot(rest, rest) <= surely_shortest_)
  {
    return to_integers(counts);
  }
  const double slack = rounding * std::sqrt(square);
  for (;;)
  {
    const Sum* best = nullptr; // the shortest neighbour, if it is shorter by more than rounding
    double least = 0;
    Vector3 smallest = counts; // of the images that are as short
    for (const Sum& step : steps_)
    {
      const double longer = step.square + 2 * dot(step.vector, rest);
      const double tie = 2 * slack * std::sqrt(step.square);
      if (longer < least && longer < -tie)
      {
        best = &step;
        least = longer;
      }
      else if (const Vector3 other = sum(counts, step.counts);
               longer <= tie && is_smaller(other, smallest))
      {
        smallest = other;
      }
    }
    if (!best)
    {
      return to_integers(smallest);
    }
    counts = sum(counts, best->counts);
    rest = this->moved(vector, to_integers(counts), {});
  }
}

bool has_length(const Twofold3& vector) noexcept
{
  const auto [x, y, z] = values_of(vector);
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && (x != 0 || y != 0 || z != 0);
}

std::array<Vector3, 3> own_parts(
  const std::array<Vector3, 3>& vectors, const std::array<bool, 3>& chosen) noexcept
{
  std::array<Vector3, 3> parts = {};
  for (std::size_t which = 0; which < 3; ++which)
  {
    Vector3 own = vectors[which];
    std::array<Vector3, 2> others;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (i != which && chosen[i])
      {
        others[count] = vectors[i];
        if (count == 1)
        {
          remove_part(others[1], others[0]);
        }
        remove_part(own, others[count++]);
      }
    }
    if (chosen[which] && dot(own, own) > 0x1p-80 * dot(vectors[which], vectors[which]))
    {
      parts[which] = own;
    }
  }
  return parts;
}

std::array<Vector3, 3> periodic_duals(
  const Box& box, const std::array<Vector3, 3>& vectors) noexcept
{
  std::array<bool, 3> periodic;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    periodic[axis] = is_periodic(box, axis) && has_length(box.vectors[axis]);
  }
  std::array<Vector3, 3> duals = own_parts(vectors, periodic);
  for (Vector3& dual : duals)
  {
    const double square = dot(dual, dual);
    if (square > 0)
    {
      dual = { dual[0] / square, dual[1] / square, dual[2] / square };
    }
  }
  return duals;
}
}
