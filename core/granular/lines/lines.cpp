// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/lines.h"

#include "granular/lines/minimum_image.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace granular
{
namespace
{
constexpr std::size_t rows_a_chunk = 16384;

double length_of(const Vector3& vector) noexcept
{
  const double length = std::sqrt(dot(vector, vector));
  // its square may have left the range of numbers
  return length > 0x1p-500 && length < 0x1p500
    ? length
    : std::hypot(std::hypot(vector[0], vector[1]), vector[2]);
}

class LineMaker
{
public:
  LineMaker(std::span<const double> first, std::span<const double> second, const Box& box,
    const Request& request)
    : first_(first)
    , second_(second)
    , request_(request)
    , rows_(first.size() / 3)
    , images_(request.periodic_lines == PeriodicLines::AsWritten ? Box{} : box)
    , splitter_(box, images_, request.point_origin)
    , executor_(request.threads)
    , counts_((rows_ + rows_a_chunk - 1) / rows_a_chunk)
  {
  }

  Lines make(Progress& progress)
  {
    PartialProgress part(progress);
    if (this->splits())
    {
      part.set_part(0, 0.4);
      this->for_chunks(part, &LineMaker::count);
      part.set_part(0.4, 1);
    }
    this->make_room();
    this->for_chunks(part, &LineMaker::fill);
    for (const Counts& chunk : counts_)
    {
      lines_.moved += chunk.moved;
    }
    return std::move(lines_);
  }

private:
  using Parts = std::array<LinePart, LineSplitter::most_parts>;

  /// Counts of a chunk of rows.
  struct Counts
  {
    std::size_t more = 0; ///< lines than rows
    std::size_t first_line = 0;
    std::int64_t moved = 0;
  };

  bool splits() const noexcept
  {
    return request_.periodic_lines == PeriodicLines::Split && images_.is_periodic();
  }

  using Task = void (LineMaker::*)(std::size_t row, std::size_t end, Counts& counts);

  void for_chunks(Progress& progress, Task task)
  {
    executor_.for_each_stretch(
      rows_, rows_a_chunk,
      [&](std::size_t row, std::size_t count, std::size_t)
      { (this->*task)(row, row + count, counts_[row / rows_a_chunk]); },
      progress);
  }

  static Vector3 point_of(std::span<const double> points, std::size_t row) noexcept
  {
    return { points[3 * row], points[3 * row + 1], points[3 * row + 2] };
  }

  void count(std::size_t row, std::size_t end, Counts& chunk)
  {
    std::size_t more = 0;
    Parts parts;
    for (; row < end; ++row)
    {
      const Vector3 first = point_of(first_, row);
      const Vector3 second = point_of(second_, row);
      const BoxCounts counts = images_.find(minus(second, first));
      more += counts == BoxCounts{} ? 0 : splitter_.split(first, second, counts, parts) - 1;
    }
    chunk.more = more;
  }

  void make_room()
  {
    std::size_t more = 0;
    for (std::size_t chunk = 0; chunk < counts_.size(); ++chunk)
    {
      counts_[chunk].first_line = chunk * rows_a_chunk + more;
      more += counts_[chunk].more;
    }
    const std::size_t lines = rows_ + more;
    lines_.count = static_cast<std::int64_t>(lines);
    lines_.points = Block(lines * 2 * sizeof(Vector3), request_.pool);
    lines_.lengths = Block(rows_ * sizeof(double), request_.pool);
    lines_.rows.resize(lines == rows_ ? 0 : lines);
  }

  void fill(std::size_t row, std::size_t end, Counts& chunk)
  {
    auto* const lengths = static_cast<double*>(lines_.lengths.data());
    std::size_t line = chunk.first_line;
    auto* part = static_cast<LinePart*>(lines_.points.data()) + line;
    std::int64_t moved = 0;
    Parts parts;
    for (; row < end; ++row)
    {
      const Vector3 first = point_of(first_, row);
      const Vector3 second = point_of(second_, row);
      const Vector3 vector = minus(second, first);
      const BoxCounts counts = images_.find(vector);
      std::size_t made = 1;
      if (counts == BoxCounts{})
      {
        parts[0] = { minus(first, request_.point_origin), minus(second, request_.point_origin) };
        lengths[row] = length_of(vector);
      }
      else
      {
        made = this->splits() ? splitter_.split(first, second, counts, parts) : 1;
        if (!this->splits())
        {
          parts[0] = { minus(first, request_.point_origin),
            images_.moved(second, counts, request_.point_origin) };
        }
        lengths[row] = length_of(images_.moved(second, counts, first));
        ++moved;
      }
      part = std::copy_n(parts.begin(), made, part);
      for (; made > 0 && !lines_.rows.empty(); --made)
      {
        lines_.rows[line++] = static_cast<std::int64_t>(row);
      }
    }
    chunk.moved = moved;
  }

  std::span<const double> first_;
  std::span<const double> second_;
  const Request& request_;
  std::size_t rows_;
  MinimumImage images_;
  LineSplitter splitter_;
  Executor executor_;
  std::vector<Counts> counts_; ///< of each chunk
  Lines lines_;
};
}

LineSplitter::LineSplitter(const Box& box, const MinimumImage& images, const Vector3& point_origin)
  : box_(box)
  , images_(images)
  , point_origin_(point_origin)
{
  std::array<Vector3, 3> vectors;
  std::array<bool, 3> chosen;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    vectors[axis] = values_of(box.vectors[axis]);
    chosen[axis] = has_length(box.vectors[axis]);
  }
  normals_ = own_parts(vectors, chosen);
}

