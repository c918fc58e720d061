// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/record_plan.h"

#include "granular/common/words.h"
#include "granular/formats/restart/record_scan.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
using Kind = RecordColumn::Kind;

const RecordColumn common_columns[] = { { "id", Kind::Id, 0, 0 }, { "type", Kind::Type, 0, 0 },
  { "mask", Kind::Mask, 0, 0 }, { "x", Kind::Double, 0, RecordSlots::x },
  { "y", Kind::Double, 0, RecordSlots::x + 1 }, { "z", Kind::Double, 0, RecordSlots::x + 2 },
  { "ix", Kind::Image, 0, 0 }, { "iy", Kind::Image, 0, 1 }, { "iz", Kind::Image, 0, 2 },
  { "vx", Kind::Double, 0, RecordSlots::v }, { "vy", Kind::Double, 0, RecordSlots::v + 1 },
  { "vz", Kind::Double, 0, RecordSlots::v + 2 } };

constexpr auto take_none = [](std::size_t, std::size_t, std::size_t) {};

/// Whose the parts of a record are, by their lengths: in the order of the fixes, or if they do not fit, in the only other one that
/// gives columns to the fixes that have some. Empty: there is none, or more than one.
std::vector<std::size_t> order_fixes(const std::vector<RestartFix>& fixes,
  const std::vector<std::size_t>& fix_lengths, const std::vector<std::size_t>& parts)
{
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  const auto fits = [&](std::size_t part)
  {
    const std::size_t wanted = fix_lengths[order[part]]; // of a fix that has columns
    return wanted > 0 ? parts[part] == wanted
                      : static_cast<std::int64_t>(parts[part]) <= fixes[order[part]].most;
  };
  if (std::ranges::all_of(order, fits))
  {
    return order;
  }
  // parts that are as long could be swapped: of each length that has columns there must be one, and all others fit
  // if the longest goes to the fix that may have most
  order.assign(parts.size(), parts.size());
  std::vector<std::size_t> other_fixes;
  std::vector<std::size_t> other_parts;
  for (std::size_t fix = 0; fix < fixes.size(); ++fix)
  {
    const auto place = std::ranges::find(parts, fix_lengths[fix]) - parts.begin();
    if (fix_lengths[fix] == 0)
    {
      other_fixes.push_back(fix);
    }
    else if (std::ranges::count(parts, fix_lengths[fix]) != 1 ||
      std::exchange(order[static_cast<std::size_t>(place)], fix) < parts.size())
    {
      return {};
    }
  }
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    if (order[part] == parts.size())
    {
      other_parts.push_back(part);
    }
  }
  std::ranges::sort(other_parts, std::greater(), [&](std::size_t part) { return parts[part]; });
  std::ranges::sort(other_fixes, std::greater(), [&](std::size_t fix) { return fixes[fix].most; });
  for (std::size_t i = 0; i < other_parts.size(); ++i)
  {
    order[other_parts[i]] = other_fixes[i];
    if (!fits(other_parts[i]))
    {
      return {};
    }
  }
  return order;
}
}

RecordPlan::RecordPlan(
  const ByteSource& source, const RestartLayout& layout, Notices& notices, Progress& progress)
  : has_fixes_(layout.has_fixes)
  , image_bits_(layout.header.image_bits())
{
  const Where where{ source.path() };
  this->name_styles(layout, where, notices);
  known_fixes_ = has_fixes_ ? layout.fixes.size() : 0;
  RecordBuffer buffer;
  bool first = true;
  for (const RecordBlock& block : layout.blocks)
  {
    if (!first && !this->needs_history())
    {
      break;
    }
    progress.step(static_cast<double>(block.first_row) / static_cast<double>(layout.records));
    const RecordBatch batch = read_records(source, layout, block, buffer);
    for (std::size_t i = 0; i < batch.size() && (first || this->needs_history()); ++i)
    {
      try
      {
        const auto record = batch.record(i);
        if (first)
        {
          this->look_at(record, where, notices);
        }
        this->look_at_history(record);
        this->look_at_end(record, where, notices);
        if (first)
        {
          this->find_fixes(layout, record, where, notices);
        }
        first = false;
      }
      catch (const FormatError& error)
      {
        refuse_record(batch, i, error.text());
      }
    }
  }
  if (layout.records == 0)
  {
    this->find_fixes(layout, {}, where, notices);
  }
  history_values_ = std::max<std::int64_t>(history_values_, 0);
  this->add_columns(layout);
}

