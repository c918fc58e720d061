// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/vtk_surface.h"

#include <algorithm>

namespace granular
{
namespace
{
class SurfaceReader : public VtkGridReader
{
public:
  SurfaceReader(LegacyVtk& file, VtkSurface& surface, SurfaceRead what)
    : VtkGridReader(file, surface, what != SurfaceRead::None, what == SurfaceRead::All, true)
    , surface_(surface)
  {
  }

private:
  bool take(const VtkArray& what) override
  {
    if (!is_data_ && !of_cells_) // of the whole
    {
      return false;
    }
    if (!is_number(what.type) || what.type == ValueType::UInt8) // colours may be fractions
    {
      surface_.has_others = true;
      return false;
    }
    constexpr std::int64_t most_components = 1000;
    const std::int64_t size = of_cells_ ? surface_.part_cells() : surface_.cells;
    if (what.tuples != size || what.components < 1 || what.components > most_components)
    {
      file_.fail("values of '" + what.name + "', any number x " + std::to_string(size),
        std::to_string(what.components) + " x " + std::to_string(what.tuples));
    }
    SurfaceArray& array = surface_.arrays.emplace_back(SurfaceArray{ what, of_cells_, {}, {} });
    const bool keep = of_cells_ ? check_ : keep_;
    is_integer(what.type) ? file_.take(what, keep, array.integers)
                          : file_.take(what, keep, array.numbers);
    return true;
  }

  VtkSurface& surface_;
};
}

bool VtkSurface::has(std::string_view name) const noexcept
{
  return std::ranges::any_of(arrays,
    [name](const SurfaceArray& array) { return !array.of_cells && array.what.name == name; });
}

std::int64_t VtkSurface::part_cells() const noexcept
{
  std::int64_t count = 0;
  for (const VtkCells& each : parts)
  {
    count += std::min(each.size, LegacyVtk::no_end / 4); // a claim
  }
  return count;
}

VtkSurface read_surface(LegacyVtk& file, SurfaceRead what)
{
  constexpr std::string_view kinds[] = { vtk_points };
  VtkSurface surface;
  SurfaceReader(file, surface, what).read(kinds, "points and cells");
  const auto is_late = [&](const SurfaceArray& array)
  { return array.what.tuples != (array.of_cells ? surface.part_cells() : surface.cells); };
  if (std::ranges::any_of(surface.arrays, is_late))
  {
    throw FormatError(
      "expected points and cells before their data", file.where(surface.header.place));
  }
  return surface;
}
}
