// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularHiddenGrains.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <future>
#include <limits>
#include <thread>

namespace
{
// A part of a radius: rays so near to the centre meet the sphere in front of its centre. In perspective they do up to the cosine of their
// angle with the line of sight, since the outer flank of a sphere beside it is behind the centre. The tangent of the outermost of these rays
// is (distance from the line of sight + radius) / distance along it.
constexpr float InnerPart = 0.95F;
constexpr float Floats = 0.99F;             // a margin for what they round
constexpr int MostCells = 2048;             // along an axis
constexpr float CellPart = 0.3F;            // of a radius that a cell is long
constexpr int BlockSide = 4;                // cells
constexpr vtkIdType FewestOfThread = 20000; // particles
constexpr vtkIdType MostThreads = 8;

// Does something for parts of a range, each in a thread of its own.
template <typename Do>
void ForParts(vtkIdType count, std::size_t parts, const Do& work)
{
  std::vector<std::future<void>> others;
  const auto begin = [&](std::size_t part)
  { return count * static_cast<vtkIdType>(part) / static_cast<vtkIdType>(parts); };
  for (std::size_t part = 1; part < parts; ++part)
  {
    others.push_back(std::async(std::launch::async,
      [&work, part, from = begin(part), to = begin(part + 1)] { work(part, from, to); }));
  }
  work(0, 0, begin(1));
  for (std::future<void>& other : others)
  {
    other.get();
  }
}

struct Centre
{
  float X, Y;
  float Away; // towards what the camera looks at
};

Centre CentreOf(const vtkGranularHiddenGrains::View& view, const float* point)
{
  const auto row = [&](const float(&m)[4])
  { return m[0] * point[0] + m[1] * point[1] + m[2] * point[2] + m[3]; };
  return { row(view.ToCamera[0]), row(view.ToCamera[1]), -row(view.ToCamera[2]) };
}

bool IsFinite(const Centre& centre)
{
  return std::isfinite(centre.X + centre.Y + centre.Away);
}
}

// A rectangle or an ellipse of the picture, which here goes from 0 to 1.
struct vtkGranularHiddenGrains::Square
{
  Square(const View& view, const Centre& centre, float radius, float away)
    : Away(away)
  {
    const float at[2] = { centre.X, centre.Y };
    const float near = view.Parallel ? 1.0F : 1.0F / centre.Away;
    const float ratio = view.Parallel ? 0.0F : radius * near;
    const float inverse = 1.0F / ((1.0F - ratio) * (1.0F + ratio));
    for (int axis = 0; axis < 2; ++axis)
    {
      const float tangent = view.Parallel ? 0.0F : at[axis] * near;
      const float size =
        radius * near * std::sqrt(1.0F + tangent * tangent - ratio * ratio) * inverse;
      Middle[axis] =
        0.5F + 0.5F * (view.Scale[axis] * (at[axis] * near * inverse) + view.Middle[axis]);
      Half[axis] = std::abs(0.5F * view.Scale[axis] * size);
    }
  }

  float Middle[2];
  float Half[2];
  float Away;
};

const vtkGranularHiddenGrains::Seen& vtkGranularHiddenGrains::Find(
  const View& view, const Grains& grains)
{
  this->MakeCells(view, grains);
  const auto parts = static_cast<std::size_t>(std::clamp<vtkIdType>(grains.Count / FewestOfThread,
    1, std::clamp<vtkIdType>(std::thread::hardware_concurrency(), 1, MostThreads)));
  std::vector<std::vector<float>> depths(parts - 1, this->Depths); // of the other threads
  ForParts(grains.Count, parts,
    [&](std::size_t part, vtkIdType begin, vtkIdType end)
    { this->CoverBy(view, grains, begin, end, part == 0 ? this->Depths : depths[part - 1]); });
  for (const std::vector<float>& others : depths)
  {
    std::transform(others.begin(), others.end(), this->Depths.begin(), this->Depths.begin(),
      [](float a, float b) { return std::min(a, b); });
  }
  this->MakeBlocks();
  std::vector<Seen> seen(parts);
  ForParts(grains.Count, parts,
    [&](std::size_t part, vtkIdType begin, vtkIdType end)
    { seen[part] = this->FindSeen(view, grains, begin, end); });
  this->Found.Grains.clear();
  this->Found.Parts.clear();
  for (const Seen& each : seen)
  {
    this->Found.Grains.insert(this->Found.Grains.end(), each.Grains.begin(), each.Grains.end());
    this->Found.Parts.insert(this->Found.Parts.end(), each.Parts.begin(), each.Parts.end());
  }
  return this->Found;
}

