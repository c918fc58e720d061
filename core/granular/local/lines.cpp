// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/lines.h"

#include "granular/local/minimum_image.h"
#include "granular/local/split_line.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
    const LineRequest& request)
    : first_(first)
    , second_(second)
    , request_(request)
    , rows_(first.size() / 3)
    , images_(request.periodic == PeriodicLines::AsWritten ? Box{} : box)
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
      this->for_chunks(part, [this](std::size_t chunk) { this->count(chunk); });
      part.set_part(0.4, 1);
    }
    this->make_room();
    this->for_chunks(part, [this](std::size_t chunk) { this->fill(chunk); });
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
    std::size_t lines = 0;
    std::size_t first_line = 0;
    std::int64_t moved = 0;
  };

  bool splits() const noexcept
  {
    return request_.periodic == PeriodicLines::Split && images_.is_periodic();
  }

  template <class Task>
  void for_chunks(Progress& progress, const Task& task)
  {
    executor_.parallel_for(
      counts_.size(), [&](std::size_t chunk, std::size_t) { task(chunk); }, progress);
  }

  /// The row after the last one of a chunk.
  std::size_t end_of(std::size_t chunk) const noexcept
  {
    return std::min((chunk + 1) * rows_a_chunk, rows_);
  }

  static Vector3 point_of(std::span<const double> points, std::size_t row) noexcept
  {
    return { points[3 * row], points[3 * row + 1], points[3 * row + 2] };
  }

  static Vector3 difference(const Vector3& a, const Vector3& b) noexcept
  {
    return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  }

  void count(std::size_t chunk)
  {
    const std::size_t begin = chunk * rows_a_chunk;
    const std::size_t end = this->end_of(chunk);
    std::size_t lines = end - begin;
    Parts parts;
    for (std::size_t row = begin; row < end; ++row)
    {
      const Vector3 first = point_of(first_, row);
      const Vector3 second = point_of(second_, row);
      const BoxCounts counts = images_.find(difference(second, first));
      if (counts != BoxCounts{})
      {
        lines += splitter_.split(first, second, counts, parts) - 1;
      }
    }
    counts_[chunk].lines = lines;
  }

  void make_room()
  {
    std::size_t lines = 0;
    for (std::size_t chunk = 0; chunk < counts_.size(); ++chunk)
    {
      Counts& counts = counts_[chunk];
      counts.lines = this->splits() ? counts.lines : this->end_of(chunk) - chunk * rows_a_chunk;
      counts.first_line = lines;
      lines += counts.lines;
    }
    lines_.count = static_cast<std::int64_t>(lines);
    lines_.points = Block(lines * 2 * sizeof(Vector3), request_.pool);
    lines_.lengths = Block(rows_ * sizeof(double), request_.pool);
    lines_.rows.resize(lines == rows_ ? 0 : lines);
  }

  void fill(std::size_t chunk)
  {
    auto* const lengths = static_cast<double*>(lines_.lengths.data());
    auto* part = static_cast<LinePart*>(lines_.points.data()) + counts_[chunk].first_line;
    std::size_t line = counts_[chunk].first_line;
    std::int64_t moved = 0;
    Parts parts;
    for (std::size_t row = chunk * rows_a_chunk; row < this->end_of(chunk); ++row)
    {
      const Vector3 first = point_of(first_, row);
      const Vector3 second = point_of(second_, row);
      const Vector3 vector = difference(second, first);
      const BoxCounts counts = images_.find(vector);
      std::size_t made = 1;
      if (counts == BoxCounts{})
      {
        parts[0] = { difference(first, request_.point_origin),
          difference(second, request_.point_origin) };
        lengths[row] = length_of(vector);
      }
      else
      {
        made = this->splits() ? splitter_.split(first, second, counts, parts) : 1;
        if (!this->splits())
        {
          parts[0] = { difference(first, request_.point_origin),
            images_.moved(second, counts, request_.point_origin) };
        }
        lengths[row] = length_of(images_.moved(second, counts, first));
        ++moved;
      }
      part = std::copy_n(parts.begin(), made, part);
      for (; made > 0; --made, ++line)
      {
        if (!lines_.rows.empty())
        {
          lines_.rows[line] = static_cast<std::int64_t>(row);
        }
      }
    }
    counts_[chunk].moved = moved;
  }

  std::span<const double> first_;
  std::span<const double> second_;
  const LineRequest& request_;
  std::size_t rows_;
  MinimumImage images_;
  LineSplitter splitter_;
  Executor executor_;
  std::vector<Counts> counts_; ///< of each chunk
  Lines lines_;
};
}

Lines make_lines(std::span<const double> first, std::span<const double> second, const Box& box,
  const LineRequest& request, Progress& progress)
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
