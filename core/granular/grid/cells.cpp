// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/cells.h"

#include "granular/parallel/trade.h"

#include <algorithm>
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

/// Values of all ranks one after the other, on rank 0.
std::vector<double> gather_values(const std::vector<double>& own, Communicator& ranks)
{
  std::vector<std::int64_t> counts(static_cast<std::size_t>(ranks.size()));
  counts[0] = static_cast<std::int64_t>(own.size());
  return trade(own, counts, swap_numbers(counts, ranks), ranks);
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

EulerCells gather_cells(const EulerCells& own, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      EulerCells all;
      const auto bring = [&](const EulerArray& array)
      {
        const std::vector<double>& values = own.*array.values;
        const auto size = static_cast<std::size_t>(array.components * own.count());
        if (values.size() != size && !array.optional)
        {
          throw std::logic_error("expected " + std::to_string(size) + " values of cells, got " +
            std::to_string(values.size()));
        }
        // known where all who have cells know it
        std::int64_t lacking = values.size() != size ? 1 : 0;
        ranks.sum({ &lacking, 1 });
        if (lacking == 0)
        {
          all.*array.values = gather_values(values, ranks);
        }
      };
      bring({ "centres", 3, &EulerCells::centres, false });
      std::ranges::for_each(arrays, bring);
      return all;
    });
}

EulerFrame make_euler_frame(EulerCells&& cells, EulerFields&& fields)
{
  EulerFrame frame;
  frame.cells = cells.count();
  frame.centres = std::move(cells.centres);
  for (const EulerArray& array : arrays)
  {
    std::vector<double>& values = cells.*array.values;
    if (!array.optional || !values.empty())
    {
      frame.arrays.push_back({ std::string(array.name), array.components, std::move(values) });
    }
  }
  for (const EulerField& field : euler_fields)
  {
    std::vector<double>& values = fields.*field.values;
    if (!values.empty())
    {
      frame.arrays.push_back({ std::string(field.name), field.components, std::move(values) });
    }
  }
  return frame;
}
}
