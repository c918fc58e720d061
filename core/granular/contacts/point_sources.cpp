// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/point_sources.h"

#include "granular/grid/periodic_images.h"
#include "granular/grid/sphere_box.h"
#include "granular/parallel/gather.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
constexpr auto most_rows = static_cast<std::int64_t>(GrainBlock::most_rows);

class SourceFinder
{
public:
  SourceFinder(
    const FrameView& frame, const Extent& wanted, Communicator& ranks, Progress& progress)
    : frame_(frame)
    , ranks_(ranks)
    , progress_(progress)
    , extents_(gather(ranks, std::array{ wanted.lo, wanted.hi }))
  {
  }

  PointSources run(const GrainSources& sources, const FoundEnds* contacts)
  {
    found_.grains = this->send_grains(sources);
    if (contacts)
    {
      found_.lines = this->send_lines(contacts);
    }
    return std::move(found_);
  }

private:
  /// The images that reach into what the points of all ranks reach.
  PeriodicImages find_images() const
  {
    Extent all;
    for (const auto& [lo, hi] : extents_)
    {
      if (lo[0] <= hi[0])
      {
        all.include(lo);
        all.include(hi);
      }
    }
    const EulerGrid grid = all.empty() ? EulerGrid{ {}, { 1, 1, 1 }, { 1, 1, 1 } }
                                       : EulerGrid{ all.lo, all.hi, { 1, 1, 1 } };
    return PeriodicImages(grid, frame_.has_box ? &frame_.header.box : nullptr);
  }

  /// Returns true for what reaches the points of any rank.
  template <class Thing>
  bool is_wanted(const Thing& thing) const
  {
    return std::ranges::any_of(extents_,
      [extent = extent_of(thing)](const std::array<Vector3, 2>& wanted) {
        return extent.meets({ wanted[0], wanted[1] });
      });
  }

  /// Sends what reaches the points of a rank to it.
  template <class Thing>
  std::vector<Thing> send(std::vector<Thing> things)
  {
    if (ranks_.size() == 1)
    {
      return things;
    }
    std::vector<Thing> out;
    std::vector<std::int64_t> counts;
    for (const auto& [lo, hi] : extents_)
    {
      const Extent wanted{ lo, hi };
      const std::size_t before = out.size();
      std::ranges::copy_if(things, std::back_inserter(out),
        [&](const Thing& thing) { return extent_of(thing).meets(wanted); });
      counts.push_back(static_cast<std::int64_t>(out.size() - before));
    }
    return trade(out, counts, swap_numbers(counts, ranks_), ranks_);
  }

  std::vector<NearGrain> send_grains(const GrainSources& sources)
  {
    const GrainValues values(frame_, sources);
    const PeriodicImages images = this->find_images();
    images.check(0);
    std::vector<NearGrain> grains;
    GrainBlock block;
    std::vector<std::int64_t> rows(GrainBlock::most_rows);
    GrainValues::Scan scan;
    for (std::int64_t first = 0; first < frame_.rows; first += most_rows)
    {
      const auto count = std::min(frame_.rows - first, most_rows);
      std::iota(rows.begin(), rows.begin() + count, first);
      values.scan(std::span(rows).first(static_cast<std::size_t>(count)), block, scan);
      for (std::size_t i = 0; i < block.rows; ++i)
      {
        if (block.uses(i))
        {
          const double* const v = block.velocities + 3 * i;
          images.each(block.positions + 3 * i, 0,
            [&](const Twofold3& image)
            {
              const NearGrain grain = { values_of(image), { v[0], v[1], v[2] }, block.mass[i],
                block.radius[i], sphere_volume(block.radius[i]) };
              if (this->is_wanted(grain))
              {
                grains.push_back(grain);
              }
            });
        }
      }
      progress_.step(static_cast<double>(first) / static_cast<double>(frame_.rows));
    }
    found_.broken = scan.broken;
    ranks_.sum({ &found_.broken, 1 });
    return this->send(std::move(grains));
  }

  /// The longest component of the branches of all ranks.
  double find_longest(const FoundEnds& contacts)
  {
    double longest = 0;
    for (std::size_t i = 0; i < contacts.rows(); ++i)
    {
      const auto [ends, row] = contacts.at(static_cast<std::int64_t>(i));
      if (ends.has_line(row))
      {
        for (const double component : ends.branch(row))
        {
          longest = std::max(longest, std::abs(component));
        }
      }
    }
    return std::ranges::max(gather(ranks_, longest));
  }

  std::vector<NearLine> send_lines(const FoundEnds* contacts)
  {
    const PeriodicImages images = this->find_images();
    images.check(this->find_longest(*contacts) / 2);
    std::vector<NearLine> lines;
    for (std::size_t i = 0; i < contacts->rows(); ++i)
    {
      if (i % 65536 == 0)
      {
        progress_.step(static_cast<double>(i) / static_cast<double>(contacts->rows()));
      }
      const auto [ends, row] = contacts->at(static_cast<std::int64_t>(i));
      if (!ends.has_line(row))
      {
        continue;
      }
      NearLine line;
      const Vector3 start = ends.first(row);
      line.branch = ends.branch(row);
      line.normal = ContactEnds::normal(line.branch);
      line.counts = ends.counts(row);
      line.ends = line.counts * (ends.is_wall() ? 1 : 2);
      line.force = ends.force(row);
      Vector3 middle;
      Vector3 reach;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        line.force[axis] *= ends.is_wall() ? -1 : 1;
        middle[axis] = start[axis] + line.branch[axis] / 2;
        reach[axis] = std::abs(line.branch[axis]) / 2;
      }
      images.each(middle.data(), reach,
        [&](const Twofold3& image)
        {
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            line.start[axis] = start[axis] + (image[axis].hi - middle[axis] + image[axis].lo);
          }
          if (this->is_wanted(line))
          {
            lines.push_back(line);
          }
        });
    }
    return this->send(std::move(lines));
  }

  const FrameView& frame_;
  Communicator& ranks_;
  Progress& progress_;
  std::vector<std::array<Vector3, 2>> extents_; ///< of all ranks
  PointSources found_;
};
}

Extent extent_of(const NearGrain& grain) noexcept
{
  return { grain.place, grain.place };
}

Extent extent_of(const NearLine& line) noexcept
{
  Extent extent;
  extent.include(line.start);
  extent.include({ line.start[0] + line.branch[0], line.start[1] + line.branch[1],
    line.start[2] + line.branch[2] });
  return extent;
}

PointSources find_point_sources(const FrameView& frame, const GrainSources& sources,
  const FoundEnds* contacts, const Extent& wanted, Communicator& ranks, Progress& progress)
{
  return do_together(
    ranks, [&] { return SourceFinder(frame, wanted, ranks, progress).run(sources, contacts); });
}
}