// Makes some particles hide what is behind them. A few of all depths come first: behind these, most others need not be drawn.
void vtkGranularHiddenGrains::CoverBy(const View& view, const Grains& grains, vtkIdType begin,
  vtkIdType end, std::vector<float>& depths) const
{
  for (const vtkIdType step : { 64, 8, 1 })
  {
    for (vtkIdType i = begin; i < end; i += step)
    {
      const float radius = grains.Inner[i] * view.Radius;
      const Centre centre = CentreOf(view, grains.Points + 3 * i);
      if (IsFinite(centre) && radius > 0.0F && radius - centre.Away <= view.Near)
      {
        const float beside = view.Parallel ? 0.0F : std::hypot(centre.X, centre.Y) + radius;
        const float cosine = centre.Away / std::hypot(centre.Away, beside);
        const float part = std::min(InnerPart, Floats * cosine);
        this->Cover(Square(view, centre, part * radius, centre.Away), depths);
      }
    }
  }
}

// Returns some of the particles: those that may be seen.
vtkGranularHiddenGrains::Seen vtkGranularHiddenGrains::FindSeen(
  const View& view, const Grains& grains, vtkIdType begin, vtkIdType end) const
{
  Seen found;
  for (vtkIdType i = begin; i < end; ++i)
  {
    const float radius = grains.Outer[i] * view.Radius;
    const Centre centre = CentreOf(view, grains.Points + 3 * i);
    if (!IsFinite(centre) || !(radius > 0.0F) || -centre.Away - radius > view.Near)
    {
      continue; // nothing is drawn of it
    }
    std::array<unsigned char, 4> part = { 0, 0, 255, 255 };
    if ((!view.Parallel && centre.Away < 2.0F * radius) ||
      this->FindPart(Square(view, centre, radius, centre.Away - radius), part))
    {
      found.Grains.push_back(i);
      found.Parts.push_back(part);
    }
  }
  return found;
}

// Cells that are so small that a typical particle covers some.
void vtkGranularHiddenGrains::MakeCells(const View& view, const Grains& grains)
{
  const vtkIdType step = std::max<vtkIdType>(1, grains.Count / 1000);
  std::vector<float> sizes;
  for (vtkIdType i = 0; i < grains.Count; i += step)
  {
    const float away = view.Parallel ? 1.0F : CentreOf(view, grains.Points + 3 * i).Away;
    const float size = grains.Inner[i] * view.Radius / away;
    if (size > 0.0F) // in front of the camera
    {
      sizes.push_back(size);
    }
  }
  float size = 0.0F;
  if (!sizes.empty())
  {
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    size = *middle;
  }
  const float cell =
    0.5F * CellPart * size * std::min(std::abs(view.Scale[0]), std::abs(view.Scale[1]));
  this->Side = static_cast<int>(
    std::clamp(1.0F / std::max(cell, 1e-6F), 256.0F, static_cast<float>(MostCells)));
  this->Depths.assign(static_cast<std::size_t>(this->Side) * static_cast<std::size_t>(this->Side),
    std::numeric_limits<float>::infinity());
}

