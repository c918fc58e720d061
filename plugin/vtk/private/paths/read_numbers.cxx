// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/read_numbers.h"

#include "granular/euler/grain_values.h"
#include "granular/grid/sphere_box.h"
#include "granular/local/fetch_particles.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>

namespace vtkGranularPrivate
{
namespace
{
std::vector<double> Load(const granular::ValueSource& source, const std::vector<std::int64_t>& rows)
{
  std::vector<double> values(rows.size());
  granular::load_numbers(source, rows, values.data());
  for (double& value : values)
  {
    value *= source.factor;
  }
  return values;
}
}

std::vector<std::int64_t> ReadIds(const granular::ArrayView& array, std::int64_t allRows,
  const std::vector<vtkIdType>& rows, granular::Progress& progress)
{
  const granular::Ids all(array, allRows, granular::Executor(), progress);
  std::vector<std::int64_t> ids;
  std::ranges::transform(rows, std::back_inserter(ids),
    [&](vtkIdType row) { return all.values()[static_cast<std::size_t>(row)]; });
  return ids;
}

std::optional<std::vector<double>> ReadMasses(const granular::FrameView& view,
  const std::string& name, const std::vector<vtkIdType>& rows, granular::Communicator& ranks)
{
  const granular::GrainSources sources =
    granular::find_grain_sources(view, { "", "radius", name, "" });
  const bool known = sources.mass || (sources.density && sources.radius);
  std::array<std::int64_t, 2> counts = { view.rows > 0 && known ? 1 : 0,
    view.rows > 0 && !known ? 1 : 0 };
  ranks.sum(counts);
  if (counts[0] == 0 || counts[1] > 0)
  {
    return {};
  }
  if (view.rows == 0)
  {
    return std::vector<double>();
  }
  const std::vector<std::int64_t> all(rows.begin(), rows.end());
  if (sources.mass)
  {
    return Load(*sources.mass, all);
  }
  std::vector<double> masses = Load(*sources.density, all);
  const std::vector<double> radii = Load(*sources.radius, all);
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    masses[i] *= granular::sphere_volume(radii[i]);
  }
  return masses;
}
}
