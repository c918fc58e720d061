// SPDX-License-Identifier: BSD-3-Clause
// A file of dump euler/vtk from memory, all the way: index, then the frame, then the grids that its cells form. Whatever
// the bytes are, there is an Error, or as many values as the index says; and a file that grew is indexed as one that
// was always as long.
#include "dump_checks.h"

#include "granular/formats/euler/euler_file.h"
#include "granular/formats/euler/regular_grids.h"
#include "granular/frames/file_index.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

using namespace granular;

namespace
{
void index(std::string_view text, FileIndex& index)
{
  const auto source = open_memory(text);
  Progress progress;
  euler_format().index(*source, index, progress, {});
  const auto size = static_cast<std::int64_t>(text.size());
  require(index.frames.size() <= 1, "more than one frame");
  for (const FrameEntry& frame : index.frames)
  {
    require(
      frame.offset >= 0 && frame.offset < frame.end && frame.end <= size, "the place of a frame");
    require(frame.rows >= 0, "the cells of a frame");
  }
  require(index.resume_offset >= 0 && index.resume_offset <= size, "where to go on");
}

/// Cells may be anywhere: nobody stumbles over them.
void use(const EulerFrame& frame)
{
  Notices notices;
  try
  {
    std::int64_t cells = 0;
    for (const RegularGrid& grid : find_regular_grids(frame, notices))
    {
      require(grid.first == cells, "the first cell of a grid");
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        require(grid.grid.counts[axis] > 0, "the cells of a grid");
        require(grid.grid.lo[axis] < grid.grid.hi[axis], "the bounds of a grid");
      }
      cells += grid.grid.counts[0] * grid.grid.counts[1] * grid.grid.counts[2];
    }
    require(cells == frame.cells, "the cells of all grids");
  }
  catch (const UnsupportedError&)
  {
    require(notices.empty(), "notices of what is no grid");
  }
}

void read(const ByteSource& source, const FrameEntry& entry)
{
  Notices notices;
  Progress progress;
  EulerFrame frame;
  try
  {
    frame = read_euler(
      source, entry, [](std::string_view) { return true; }, notices, progress);
  }
  catch (const Error& error)
  {
    require(error.where().line > 0 || error.where().byte >= 0, "an error without a place");
    return;
  }
  const auto cells = static_cast<std::size_t>(frame.cells);
  require(frame.cells == entry.rows, "cells");
  require(frame.centres.size() == 3 * cells, "centres");
  const std::vector<std::string> names = euler_array_names(source, entry, progress);
  require(names.size() == frame.arrays.size(), "names of arrays");
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const EulerValues& array = frame.arrays[i];
    require(array.name == names[i], "the name of an array");
    require(array.components > 0, "components");
    require(array.values.size() == static_cast<std::size_t>(array.components) * cells, "values");
  }
  use(frame);
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  FileIndex all;
  index(text, all);
  FileIndex grown; // as if the file had been half as long before
  index(text.substr(0, size / 2), grown);
  index(text, grown);
  require(all.frames.size() == grown.frames.size(), "frames of a file that grew");
  if (!all.frames.empty())
  {
    read(*open_memory(text), all.frames[0]);
  }
  return 0;
}
