// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/regions.h"

#include <algorithm>

namespace granular
{
/// Blocks that touch one, also through periodic faces, and come after another.
void Regions::add_later_neighbours(
  std::int64_t block, std::int64_t last, std::vector<std::int64_t>& found) const
{
  const Region at = this->region(8 * block);
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> step = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
    std::array<std::int64_t, 3> next = {};
    bool there = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int64_t to = at.block[k] + step[k];
      next[k] = (to + blocks(k)) % blocks(k);
      there = there && (to == next[k] || axes_[k].periodic);
    }
    const std::int64_t other = (next[2] * blocks(1) + next[1]) * blocks(0) + next[0];
    if (there && other > last)
    {
      found.push_back(other);
    }
  }
}

std::vector<RowRange> Regions::rows_near(const RowRange& rows) const
{
  const std::int64_t low = this->find(rows.first) / 8;
  const std::int64_t high = this->find(rows.last - 1) / 8;
  std::vector<std::int64_t> others;
  for (std::int64_t block = low; block <= high; ++block)
  {
    this->add_later_neighbours(block, high, others);
  }
  std::sort(others.begin(), others.end());
  std::vector<RowRange> ranges = { { rows.last, this->first_of_block(high + 1) } };
  for (const std::int64_t block : others)
  {
    const RowRange more = { this->first_of_block(block), this->first_of_block(block + 1) };
    if (more.first > ranges.back().last)
    {
      ranges.push_back(more);
    }
    ranges.back().last = more.last;
  }
  return ranges;
}
}
