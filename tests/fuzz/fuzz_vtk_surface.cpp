// SPDX-License-Identifier: BSD-3-Clause
// Points and cells of a legacy VTK file from memory. Whatever the bytes are, there is an Error with a place, or as many values as the file
// says; and what is only looked at is told as what is read.
#include "dump_checks.h"

#include "granular/formats/vtk_files/vtk_surface.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

using namespace granular;

namespace
{
std::optional<VtkSurface> read(std::string_view text, SurfaceRead what)
{
  const auto source = open_memory(text);
  Progress progress;
  try
  {
    LegacyVtk file(*source, {}, LegacyVtk::no_end, progress);
    return read_surface(file, what);
  }
  catch (const Error& error)
  {
    require(error.where().line > 0 || error.where().byte >= 0, "an error without a place");
    return {};
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto all = read(text, SurfaceRead::All);
  const auto looked = read(text, SurfaceRead::None);
  if (!all)
  {
    return 0;
  }
  require(looked && looked->cells == all->cells, "points of what is looked at");
  require(looked->arrays.size() == all->arrays.size(), "arrays of what is looked at");
  const auto points = static_cast<std::size_t>(all->cells);
  require(all->points.size() == 3 * points, "points");
  for (const VtkCells& part : all->parts)
  {
    require(
      part.size == 0 || part.offsets.size() == static_cast<std::size_t>(part.size) + 1, "cells");
    for (const std::int64_t point : part.connectivity)
    {
      require(point >= 0 && point < all->cells, "a point of a cell");
    }
  }
  for (const SurfaceArray& array : all->arrays)
  {
    const auto tuples = array.of_cells ? all->part_cells() : all->cells;
    require(array.what.tuples == tuples, "the tuples of an array");
    require(static_cast<std::int64_t>(array.numbers.size() + array.integers.size()) ==
        tuples * array.what.components,
      "the values of an array");
  }
  return 0;
}
