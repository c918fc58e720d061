// SPDX-License-Identifier: BSD-3-Clause
// Atom styles of files that do not name them.
#include "granular/formats/data_file/atom_styles.h"

#include "granular/common/words.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;
using Styles = std::vector<Style>;

constexpr double most = std::numeric_limits<double>::infinity();
constexpr double positive = std::numeric_limits<double>::min();

/// The values that a column may have. Columns of other names have any.
struct ColumnRule
{
  std::string_view name;
  double lowest;
  double highest;
  bool whole = true;
  std::int64_t DataLayout::*sum = nullptr; ///< of all values, as the header counts it
};

constexpr ColumnRule column_rules[] = {
  { "id", 0, most },
  { "mol", 0, most },
  { "type", 1, most },
  { "ellipsoidflag", 0, 1, true, &DataLayout::ellipsoids },
  { "lineflag", 0, 1, true, &DataLayout::lines },
  { "triangleflag", 0, 1, true, &DataLayout::triangles },
  { "bodyflag", 0, 1, true, &DataLayout::bodies },
  { "status", 0, most },
  { "template_index", 0, most },
  { "template_atom", 0, most },
  { "spin", -1, 3 },
  { "etag", 0, most },
  { "ix", -most, most },
  { "iy", -most, most },
  { "iz", -most, most },
  { "diameter", 0, most, false },
  { "density", positive, most, false },
  { "mass", positive, most, false },
  { "volume", positive, most, false },
  { "kradius", positive, most, false },
  { "cradius", positive, most, false },
  { "edpd_cv", positive, most, false },
};

using Parts = std::vector<const AtomStyle*>;

/// Looks for styles that fit the values of all rows, and the header.
class StyleGuess
{
public:
  explicit StyleGuess(const DataLayout& layout)
    : layout_(layout)
    , values_(layout.find("Atoms")->values)
    , rules_(std::begin(column_rules), std::end(column_rules))
  {
    this->add_axes();
    if (layout.atom_types > 0)
    {
      std::ranges::find(rules_, "type", &ColumnRule::name)->highest =
        static_cast<double>(layout.atom_types);
    }
  }

  /// Returns true if all rows may be those of a style, by their words and values and by the header.
  bool fits(const Style& style) const
  {
    const Words columns = style.columns_of(values_.size());
    const DataSection* const velocities = layout_.find("Velocities");
    bool all = !columns.empty() && (style.has_bonds || layout_.bonds + layout_.bond_types == 0) &&
      (!velocities || velocities->rows == 0 || velocities->words == style.velocities.size());
    for (const ColumnRule& rule : rules_)
    {
      const bool is_there = std::ranges::find(columns, rule.name) != columns.end();
      all = all && (is_there || !rule.sum || layout_.*rule.sum == 0);
    }
    for (std::size_t i = 0; all && i < columns.size(); ++i)
    {
      all = this->allows(columns[i], values_[i]);
    }
    return all;
  }

  /// Returns the styles that fit, of the common or of the rare ones.
  Styles styles(bool rare) const
  {
    Styles found;
    for (const AtomStyle& style : atom_styles())
    {
      if (rare == style.rare && this->fits(style_of(style)))
      {
        found.push_back(style_of(style));
      }
    }
    return found;
  }

