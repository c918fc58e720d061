// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/euler/regular_grids.h"

#include "granular/formats/euler/cell_blocks.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

namespace granular
{
namespace
{
/// Facts that the grids have in common between two faces along an axis.
struct Span
{
  double first = 0; ///< centres
  double last = 0;
  std::int64_t count = 0;
  double spacing = 0; ///< 0: not known
  double lo = 0;
  double hi = 0;
};

using Spans = std::vector<Span>; ///< from low to high

/// Returns the grid by its faces, which a rectilinear grid tells.
RegularGrid grid_of_faces(const EulerFrame& frame, const CellBlocks& cells)
{
  RegularGrid grid;
  std::int64_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& faces = frame.faces[axis];
    const auto count = static_cast<std::int64_t>(faces.size()) - 1;
    EqualSteps steps(faces.front(), cells.tolerance(axis, faces[1] - faces[0]));
    for (std::int64_t i = 0; i < count; ++i)
    {
      const auto at = static_cast<std::size_t>(i);
      if (!(faces[at + 1] > faces[at] && steps.add(faces[at + 1])))
      {
        cells.fail(i * stride, ", which is not as large as those before");
      }
    }
    grid.grid.lo[axis] = faces.front();
    grid.grid.hi[axis] = faces.back();
    grid.grid.counts[axis] = count;
    stride *= count;
  }
  return grid;
}

Span span_of(const CellBlocks& cells, const CellBlock& block, std::size_t axis)
{
  const auto& [x, y, z] = block.counts;
  const std::int64_t count = block.counts[axis];
  const double first = cells.at(block.first, axis);
  const double last = cells.at(block.first + x * y * z - 1, axis);
  const double spacing = count > 1 ? (last - first) / static_cast<double>(count - 1) : 0;
  return { first, last, count, spacing };
}

Spans::const_iterator find_span(const Spans& spans, double first)
{
  return std::ranges::lower_bound(spans, first, std::ranges::less(), &Span::first);
}

Spans make_spans(const CellBlocks& cells, const std::vector<CellBlock>& blocks, std::size_t axis)
{
  Spans spans;
  for (const CellBlock& block : blocks)
  {
    spans.push_back(span_of(cells, block, axis));
  }
  std::ranges::sort(spans, std::ranges::less(), &Span::first);
  const auto same = [](const Span& a, const Span& b) { return a.first == b.first; };
  spans.erase(std::unique(spans.begin(), spans.end(), same), spans.end());
  return spans;
}

/// The grids must be those of processes that divide a box by planes: each combination of spans comes once.
void check_spans(
  const CellBlocks& cells, const std::vector<CellBlock>& blocks, const std::array<Spans, 3>& all)
{
  double combinations = 1;
  for (const Spans& spans : all)
  {
    combinations *= static_cast<double>(spans.size());
  }
  std::vector<bool> seen(blocks.size());
  bool good = combinations == static_cast<double>(blocks.size());
  for (std::size_t i = 0; good && i < blocks.size(); ++i)
  {
    std::size_t number = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Spans& spans = all[axis];
      const Span own = span_of(cells, blocks[i], axis);
      const auto span = find_span(spans, own.first);
      good = good && own.last == span->last && own.count == span->count &&
        (span + 1 == spans.end() || span->last < span[1].first);
      number = number * spans.size() + static_cast<std::size_t>(span - spans.begin());
    }
    good = good && !seen[number];
    seen[number] = true;
  }
  if (!good)
  {
    cells.fail(blocks.size() > 1 ? blocks[1].first : 0,
      ", which does not go on with a grid; there are " + std::to_string(blocks.size()) +
        " parts, which do not fill a box");
  }
}

/// Spans of one cell are what those beside them leave; where all are such, as if they were equal.
void fill_spacings(Spans& spans)
{
  const auto is_known = [](const Span& span) { return span.spacing != 0; };
  if (spans.size() > 1 && std::ranges::none_of(spans, is_known))
  {
    spans[0].spacing = spans[1].first - spans[0].last;
  }
  const auto fill = [&](Span& span, const Span& beside, double distance)
  {
    if (!is_known(span) && is_known(beside))
    {
      span.spacing = 2 * distance - beside.spacing;
    }
  };
  for (std::size_t i = 1; i < spans.size(); ++i)
  {
    fill(spans[i], spans[i - 1], spans[i].first - spans[i - 1].last);
  }
  for (std::size_t i = spans.size() - 1; i > 0; --i)
  {
    fill(spans[i - 1], spans[i], spans[i].first - spans[i - 1].last);
  }
}