void RecordPlan::name_styles(const RestartLayout& layout, const Where& where, Notices& notices)
{
  for (const RestartStyle& style : layout.header.styles)
  {
    const std::int64_t most_bonds =
      style.bonds_per_atom > 0 ? style.bonds_per_atom : std::numeric_limits<std::int32_t>::max();
    parts_.push_back({ find_style(style.name), style.name, false, most_bonds });
    if (!parts_.back().style)
    {
      this->give_up(parts_.size() - 1, "nobody has told", where, notices);
    }
  }
  const auto find_bonds = [&](bool StyleLayout::*what)
  {
    const auto found = std::ranges::find_if(
      parts_, [&](const Part& part) { return part.style && part.style->*what; });
    return static_cast<std::size_t>(found - parts_.begin());
  };
  bonds_ = find_bonds(&StyleLayout::history);
  bonds_ = bonds_ < parts_.size() ? bonds_ : find_bonds(&StyleLayout::bonds);
}

/// Reads of a style no more than what all have.
void RecordPlan::give_up(
  std::size_t part, const std::string& why, const Where& where, Notices& notices)
{
  parts_[part].style = nullptr;
  history_values_ = bonds_ == part ? 0 : history_values_;
  bonds_ = bonds_ == part ? parts_.size() : bonds_;
  notices.push_back({ where,
    "what particles of atom style '" + parts_[part].name + "' have in restart files " + why +
      ": only what all styles have is read of it" });
}

/// Looks whether the parts of the first record are as long as the table says.
void RecordPlan::look_at(std::span<const double> record, const Where& where, Notices& notices)
{
  if (parts_.size() == 1)
  {
    return;
  }
  Part& front = parts_.front();
  const bool fixed = front.style && !front.style->has_lists();
  whole_numbers_of(record);
  std::size_t at = 0;
  if (fixed && begins_part(record, front.style->values))
  {
    at = front.style->values;
  }
  else if (fixed && find_next(record) == 0)
  {
    at = std::min(front.style->values, record.size());
    this->length_of_part(record, at, 1); // says what is wrong
  }
  else if (fixed || !front.style)
  {
    at = search_next(record);
    front.searched = true;
    if (front.style)
    {
      this->give_up(0, "is not known of this program", where, notices);
    }
  }
  else
  {
    this->look_at_history(record);
    BondBlock bonds;
    at = this->end_of_first(record, bonds);
  }
  for (std::size_t part = 1; part < parts_.size(); ++part)
  {
    const std::size_t length = this->length_of_part(record, at, part);
    const StyleLayout* const style = parts_[part].style;
    if (style && !style->has_lists() && style->values != length)
    {
      this->give_up(part, "is not known of this program", where, notices);
    }
    at += length;
  }
}

/// Checks the end of a style alone: what is behind its part must be of the fixes that the file names, or nobody knows where its values are.
void RecordPlan::look_at_end(std::span<const double> record, const Where& where, Notices& notices)
{
  if (end_known_ || parts_.size() > 1 || !has_fixes_ || !parts_.front().style ||
    this->needs_history())
  {
    return;
  }
  end_known_ = true;
  BondBlock bonds;
  if (!this->fits(record, this->end_of_first(record, bonds)))
  {
    this->give_up(0, "is not known of this program", where, notices);
    fix_lengths_.clear();
  }
}

/// Returns true if what is behind a place of a record is what it should be: the parts of other styles, or of fixes.
bool RecordPlan::fits(std::span<const double> record, std::size_t end) const
{
  if (parts_.size() > 1)
  {
    return begins_part(record, end);
  }
  return has_fixes_ ? walk_fixes(record, end, known_fixes_, take_none) : end == record.size();
}

/// Returns true if bonds may have history, of which is not known how much.
bool RecordPlan::needs_history() const noexcept
{
  return this->has_bonds() && parts_[bonds_].style->history && history_values_ < 0;
}

