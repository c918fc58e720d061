// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/decomposition_file.h"

#include "granular/common/hash.h"
#include "granular/common/words.h"
#include "granular/formats/decomposition/decomposition_grid.h"
#include "granular/formats/decomposition/voxels.h"
#include "granular/formats/decomposition/vtu_grids.h"
#include "granular/frames/file_index.h"
#include "granular/frames/named_steps.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace granular
{
namespace
{
/// Line 2 of what LIGGGHTS-PUBLIC and PFM write.
constexpr std::string_view liggghts_title = "LIGGGHTS mesh/gran/VTK export";

std::string read_all(const ByteSource& source)
{
  return read_up_to(source, std::numeric_limits<std::int64_t>::max());
}

/// Pieces of one grid have the same.
std::uint64_t shape_of(const DecompositionGrid& grid)
{
  if (!grid.is_piece())
  {
    return FrameEntry::whole;
  }
  Hash hash;
  hash.add(grid.dimensions.data(), sizeof grid.dimensions);
  return std::max(hash.value(), std::uint64_t{ 1 });
}

/// A file of XML is one frame.
void index_vtu(const ByteSource& source, FileIndex& index)
{
  index.frames.clear();
  const std::string text = read_all(source);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), is_blank);
  if (!std::string_view(text.begin(), last.base()).ends_with("</VTKFile>"))
  {
    set_defect(
      index, { { source.path() }, "expected </VTKFile> at the end of the file, got none" });
    return;
  }
  add_whole(index,
    { .rows = VtuGrids(text, source.path()).cells(),
      .end = static_cast<std::int64_t>(text.size()),
      .line = 1 },
    nullptr);
}

/// More frames that are left out are counted only.
constexpr std::size_t most_notices = 100;

/// Headers may be as short as one of their lines: progress is reported after so many.
constexpr int report_interval = 1000;

/// The last frame is indexed again: data of its cells may have come.
VtkPlace first_place(FileIndex& index)
{
  if (!index.frames.empty())
  {
    index.resume_offset = index.frames.back().offset;
    index.resume_line = std::max(index.frames.back().line, std::int64_t{ 1 });
    index.frames.pop_back();
  }
  return { index.resume_offset, index.resume_line };
}

void add(const DecompositionGrid& grid, const VtkPlace& end, FileIndex& index)
{
  FrameEntry entry;
  entry.timestep = static_cast<std::int64_t>(index.frames.size());
  entry.rows = grid.cells;
  entry.offset = grid.header.place.offset;
  entry.end = end.offset;
  entry.line = grid.header.binary ? 0 : grid.header.place.line;
  entry.shape = shape_of(grid);
  entry.kind = index.kinds->share(FrameKind{});
  index.frames.push_back(std::move(entry));
  index.resume_offset = end.offset;
  index.resume_line = std::max(end.line, std::int64_t{ 1 }); // 0 in binary files
}

/// Adds the next grid of a legacy file. Returns false at the end.
bool add_grid(LegacyVtk& file, FileIndex& index, std::int64_t& untold)
{
  if (!file.at_header() && file.at_end())
  {
    return false;
  }
  const VtkPlace start = file.place();
  const auto missed = [&](const Error& error)
  {
    const bool ended = file.ended();
    const bool more = file.find_header({ start.offset + 1, start.line });
    set_defect(index, { error.where(), error.text() });
    if (ended && !more) // it may still be growing
    {
      return false;
    }
    if (index.notices.size() >= most_notices)
    {
      ++untold;
    }
    else
    {
      index.notices.push_back({ error.where(), error.text() + "; the frame is left out" });
    }
    return more;
  };
  try
  {
    const DecompositionGrid grid = read_grid(file, false);
    add(grid, file.place(), index);
    if (!grid.rectilinear() && file.at_header())
    {
      index.notices.push_back({ file.where(file.place()),
        "expected the end of the file behind an unstructured grid, got another header; what "
        "follows is left out" });
    }
    return grid.rectilinear();
  }
  catch (const FormatError& error)
  {
    return missed(error);
  }
  catch (const LimitError& error)
  {
    return missed(error);
  }
}

void index_legacy(const ByteSource& source, FileIndex& index, Progress& progress)
{
  LegacyVtk file(source, first_place(index), LegacyVtk::no_end, progress);
  std::int64_t untold = 0; // frames that are left out
  for (int headers = 1; add_grid(file, index, untold); ++headers)
  {
    if (headers % report_interval == 0)
    {
      progress.step(source.fraction(file.place().offset));
    }
  }
  if (untold > 0)
  {
    index.notices.push_back({ { source.path() },
      "and " + std::to_string(untold) +
        (untold == 1 ? " more frame is left out" : " more frames are left out") });
  }
}

void index_decomposition(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead&)
{
  if (is_vtu(read_up_to(source, vtu_head_bytes)))
  {
    index_vtu(source, index);
  }
  else
  {
    index_legacy(source, index, progress);
  }
}

/// Returns true if the first cell of a grid is a box along the axes, and none is of a type that never is.
bool begins_with_box(const DecompositionGrid& grid)
{
  Subdomain subdomain;
  return grid.cells == 0 ||
    bounds_of(
      grid, 0, [](std::int64_t) { return Where(); }, subdomain) != CornerOrder::None;
}

/// Returns true if a reader gives the cells of a decomposition. Damaged ones are: the reader says why.
template <class Read>
bool has_boxes(Read read)
{
  try
  {
    return begins_with_box(read());
  }
  catch (const UnsupportedError&)
  {
    return false;
  }
  catch (const FormatError&)
  {
    return true;
  }
}

bool is_legacy(const ByteSource& source)
{
  Progress progress;
  LegacyVtk file(source, {}, LegacyVtk::no_end, progress);
  if (!file.at_header())
  {
    return false;
  }
  const VtkPlace start = file.place();
  const VtkHeader header = file.read_header();
  const bool has_title = header.title == liggghts_title;
  const bool rectilinear = header.dataset == vtk_rectilinear;
  if (header.dataset.empty() || (rectilinear && !has_title))
  {
    return has_title;
  }
  const auto read = [&](bool keep)
  {
    file.go_to(start);
    return read_grid(file, keep);
  };
  try
  {
    const DecompositionGrid grid = read(false);
    return rectilinear ? !grid.has_data
                       : grid.has_particles && has_boxes([&] { return read(true); });
  }
  catch (const FormatError&)
  {
    return rectilinear && file.ended(); // LIGGGHTS may be at work
  }
}

/// head: the first bytes, which tell most files of others.
bool is_decomposition_vtu(const ByteSource& source, std::string_view head)
{
  if (!VtuGrids(head, {}).may_be_subdomains())
  {
    return false;
  }
  const std::string text = read_all(source);
  const VtuGrids grids(text, {});
  return grids.may_be_subdomains() && grids.has_ranks() &&
    has_boxes(
      [&]
      {
        grids.check();
        return grids.size() > 0 ? grids.read(0) : DecompositionGrid();
      });
}
}

const FileFormat& decomposition_format() noexcept
{
  static constexpr FileFormat format = { .name = "a decomposition file",
    .index = &index_decomposition,
    .complete = &name_steps,
    .reads_vtk = true };
  return format;
}

bool is_decomposition_file(const std::string& path) noexcept
{
  return looks_so(path,
    [](const ByteSource& source)
    {
      const std::string head = read_up_to(source, vtu_head_bytes);
      return is_vtu(head) ? is_decomposition_vtu(source, head) : is_legacy(source);
    });
}
}
