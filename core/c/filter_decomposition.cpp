// SPDX-License-Identifier: BSD-3-Clause
// GranularDecompositionSource and GranularDecomposition.
#include "filter.h"
#include "writer.h"

#include "granular/parallel/pieces.h"
#include "granular/subdomains/decompose.h"

namespace granular_c
{
using namespace granular;

namespace
{
GridRequest grid_of(Settings& settings)
{
  GridRequest request;
  request.processes = settings.integer("NumberOfProcesses", 0);
  const auto counts = settings.numbers<3>("ProcessorGrid", { 1, 1, 1 });
  const char* const cuts[] = { "XCuts", "YCuts", "ZCuts" };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    request.grid[axis] = static_cast<int>(counts[axis]);
    request.cuts[axis] = settings.list(cuts[axis]);
  }
  return request;
}

template <class Value, class Take>
Block block_of_each(const std::vector<Subdomain>& subdomains, const Take& take)
{
  std::vector<Value> values;
  for (const Subdomain& subdomain : subdomains)
  {
    take(subdomain, values);
  }
  return block_of(values);
}

std::unique_ptr<granular_frame> frame_of(const std::vector<Subdomain>& all, FrameHeader header)
{
  Table table;
  table.rows = static_cast<std::int64_t>(all.size());
  table.header = std::move(header);
  for (const auto& [name, corner] : { std::pair("lo", &Subdomain::lo), { "hi", &Subdomain::hi } })
  {
    add_array(table, name, ValueType::Float64, 3,
      block_of_each<double>(all,
        [corner = corner](const Subdomain& each, std::vector<double>& values)
        { values.insert(values.end(), (each.*corner).begin(), (each.*corner).end()); }));
  }
  add_array(table, "nlocal", ValueType::Int64, 1,
    block_of_each<std::int64_t>(
      all, [](const Subdomain& each, auto& values) { values.push_back(each.particles); }));
  add_array(table, "proc", ValueType::Int64, 1,
    block_of_each<std::int64_t>(
      all, [](const Subdomain& each, auto& values) { values.push_back(each.rank); }));
  return make_frame(RowKind::Cells, std::move(table));
}

}

Frames apply_decomposition_source(FilterTask& task)
{
  const auto bounds = task.settings.numbers<6>("Bounds", { 0, 1, 0, 1, 0, 1 });
  const Vector3 lo = { bounds[0], bounds[2], bounds[4] };
  const Vector3 hi = { bounds[1], bounds[3], bounds[5] };
  const ProcessGrid grid = grid_in(grid_of(task.settings), lo, hi);
  const auto [first, last] = range_of_piece(grid.size(), task.piece, task.pieces);
  FrameHeader header;
  header.box = Box::from_bounds(lo, hi);
  header.box.boundary = "ff ff ff";
  Frames frames;
  frames.push_back(frame_of(grid.subdomains(first, last), header));
  return frames;
}

Frames apply_decomposition(FilterTask& task)
{
  Settings& settings = task.settings;
  DecomposeRequest request;
  request.mode = static_cast<SubdomainsOf>(settings.choice("Mode", 4));
  request.bounds = settings.numbers<6>("Bounds", { 1, -1, 1, -1, 1, -1 });
  request.grid = grid_of(settings);
  request.owners = settings.text("ProcessArray", "proc");
  request.read_given = [&]
  {
    const auto given = task.input(1);
    if (given == nullptr)
    {
      throw Error("expected the subdomains as voxels at the second input, got nothing");
    }
    return decomposition_of(given->view);
  };
  request.threads = task.threads;
  const auto particles = task.particles(0);
  const Decomposed found =
    decompose(particles->view, request, task.ranks, task.group, task.notices, task.progress);
  const auto count = static_cast<std::int64_t>(found.all.subdomains.size());
  Frames frames;
  frames.push_back(frame_of(found
                              .part(particles->view, request.mode,
                                range_of_piece(count, task.piece, task.pieces), task.ranks.rank())
                              .subdomains,
    particles->view.header));
  frames.push_back(make_facts({ { "imbalance", { found.imbalance } },
    { "outside", { static_cast<double>(found.outside) } } }));
  return frames;
}
}