/// Finds out how many history values the bonds of a record have.
void RecordPlan::look_at_history(std::span<const double> record)
{
  if (!this->needs_history())
  {
    return;
  }
  std::size_t at = 0;
  for (std::size_t part = 0; part < bonds_; ++part)
  {
    BondBlock bonds;
    at += part == 0 ? this->end_of_first(record, bonds) : this->length_of_part(record, at, part);
  }
  const std::int64_t most = parts_[bonds_].most_bonds;
  if (bonds_ > 0)
  {
    const std::size_t length = this->length_of_part(record, at, bonds_);
    const BondBlock block = look_at_bonds(record.subspan(at, length), false, -1, most);
    history_values_ =
      block.bonds > 0 || block.history_values > 0 ? block.history_values : history_values_;
  }
  else
  {
    const std::int64_t b = look_at_bonds(record, true, 0, most).bonds;
    const std::size_t none = RecordSlots::first_bond + 2 * static_cast<std::size_t>(b);
    const std::size_t values = none < record.size() ? length_of(record[none], 1, most_history) : 0;
    const std::size_t end = none + 1 + values * static_cast<std::size_t>(b);
    const bool may = values > 0 && end <= record.size();
    const bool has = may && (this->fits(record, end) || (b > 0 && !this->fits(record, none)));
    if (b > 0 || (has && !this->fits(record, none)))
    {
      history_values_ = has ? static_cast<std::int64_t>(values) : 0;
    }
  }
  if (history_values_ > most_history)
  {
    throw FormatError("expected at most " + std::to_string(most_history) +
      " history values of a bond, got " + std::to_string(history_values_));
  }
}

void RecordPlan::add_columns(const RestartLayout& layout)
{
  columns_.assign(std::begin(common_columns), std::end(common_columns));
  const auto add = [&](RecordColumn column)
  {
    if (std::ranges::find(columns_, column.name, &RecordColumn::name) == columns_.end())
    {
      columns_.push_back(std::move(column));
    }
  };
  for (std::size_t part = 0; part < parts_.size(); ++part)
  {
    std::size_t slot = RecordSlots::common;
    for (const std::string_view name :
      split_words(parts_[part].style ? parts_[part].style->columns : std::string_view()))
    {
      add({ std::string(name), name == "mol" ? Kind::Whole : Kind::Double, part, slot++ });
    }
  }
  for (std::size_t fix = 0; fix < fix_lengths_.size(); ++fix)
  {
    const std::string name = "f_" + layout.fixes[fix].id;
    const std::size_t values = fix_lengths_[fix] == 0 ? 0 : fix_lengths_[fix] - 1;
    for (std::size_t i = 1; i <= values; ++i)
    {
      add({ values == 1 ? name : name + "[" + std::to_string(i) + "]", Kind::OfAFix, fix, i });
    }
  }
}

const RecordColumn* RecordPlan::molecule() const noexcept
{
  const auto found = std::ranges::find(columns_, Kind::Whole, &RecordColumn::kind);
  return found == columns_.end() ? nullptr : &*found;
}

/// Finds which fixes have columns: those of values that users give to particles (property/atom), which have as many of
/// all. What is behind the styles in the record must be of the fixes that the file names.
void RecordPlan::find_fixes(
  const RestartLayout& layout, std::span<const double> record, const Where& where, Notices& notices)
{
  if (known_fixes_ == 0 || (parts_.size() == 1 && !parts_.front().style))
  {
    return;
  }
  fix_lengths_.assign(known_fixes_, 0);
  for (std::size_t fix = 0; fix < known_fixes_; ++fix)
  {
    const RestartFix& of = layout.fixes[fix];
    const bool has = of.style.starts_with("property/atom") && of.most > 1 && of.most <= most_values;
    fix_lengths_[fix] = has ? static_cast<std::size_t>(of.most) : 0;
  }
  if (record.empty())
  {
    return;
  }
  std::vector<const double*> parts(parts_.size());
  BondBlock bonds;
  const std::size_t end = this->find_styles(record, parts, bonds);
  std::vector<std::size_t> lengths;
  const bool found = walk_fixes(record, end, known_fixes_,
    [&](std::size_t, std::size_t, std::size_t length) { lengths.push_back(length); });
  const auto has_columns = [](std::size_t length) { return length > 0; };
  const bool wanted = std::ranges::any_of(fix_lengths_, has_columns);
  if (found && wanted)
  {
    fix_order_ = order_fixes(layout.fixes, fix_lengths_, lengths);
  }
  if (!found || (wanted && fix_order_.empty()))
  {
    fix_lengths_.clear();
    notices.push_back(
      { where, "what fixes have of particles is not where it should be, and is left out" });
  }
  if (!wanted)
  {
    fix_lengths_.clear();
  }
}
}
