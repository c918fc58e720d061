// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/restart_styles.h"

#include "granular/numbers/number_print.h"

#include <algorithm>
#include <string>

namespace granular
{
namespace
{
// Source: pack_restart of the atom styles of LIGGGHTS-PUBLIC 3.8.0 and its forks; files of 3.8.0.
// Behind the last list of ellipsoid, line and tri, which has one entry at most, comes their shape.
constexpr StyleLayout table[] = {
  // clang-format off
  // name                     columns                                               values lists           bonds  history
  { "atomic",                 "",                                                       11 },
  { "charge",                 "q",                                                      12 },
  { "granular",               "radius mass density omegax omegay omegaz",               17 },
  { "sphere",                 "radius mass density omegax omegay omegaz",               17 },
  { "bond/gran",              "mol",                                                    12, { 2 },          true,  true },
  { "bond",                   "mol",                                                    12, { 2 },          true },
  { "molecular",              "mol",                                                    12, { 2, 4, 5, 5 }, true },
  { "full",                   "q mol",                                                  13, { 2, 4, 5, 5 }, true },
  { "ellipsoid",              "mass angmomx angmomy angmomz",                           15, { 7 } },
  { "line",                   "mol mass omegax omegay omegaz",                          16, { 2 } },
  { "tri",                    "mol mass angmomx angmomy angmomz",                       16, { 16 } },
  { "sph",                    "p rho e vestx vesty vestz",                              17 },
  { "sph/var",                "p rho e radius mass",                                    16 },
  { "superquadric",           "radius mass density omegax omegay omegaz quat1 quat2 quat3 quat4 shapex shapey shapez "
                              "blockiness1 blockiness2 inertiax inertiay inertiaz volume area angmomx angmomy angmomz", 34 },
  { "granular_superquadric",  "radius mass density omegax omegay omegaz quat1 quat2 quat3 quat4 shapex shapey shapez "
                              "blockiness1 blockiness2 inertiax inertiay inertiaz volume area angmomx angmomy angmomz", 34 },
  // clang-format on
};
}

const StyleLayout* find_style(std::string_view name) noexcept
{
  const auto* const found = std::ranges::find(table, name, &StyleLayout::name);
  return found == std::end(table) ? nullptr : found;
}

std::size_t measure_lists(std::span<const double> block, const StyleLayout& style)
{
  const auto lists =
    std::ranges::count_if(style.lists, [](std::uint8_t width) { return width > 0; });
  const std::size_t least = style.values + static_cast<std::size_t>(lists);
  if (block.size() < least)
  {
    throw FormatError("expected at least " + std::to_string(least) +
      " doubles in the part of style " + std::string(style.name) + ", got " +
      std::to_string(block.size()));
  }
  std::size_t at = style.values;
  if (!style.has_lists())
  {
    return at;
  }
  const WholeNumbers form = whole_numbers_of(block);
  for (const std::size_t width : style.lists)
  {
    if (width == 0)
    {
      break;
    }
    if (at >= block.size())
    {
      throw FormatError("expected more lists in the part of style " + std::string(style.name) +
        ", got its end at double " + std::to_string(at));
    }
    const std::int64_t entries = to_whole(block[at], form);
    const std::size_t room = (block.size() - at - 1) / width;
    if (entries < 0 || static_cast<std::uint64_t>(entries) > room)
    {
      throw FormatError("expected from 0 to " + std::to_string(room) + " entries in double " +
        std::to_string(at) + " of the part of style " + std::string(style.name) + ", got " +
        std::to_string(entries));
    }
    at += 1 + static_cast<std::size_t>(entries) * width;
  }
  return at;
}
}