/// whole: from first to the image of second.
LineSplitter::Crossing LineSplitter::find_crossing(std::size_t axis, bool upper,
  const Vector3& first, const Vector3& second, const Vector3& whole) const noexcept
{
  const Vector3& normal = normals_[axis];
  const auto up = [&](std::size_t of) { return upper && of == axis ? 1 : 0; };
  const Vector3 to_face = box_.corner(up(0), up(1), up(2), first);
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    size += std::abs(normal[i]) * std::max(std::abs(first[i]), std::abs(second[i]));
  }
  const double length = dot(normal, whole);
  Crossing crossing;
  crossing.axis = axis;
  crossing.rounding = std::abs(0x1p-50 * size / length);
  const double place = dot(normal, to_face) / length;
  // nothing tells where a line in the face crosses it: at its first end
  crossing.place = place > crossing.rounding ? place : 0;
  crossing.place = crossing.place < 1 - crossing.rounding ? crossing.place : 1;
  return crossing;
}

std::size_t LineSplitter::split(const Vector3& first, const Vector3& second,
  const BoxCounts& counts, std::array<LinePart, most_parts>& parts) const noexcept
{
  const Vector3 whole = images_.moved(second, counts, first);
  std::array<Crossing, 3> crossings; // in their order along the line
  std::size_t crossed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (counts[axis] != 0)
    {
      const Crossing one = this->find_crossing(axis, counts[axis] > 0, first, second, whole);
      std::size_t at = crossed++;
      for (; at > 0 && crossings[at - 1].place > one.place; --at)
      {
        crossings[at] = crossings[at - 1];
      }
      crossings[at] = one;
    }
  }

  BoxCounts of_first = {};      // how many vectors the first end is moved by
  BoxCounts of_second = counts; // and the second one
  const auto point_at = [&](double place)
  {
    Vector3 point = first;
    for (std::size_t i = 0; i < 3; ++i)
    {
      point[i] += place * whole[i];
    }
    return place == 1 ? images_.moved(second, of_second, point_origin_)
                      : images_.moved(point, of_first, point_origin_);
  };
  std::size_t count = 0;
  double from = 0;
  for (std::size_t i = 0; i < crossed; ++i)
  {
    const auto& [place, rounding, axis] = crossings[i];
    if (place - from > rounding)
    {
      parts[count++] = { point_at(from), point_at(place) };
      from = place;
    }
    of_first[axis] = -counts[axis];
    of_second[axis] = 0;
  }
  if (count == 0 || from < 1)
  {
    parts[count++] = { point_at(from), point_at(1) };
  }
  return count;
}

Lines make_lines(std::span<const double> first, std::span<const double> second, const Box& box,
  const Request& request, Progress& progress)
{
  return LineMaker(first, second, box, request).make(progress);
}

std::int64_t count_misfits(std::span<const double> lengths, std::span<const double> dist,
  std::span<const double> first, std::span<const double> second) noexcept
{
  constexpr double digits = 1e-5;
  std::int64_t misfits = 0;
  for (std::size_t row = 0; row < dist.size(); ++row)
  {
    double largest = 0;
    for (std::size_t i = 3 * row; i < 3 * row + 3; ++i)
    {
      largest = std::max({ largest, std::abs(first[i]), std::abs(second[i]) });
    }
    const double rounding = digits * (2 * std::abs(dist[row]) + 4 * largest);
    misfits += std::abs(lengths[row] - dist[row]) <= rounding ? 0 : 1;
  }
  return misfits;
}
}