// Makes the cells that are wholly in an ellipse hide what is behind it.
void vtkGranularHiddenGrains::Cover(const Square& square, std::vector<float>& depths) const
{
  const int column = this->CellOf(square.Middle[0]);
  const int middle = this->CellOf(square.Middle[1]);
  const bool is_inside = column >= 0 && middle >= 0 && column < this->Side && middle < this->Side;
  if (!is_inside ||
    depths[static_cast<std::size_t>(middle * this->Side) + static_cast<std::size_t>(column)] <
      square.Away)
  {
    return; // others hide it, or most of it
  }
  const auto side = static_cast<float>(this->Side);
  const auto cell = [&](float at) { return static_cast<int>(std::clamp(at, 0.0F, side)); };
  const int y0 = cell(std::ceil((square.Middle[1] - square.Half[1]) * side));
  const int y1 = cell(std::floor((square.Middle[1] + square.Half[1]) * side));
  for (int y = y0; y < y1; ++y)
  {
    const float low = (static_cast<float>(y) / side - square.Middle[1]) / square.Half[1];
    const float high = (static_cast<float>(y + 1) / side - square.Middle[1]) / square.Half[1];
    const float half =
      square.Half[0] * std::sqrt(std::max(0.0F, 1.0F - std::max(low * low, high * high)));
    const int x1 = cell(std::floor((square.Middle[0] + half) * side));
    float* row = depths.data() + static_cast<std::ptrdiff_t>(y) * this->Side;
    for (int x = cell(std::ceil((square.Middle[0] - half) * side)); x < x1; ++x)
    {
      row[x] = std::min(row[x], square.Away);
    }
  }
}

// Finds for each block of cells the depth behind which all is hidden.
void vtkGranularHiddenGrains::MakeBlocks()
{
  this->BlockSides = (this->Side + BlockSide - 1) / BlockSide;
  this->Blocks.assign(static_cast<std::size_t>(this->BlockSides * this->BlockSides),
    -std::numeric_limits<float>::infinity());
  for (int y = 0; y < this->Side; ++y)
  {
    const float* row = this->Depths.data() + static_cast<std::ptrdiff_t>(y) * this->Side;
    float* blocks =
      this->Blocks.data() + static_cast<std::ptrdiff_t>(y / BlockSide) * this->BlockSides;
    for (int x = 0; x < this->Side; ++x)
    {
      blocks[x / BlockSide] = std::max(blocks[x / BlockSide], row[x]);
    }
  }
}

// Returns true if a part of a square may be seen, and which.
bool vtkGranularHiddenGrains::FindPart(
  const Square& square, std::array<unsigned char, 4>& part) const
{
  int low[2];
  int high[2];
  for (int axis = 0; axis < 2; ++axis)
  {
    low[axis] = std::max(0, this->CellOf(square.Middle[axis] - square.Half[axis]));
    high[axis] = std::min(this->Side - 1, this->CellOf(square.Middle[axis] + square.Half[axis]));
  }
  bool hidden = true; // most are
  for (int y = low[1] / BlockSide; hidden && y <= high[1] / BlockSide; ++y)
  {
    const float* row = this->Blocks.data() + static_cast<std::ptrdiff_t>(y) * this->BlockSides;
    for (int x = low[0] / BlockSide; x <= high[0] / BlockSide; ++x)
    {
      hidden = hidden && row[x] < square.Away;
    }
  }
  if (hidden)
  {
    return false;
  }
  int first[2] = { this->Side, this->Side };
  int last[2] = { -1, -1 };
  for (int y = low[1]; y <= high[1]; ++y)
  {
    const float* row = this->Depths.data() + static_cast<std::ptrdiff_t>(y) * this->Side;
    for (int x = low[0]; x <= high[0]; ++x)
    {
      if (row[x] >= square.Away)
      {
        first[0] = std::min(first[0], x);
        last[0] = std::max(last[0], x);
        first[1] = std::min(first[1], y);
        last[1] = y;
      }
    }
  }
  for (int axis = 0; axis < 2 && last[0] >= 0; ++axis)
  {
    const float begin = square.Middle[axis] - square.Half[axis];
    const auto step = [&](int cell)
    {
      return (static_cast<float>(cell) / static_cast<float>(this->Side) - begin) *
        (255.0F / (2.0F * square.Half[axis]));
    };
    const auto byte = [](float at)
    { return static_cast<unsigned char>(std::clamp(at, 0.0F, 255.0F)); };
    part[static_cast<std::size_t>(axis)] =
      byte(std::floor(step(first[axis])) - 1.0F); // a step wider: floats
    part[static_cast<std::size_t>(axis) + 2] = byte(std::ceil(step(last[axis] + 1)) + 1.0F);
  }
  return last[0] >= 0;
}

// Returns the number of the cell that a place is in, from -1 to Side, which are outside.
int vtkGranularHiddenGrains::CellOf(float at) const
{
  const auto side = static_cast<float>(this->Side);
  return static_cast<int>(std::clamp(at * side, -1.0F, side) + 1.0F) - 1;
}
