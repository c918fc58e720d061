// SPDX-License-Identifier: BSD-3-Clause
// A file of subdomains from memory, all the way: index, then every frame. Whatever the bytes are, there is an Error, or as many
// subdomains as the index says; and a file that grew is indexed as one that was always as long, but for what is said of it.
#ifndef granular_tests_fuzz_decomposition_checks_h
#define granular_tests_fuzz_decomposition_checks_h

#include "dump_checks.h"

#include "granular/formats/decomposition/decomposition_file.h"
#include "granular/formats/decomposition/voxels.h"
#include "granular/frames/file_index.h"
#include "granular/grid/subdomains.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace granular::fuzz
{
inline void index_subdomains(std::string_view text, FileIndex& index)
{
  const auto source = open_memory(text);
  Progress progress;
  decomposition_format().index(*source, index, progress, {});
  const auto size = static_cast<std::int64_t>(text.size());
  std::int64_t last = 0;
  for (const FrameEntry& frame : index.frames)
  {
    require(frame.offset >= last && frame.offset < frame.end && frame.end <= size,
      "the places of a frame");
    require(frame.rows >= 0, "the cells of a frame");
    last = frame.end;
  }
  require(index.resume_offset >= last && index.resume_offset <= size, "where to go on");
}

/// Bounds may be any: nobody stumbles over them.
inline void use_subdomains(const Decomposition& all)
{
  if (all.subdomains.size() > 1000)
  {
    return; // time
  }
  Progress progress;
  Notices notices;
  const std::int64_t most = 8 * static_cast<std::int64_t>(all.subdomains.size());
  require(
    make_voxels(all.subdomains, {}, Executor(1), progress).number_of_points == most, "points");
  const Subdomain bounds = bounds_of(all.subdomains);
  require(
    bounds.lo[0] <= bounds.hi[0] && bounds.lo[1] <= bounds.hi[1] && bounds.lo[2] <= bounds.hi[2],
    "bounds of all");
  const SubdomainChecks checks = { Answer::Notice, Answer::Notice };
  check_subdomains(all.subdomains, checks, { .line = 1 }, notices, progress);
}

inline void read_subdomains(const ByteSource& source, const FrameEntry& entry)
{
  Notices notices;
  Progress progress;
  try
  {
    const Decomposition all = read_decomposition(source, entry, notices, progress);
    require(static_cast<std::int64_t>(all.subdomains.size()) == entry.rows, "cells");
    require(notices.size() <= 1, "more than one notice a frame");
    for (std::size_t i = 0; i < all.subdomains.size(); ++i)
    {
      const Subdomain& box = all.subdomains[i];
      require(box.particles >= 0 && (all.has_particles || box.particles == 0), "particles");
      require(box.rank >= 0 && (all.has_ranks || box.rank == static_cast<int>(i)), "rank");
    }
    use_subdomains(all);
  }
  catch (const Error& error)
  {
    require(error.where().line > 0 || error.where().byte >= 0, "an error without a place");
  }
}

inline void check_subdomain_file(std::string_view text)
{
  FileIndex all;
  index_subdomains(text, all);
  FileIndex grown; // as if the file had been half as long before
  index_subdomains(text.substr(0, text.size() / 2), grown);
  index_subdomains(text, grown);
  require(all.frames.size() == grown.frames.size(), "frames of a file that grew");
  const auto source = open_memory(text);
  constexpr std::size_t most_frames = 8;
  constexpr std::int64_t most_cells = 100'000; // three lists of a hundred numbers may say a million
  for (std::size_t i = 0; i < std::min(all.frames.size(), most_frames); ++i)
  {
    require(all.frames[i].offset == grown.frames[i].offset, "frames of a file that grew");
    if (all.frames[i].rows <= most_cells)
    {
      read_subdomains(*source, all.frames[i]);
    }
  }
}
}

#endif