/// The mean edge of cells along an axis; 0: not known.
double mean_spacing(const Spans& spans)
{
  double length = 0;
  double cells = 0;
  for (const Span& span : spans)
  {
    length += span.spacing * static_cast<double>(span.count);
    cells += static_cast<double>(span.count);
  }
  return length / cells;
}

/// Along an axis with one cell its edge is a guess.
void find_spacings(const CellBlocks& cells, std::array<Spans, 3>& all, Notices& notices)
{
  double sum = 0;
  int known = 0;
  for (Spans& spans : all)
  {
    fill_spacings(spans);
    sum += mean_spacing(spans);
    known += spans[0].spacing != 0 ? 1 : 0;
  }
  if (known == 0)
  {
    cells.fail(0, " alone, of which nobody knows how large it is");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (all[axis][0].spacing == 0)
    {
      all[axis][0].spacing = sum / known;
      Notice& notice = notices.emplace_back();
      notice.text = std::string("there is one cell along ") + "xyz"[axis] +
        ", and the file does not say how thick it is: it is taken to be " +
        to_text(sum / known, { 6 }) + ", the mean of the other axes";
    }
  }
}

/// Those of neighbours are the same.
void find_bounds(
  const CellBlocks& cells, const std::vector<CellBlock>& blocks, std::size_t axis, Spans& spans)
{
  const auto first_cell = [&](const Span& span)
  {
    return std::ranges::find_if(
      blocks, [&](const CellBlock& block) { return cells.at(block.first, axis) == span.first; })
      ->first;
  };
  for (Span& span : spans)
  {
    span.lo = span.first - span.spacing / 2;
    span.hi = span.last + span.spacing / 2;
    const bool has_room =
      span.spacing > 0 && span.lo < span.hi; // far from the origin rounding may take it
    if (!(has_room && std::isfinite(span.lo) && std::isfinite(span.hi)))
    {
      cells.fail(first_cell(span), ", which has no room");
    }
  }
  for (std::size_t i = 1; i < spans.size(); ++i)
  {
    Span& below = spans[i - 1];
    Span& above = spans[i];
    if (std::abs(above.lo - below.hi) > std::min(below.spacing, above.spacing) / 4)
    {
      cells.fail(first_cell(above), ", which does not begin where others end");
    }
    below.hi = above.lo = std::midpoint(below.hi, above.lo);
  }
}

std::vector<RegularGrid> find_grids(const EulerFrame& frame, Notices& notices)
{
  const CellBlocks cells(frame);
  if (frame.cells == 0)
  {
    return {};
  }
  if (!frame.faces[0].empty())
  {
    return { grid_of_faces(frame, cells) };
  }
  std::vector<CellBlock> blocks;
  for (std::int64_t cell = 0; cell < frame.cells;)
  {
    blocks.push_back(cells.block(cell));
    const auto& [x, y, z] = blocks.back().counts;
    cell += x * y * z;
  }
  std::array<Spans, 3> spans;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    spans[axis] = make_spans(cells, blocks, axis);
  }
  check_spans(cells, blocks, spans);
  find_spacings(cells, spans, notices);
  std::vector<RegularGrid> grids;
  for (const CellBlock& block : blocks)
  {
    grids.push_back({ { {}, {}, block.counts }, block.first });
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    find_bounds(cells, blocks, axis, spans[axis]);
    for (RegularGrid& grid : grids)
    {
      const Span& span = *find_span(spans[axis], cells.at(grid.first, axis));
      grid.grid.lo[axis] = span.lo;
      grid.grid.hi[axis] = span.hi;
    }
  }
  return grids;
}
}

std::vector<RegularGrid> find_regular_grids(const EulerFrame& frame, Notices& notices)
{
  Notices found; // of what is no grid there are none
  std::vector<RegularGrid> grids = find_grids(frame, found);
  notices.insert(notices.end(), found.begin(), found.end());
  return grids;
}
}