  /// Returns hybrid with up to three sub-styles, in all orders that fit; rare ones only if need be, and then the fewest. Each list of
  /// columns stands once.
  Styles hybrids() const
  {
    Parts of;
    for (const AtomStyle& style : atom_styles())
    {
      if (std::ranges::find(of, style.columns, &AtomStyle::columns) == of.end())
      {
        of.push_back(&style);
      }
    }
    constexpr std::size_t most_parts = 3;
    Styles found;
    for (std::size_t rare = 0; rare <= most_parts && found.empty(); ++rare)
    {
      for (std::size_t parts = 0; parts <= most_parts && (rare == 0 || found.empty()); ++parts)
      {
        this->add_hybrids(of, {}, parts, rare, found);
      }
    }
    return found;
  }

private:
  /// A coordinate may be a few boxes away, as in files that periodic boundaries will wrap; no particle is larger than the box.
  void add_axes()
  {
    constexpr double boxes = 2;
    constexpr std::string_view names[] = { "x", "y", "z" };
    Vector3 lowest = values_of(layout_.box.origin);
    Vector3 highest = lowest;
    double longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const Twofold3& edge : layout_.box.vectors)
      {
        lowest[axis] += std::min(edge[axis].value(), 0.0);
        highest[axis] += std::max(edge[axis].value(), 0.0);
      }
      longest = std::max(longest, highest[axis] - lowest[axis]);
    }
    std::ranges::find(rules_, "diameter", &ColumnRule::name)->highest = longest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      rules_.push_back(
        { names[axis], lowest[axis] - boxes * longest, highest[axis] + boxes * longest, false });
    }
  }

  bool allows(std::string_view column, const ColumnValues& values) const
  {
    const auto rule = std::ranges::find(rules_, column, &ColumnRule::name);
    const bool is_number =
      !values.words || (column == "type" && layout_.find_labels("Atom Type Labels"));
    if (rule == rules_.end() || values.lowest > values.highest) // any, or none but labels
    {
      return is_number;
    }
    return is_number && values.lowest >= rule->lowest && values.highest <= rule->highest &&
      (values.whole || !rule->whole) &&
      (!rule->sum || values.sum == static_cast<double>(layout_.*rule->sum));
  }

  /// Adds hybrid with these sub-styles and so many more, of which so many may be rare.
  void add_hybrids(
    const Parts& of, const Parts& parts, std::size_t more, std::size_t rare, Styles& found) const
  {
    const Style style = hybrid_of(parts);
    if (more == 0 && this->fits(style) &&
      std::ranges::find(found, style.columns, &Style::columns) == found.end())
    {
      found.push_back(style);
    }
    for (std::size_t i = 0; more > 0 && i < of.size(); ++i)
    {
      Parts longer = parts;
      longer.push_back(of[i]);
      const std::size_t columns = hybrid_of(longer).columns.size();
      if (columns > style.columns.size() && columns <= values_.size() && (rare > 0 || !of[i]->rare))
      {
        this->add_hybrids(of, longer, more - 1, rare - (of[i]->rare ? 1 : 0), found);
      }
    }
  }

  const DataLayout& layout_;
  const std::vector<ColumnValues>& values_;
  std::vector<ColumnRule> rules_;
};

std::string names_of(const Styles& list, std::string_view between = " ")
{
  return join_words(list, between, &Style::name);
}
}

Style guess_style(const DataLayout& layout, bool hybrid, const Where& where, Notices& notices)
{
  const StyleGuess guess(layout);
  Styles found = hybrid ? guess.hybrids() : guess.styles(false);
  Styles others = hybrid ? Styles() : guess.styles(true);
  if (found.empty())
  {
    found.swap(others);
  }
  const auto differs = [&](const Style& style) { return style.columns != found.front().columns; };
  std::erase_if(others, [&](const Style& style) { return !differs(style); });
  const std::string_view between = hybrid ? ", " : " ";
  const std::size_t words = layout.find("Atoms")->words;
  if (found.empty() || std::ranges::any_of(found, differs))
  {
    throw FormatError(
      (hybrid ? "expected the sub-styles as in 'Atoms # hybrid sphere bond', got none, and rows of "
              : "expected the atom style as in 'Atoms # sphere', got none, and rows of ") +
        std::to_string(words) + " words; " +
        (found.empty()
            ? "none that is known fits all rows: set AtomStyle, or make a dump of the file"
            : "those of " + names_of(found, between) + " fit all rows: set AtomStyle"),
      where);
  }
  notices.push_back({ where,
    std::string(hybrid ? "the sub-styles of hybrid are" : "the atom style is") +
      " not in the file: the columns are taken for those of " + names_of(found, between) + ", " +
      join_words(found.front().columns_of(words)) +
      (others.empty() ? "" : ", though " + names_of(others) + " would fit, too") +
      "; if they are others, set AtomStyle" });
  return found.front();
}

std::string style_advice(const DataLayout& layout)
{
  const DataSection* const atoms = layout.find("Atoms");
  const Styles found =
    atoms && atoms->comment.empty() ? StyleGuess(layout).styles(false) : Styles();
  return found.empty() ? "" : "; those of " + names_of(found) + " fit all rows: set AtomStyle";
}
}
