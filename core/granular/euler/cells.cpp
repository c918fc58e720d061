// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/cells.h"

#include "granular/common/error.h"
#include "granular/parallel/gather.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace granular
{
namespace
{
constexpr EulerArray arrays[] = {
  { "v_avg", 3, &EulerCells::velocities, false },
  { "volumefraction", 1, &EulerCells::volume_fraction, false },
  { "radius", 1, &EulerCells::radius, false },
  { "pressure", 1, &EulerCells::pressure, false },
  { "sigma", 3, &EulerCells::normal_stress, true },
  { "tau", 3, &EulerCells::shear_stress, true },
};

/// The arrays of a packed cell, in their order, and how many values each has of it.
constexpr std::pair<std::vector<double> EulerCells::*, std::size_t> packed_arrays[] = {
  { &EulerCells::centres, 3 },
  { &EulerCells::velocities, 3 },
  { &EulerCells::volume_fraction, 1 },
  { &EulerCells::radius, 1 },
  { &EulerCells::pressure, 1 },
};
constexpr auto packed_size = static_cast<std::size_t>(values_of_cell);

/// The numbers of cells and of values that a rank has.
using ValueCounts = std::array<std::int64_t, 2>;

std::vector<ValueCounts> gather_counts(std::int64_t cells, std::size_t values, Communicator& ranks)
{
  return gather(ranks, ValueCounts{ cells, static_cast<std::int64_t>(values) });
}

/// Values of all ranks one after the other, on rank 0.
std::vector<double> gather_values(std::span<const double> own, Communicator& ranks)
{
  std::vector<std::int64_t> counts(static_cast<std::size_t>(ranks.size()));
  counts[0] = static_cast<std::int64_t>(own.size());
  return trade(own, counts, swap_numbers(counts, ranks), ranks);
}

void expect_size(std::size_t got, std::size_t expected)
{
  if (got != expected)
  {
    throw std::logic_error(
      "expected " + std::to_string(expected) + " values, got " + std::to_string(got));
  }
}

std::size_t size_of(const EulerCells& cells)
{
  return static_cast<std::size_t>(cells.count());
}
}

void EulerCells::resize(std::int64_t cells)
{
  const auto count = static_cast<std::size_t>(cells);
  centres.resize(3 * count);
  for (const EulerArray& array : arrays)
  {
    if (!array.optional)
    {
      (this->*array.values).resize(static_cast<std::size_t>(array.components) * count);
    }
  }
}

std::span<const EulerArray> euler_arrays() noexcept
{
  return arrays;
}

void pack_cells(const EulerCells& cells, std::span<double> buffer)
{
  const std::size_t count = size_of(cells);
  expect_size(buffer.size(), packed_size * count);
  double* to = buffer.data();
  for (const auto& [array, size] : packed_arrays)
  {
    const std::vector<double>& values = cells.*array;
    expect_size(values.size(), size * count);
    for (std::size_t i = 0; i < count; ++i)
    {
      std::copy_n(values.data() + size * i, size, to + packed_size * i);
    }
    to += size;
  }
}

EulerCells unpack_cells(std::span<const double> buffer)
{
  if (buffer.size() % packed_size != 0)
  {
    throw FormatError(
      "expected 9 values for each cell, got " + std::to_string(buffer.size()) + " values");
  }
  EulerCells cells;
  cells.resize(static_cast<std::int64_t>(buffer.size() / packed_size));
  const double* from = buffer.data();
  for (const auto& [array, size] : packed_arrays)
  {
    for (std::size_t i = 0; i < size_of(cells); ++i)
    {
      std::copy_n(from + packed_size * i, size, (cells.*array).data() + size * i);
    }
    from += size;
  }
  return cells;
}

std::vector<double> gather_packed(
  std::span<const double> own, std::int64_t own_cells, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const std::vector<ValueCounts> counts = gather_counts(own_cells, own.size(), ranks);
      for (std::size_t i = 0; i < counts.size(); ++i)
      {
        const auto [cells, values] = counts[i];
        if (values % values_of_cell != 0 || values / values_of_cell != cells)
        {
          throw FormatError("expected 9 values for each of " + std::to_string(cells) +
            " cells of process " + std::to_string(i) + ", got " + std::to_string(values));
        }
      }
      return gather_values(own, ranks);
    });
}

EulerCells gather_cells(const EulerCells& own, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      std::vector<double> packed(packed_size * size_of(own));
      pack_cells(own, packed);
      EulerCells all = unpack_cells(gather_packed(packed, own.count(), ranks));
      for (const EulerArray& array : arrays)
      {
        if (!array.optional)
        {
          continue;
        }
        const std::vector<double>& values = own.*array.values;
        const std::vector<ValueCounts> counts = gather_counts(own.count(), values.size(), ranks);
        // known where all who have cells know it
        if (std::ranges::all_of(counts,
              [&](const ValueCounts& each) { return each[1] == array.components * each[0]; }))
        {
          all.*array.values = gather_values(values, ranks);
        }
      }
      return all;
    });
}
}
