// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/regular_grids.h"

#include "granular/euler/cell_blocks.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

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

class GridFinder
{
public:
  explicit GridFinder(const EulerFrame& frame)
    : frame_(frame)
    , cells_(frame)
  {
  }

  std::vector<RegularGrid> find(Notices& notices);

private:
  RegularGrid grid_of_faces() const;
  Span span_of(const CellBlock& block, std::size_t axis) const;
  std::vector<Span>::iterator find_span(const CellBlock& block, std::size_t axis);
  void make_spans();
  void check_spans();
  void find_spacings(Notices& notices);
  void find_bounds(std::size_t axis);

  const EulerFrame& frame_;
  CellBlocks cells_;
  std::vector<CellBlock> blocks_;
  std::array<std::vector<Span>, 3> spans_; ///< from low to high
};

std::vector<RegularGrid> GridFinder::find(Notices& notices)
{
  if (frame_.cells == 0)
  {
    return {};
  }
  if (!frame_.faces[0].empty())
  {
    return { this->grid_of_faces() };
  }
  for (std::int64_t cell = 0; cell < frame_.cells;)
  {
    blocks_.push_back(cells_.block(cell));
    const auto& counts = blocks_.back().counts;
    cell += counts[0] * counts[1] * counts[2];
  }
  this->make_spans();
  this->check_spans();
  this->find_spacings(notices);
  std::vector<RegularGrid> grids;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->find_bounds(axis);
  }
  for (const CellBlock& block : blocks_)
  {
    RegularGrid& grid = grids.emplace_back(RegularGrid{ {}, block.first });
    grid.grid.counts = block.counts;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Span& span = *this->find_span(block, axis);
      grid.grid.lo[axis] = span.lo;
      grid.grid.hi[axis] = span.hi;
    }
  }
  return grids;
}

/// Returns the grid by its faces, which a rectilinear grid tells.
RegularGrid GridFinder::grid_of_faces() const
{
  RegularGrid grid;
  std::int64_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& faces = frame_.faces[axis];
    const auto cells = static_cast<std::int64_t>(faces.size()) - 1;
    EqualSteps steps(faces.front(), cells_.tolerance(axis, faces[1] - faces[0]));
    for (std::int64_t i = 0; i < cells; ++i)
    {
      const auto at = static_cast<std::size_t>(i);
      if (!(faces[at + 1] > faces[at] && steps.add(faces[at + 1])))
      {
        cells_.fail(i * stride, ", which is not as large as those before");
      }
    }
    grid.grid.lo[axis] = faces.front();
    grid.grid.hi[axis] = faces.back();
    grid.grid.counts[axis] = cells;
    stride *= cells;
  }
  return grid;
}

Span GridFinder::span_of(const CellBlock& block, std::size_t axis) const
{
  const auto& [x, y, z] = block.counts;
  const std::int64_t count = block.counts[axis];
  const double first = cells_.at(block.first, axis);
  const double last = cells_.at(block.first + x * y * z - 1, axis);
  const double spacing = count > 1 ? (last - first) / static_cast<double>(count - 1) : 0;
  return { first, last, count, spacing };
}

std::vector<Span>::iterator GridFinder::find_span(const CellBlock& block, std::size_t axis)
{
  return std::ranges::lower_bound(
    spans_[axis], cells_.at(block.first, axis), std::ranges::less(), &Span::first);
}

void GridFinder::make_spans()
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::vector<Span>& spans = spans_[axis];
    for (const CellBlock& block : blocks_)
    {
      spans.push_back(this->span_of(block, axis));
    }
    std::ranges::sort(spans, std::ranges::less(), &Span::first);
    const auto same = [](const Span& a, const Span& b) { return a.first == b.first; };
    spans.erase(std::unique(spans.begin(), spans.end(), same), spans.end());
  }
}

/// The grids must be those of processes that divide a box by planes: each combination of spans comes once.
void GridFinder::check_spans()
{
  double combinations = 1;
  for (const std::vector<Span>& spans : spans_)
  {
    combinations *= static_cast<double>(spans.size());
  }
  std::vector<bool> seen(blocks_.size());
  bool good = combinations == static_cast<double>(blocks_.size());
  for (std::size_t i = 0; good && i < blocks_.size(); ++i)
  {
    std::size_t number = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto span = this->find_span(blocks_[i], axis);
      const Span own = this->span_of(blocks_[i], axis);
      good = good && own.last == span->last && own.count == span->count &&
        (span + 1 == spans_[axis].end() || span->last < span[1].first);
      number = number * spans_[axis].size() + static_cast<std::size_t>(span - spans_[axis].begin());
    }
    good = good && !seen[number];
    seen[number] = true;
  }
  if (!good)
  {
    cells_.fail(blocks_.size() > 1 ? blocks_[1].first : 0,
      ", which does not go on with a grid; there are " + std::to_string(blocks_.size()) +
        " parts, which do not fill a box");
  }
}

/// Spans of one cell are what those beside them leave; where all are such, as if they were equal.
void fill_spacings(std::vector<Span>& spans)
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
double mean_spacing(const std::vector<Span>& spans)
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
void GridFinder::find_spacings(Notices& notices)
{
  double sum = 0;
  int known = 0;
  for (std::vector<Span>& spans : spans_)
  {
    fill_spacings(spans);
    sum += mean_spacing(spans);
    known += spans[0].spacing != 0 ? 1 : 0;
  }
  if (known == 0)
  {
    cells_.fail(0, " alone, of which nobody knows how large it is");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (spans_[axis][0].spacing == 0)
    {
      spans_[axis][0].spacing = sum / known;
      Notice& notice = notices.emplace_back();
      notice.text = std::string("there is one cell along ") + "xyz"[axis] +
        ", and the file does not say how thick it is: it is taken to be " +
        to_text(sum / known, { 6 }) + ", the mean of the other axes";
    }
  }
}

/// Those of neighbours are the same.
void GridFinder::find_bounds(std::size_t axis)
{
  std::vector<Span>& spans = spans_[axis];
  const auto first_cell = [&](const Span& span)
  {
    return std::ranges::find_if(
      blocks_, [&](const CellBlock& block) { return cells_.at(block.first, axis) == span.first; })
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
      cells_.fail(first_cell(span), ", which has no room");
    }
  }
  for (std::size_t i = 1; i < spans.size(); ++i)
  {
    Span& below = spans[i - 1];
    Span& above = spans[i];
    if (std::abs(above.lo - below.hi) > std::min(below.spacing, above.spacing) / 4)
    {
      cells_.fail(first_cell(above), ", which does not begin where others end");
    }
    below.hi = above.lo = std::midpoint(below.hi, above.lo);
  }
}
}

std::vector<RegularGrid> find_regular_grids(const EulerFrame& frame, Notices& notices)
{
  Notices found; // of what is no grid there are none
  std::vector<RegularGrid> grids = GridFinder(frame).find(found);
  notices.insert(notices.end(), found.begin(), found.end());
  return grids;
}
}
