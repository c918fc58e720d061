// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/atom_styles.h"

#include "granular/common/words.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;

constexpr std::string_view omega = "omegax omegay omegaz";
constexpr std::string_view angmom = "angmomx angmomy angmomz";

/// From the documentation of LAMMPS (read_data) and the sources of LIGGGHTS.
constexpr AtomStyle styles[] = {
  // clang-format off
  { "atomic",       "id type x y z",                        {},     false, false },
  { "charge",       "id type q x y z",                      {},     false, false },
  { "bond",         "id mol type x y z",                    {},     true,  false },
  { "angle",        "id mol type x y z",                    {},     true,  false },
  { "molecular",    "id mol type x y z",                    {},     true,  false },
  { "full",         "id mol type q x y z",                  {},     true,  false },
  { "sphere",       "id type diameter density x y z",       omega,  false, false },
  { "granular",     "id type diameter density x y z",       omega,  false, false },
  { "bpm/sphere",   "id mol type diameter density x y z",   omega,  true,  false },
  { "ellipsoid",    "id type ellipsoidflag density x y z",  angmom, false, false },
  { "line",         "id mol type lineflag density x y z",   omega },
  { "tri",          "id mol type triangleflag density x y z", angmom },
  { "body",         "id type bodyflag mass x y z",          angmom },
  { "amoeba",       "id mol type q x y z",                  {},     true },
  { "dielectric",   "id mol type q x y z mux muy muz area ed em epsilon curvature", {}, true },
  { "dipole",       "id type q x y z mux muy muz" },
  { "dpd",          "id type theta x y z" },
  { "edpd",         "id type edpd_temp edpd_cv x y z" },
  { "electron",     "id type q spin eradius x y z",         "ervel" },
  { "mdpd",         "id type rho x y z" },
  { "peri",         "id type volume density x y z" },
  { "rheo",         "id type status rho x y z" },
  { "rheo/thermal", "id type status rho esph x y z" },
  { "smd",          "id type mol volume mass kradius cradius x0 y0 z0 x y z" },
  { "sph",          "id type rho esph cv x y z" },
  { "spin",         "id type x y z spx spy spz sp" },
  { "template",     "id type mol template_index template_atom x y z" },
  { "wavepacket",   "id type q spin eradius etag cs_re cs_im x y z", "ervel" },
  // clang-format on
};

/// Accelerated styles, such as sphere/omp, have the columns of the plain one.
constexpr std::string_view suffixes[] = { "/kk/host", "/kk/device", "/kk", "/omp", "/gpu", "/intel",
  "/opt" };

/// Returns a name without the suffix of an accelerated style.
std::string_view plain_name(std::string_view name)
{
  for (const std::string_view suffix : suffixes)
  {
    name.remove_suffix(name.ends_with(suffix) ? suffix.size() : 0);
  }
  return name;
}

void add_columns(Style& to, const AtomStyle& style)
{
  for (const auto& [from, into] :
    { std::pair{ style.columns, &to.columns }, std::pair{ style.velocities, &to.velocities } })
  {
    for (const std::string_view word : split_words(from))
    {
      if (std::ranges::find(*into, word) == into->end()) // each value stands once in a row
      {
        into->push_back(word);
      }
    }
  }
  to.name += (to.name.empty() ? "" : " ") + std::string(style.name);
  to.has_bonds = to.has_bonds || style.has_bonds;
}
}

std::span<const AtomStyle> atom_styles() noexcept
{
  return styles;
}

Words Style::columns_of(std::size_t words) const
{
  Words all = columns;
  if (words == all.size() + 3)
  {
    append_words("ix iy iz", all);
  }
  return all.size() == words ? all : Words();
}

Style style_of(const AtomStyle& style)
{
  Style made{ "", {}, split_words("id vx vy vz") };
  add_columns(made, style);
  return made;
}

Style hybrid_of(std::span<const AtomStyle* const> parts)
{
  Style made{ "hybrid", split_words("id type x y z"), split_words("id vx vy vz") };
  for (const AtomStyle* const part : parts)
  {
    add_columns(made, *part);
  }
  return made;
}

std::optional<Style> named_style(
  std::string_view text, bool any_behind, const DataLayout& layout, const Where& where)
{
  Words words = split_words(text);
  const bool hybrid = !words.empty() && plain_name(words.front()) == "hybrid";
  words.erase(words.begin(), words.begin() + (hybrid ? 1 : 0));
  words.resize(hybrid || !any_behind ? words.size() : std::min<std::size_t>(words.size(), 1));
  std::vector<const AtomStyle*> parts;
  for (const std::string_view word : words)
  {
    const auto* const part = std::ranges::find(styles, plain_name(word), &AtomStyle::name);
    const bool is_known = part != std::end(styles);
    if (!is_known && hybrid && any_behind && parts.empty())
    {
      return {};
    }
    if (!is_known || (!hybrid && !parts.empty()))
    {
      throw FormatError("expected an atom style of " + join_words(styles, " ", &AtomStyle::name) +
          " or hybrid, got " + quoted(join_words(words)) + style_advice(layout),
        where);
    }
    parts.push_back(part);
  }
  return parts.empty() ? std::nullopt
                       : std::optional(hybrid ? hybrid_of(parts) : style_of(*parts.front()));
}
}
