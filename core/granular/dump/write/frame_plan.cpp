// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/frame_plan.h"

#include "granular/common/words.h"
#include "granular/dump/write/grain_bounds.h"
#include "granular/dump/write/row_batches.h"
#include "granular/dump/write/table_columns.h"
#include "granular/frames/header_archive.h"
#include "granular/parallel/gather.h"
#include "granular/particles/rounding_loss.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace granular
{
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<ColumnSource>& column)
{
  archive.text(column.name);
  archive.number(column.kind);
  archive.number(column.role);
  archive.number(column.axis);
  archive.number(column.whole);
  archive.number(column.numbers);
  archive.number(column.values.type);
  archive.number(column.values.factor);
  archive.number(column.own);
}

namespace
{
using Kind = ColumnSource::Kind;
using namespace std::string_literals;

/// Facts that each rank tells the others first.
struct Survey
{
  std::int64_t kept = 0;
  std::int64_t arrays = 0; ///< a rank without rows and arrays knows nothing
  bool has_box = false;
  GrainBounds bounds = {};  ///< where there is no box
  double radius = HUGE_VAL; ///< the smallest, where numbers may lose digits
};

/// Facts that the leading rank tells the others: the header, and the columns without their values.
struct Lead
{
  FrameHeader header;
  ColumnPlan columns;
  Notices notices;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<Lead>& lead)
{
  const auto there_or_not = [](auto&) {};
  pass(archive, lead.header);
  pass(archive, lead.columns.columns);
  for (auto& image : lead.columns.images)
  {
    archive.perhaps(image, there_or_not);
  }
  archive.perhaps(lead.columns.ids, there_or_not);
  archive.number(lead.columns.binary);
  archive.number(lead.columns.wraps);
  pass(archive, lead.notices);
}

bool is_table(const DumpFormat& format) noexcept
{
  return format.style == DumpStyle::Local;
}

/// The word for rows: the one that is asked for, that of the file that a table comes from, or ENTRIES.
std::string name_of_rows(const DumpFormat& format, const FrameHeader& header)
{
  if (!is_table(format))
  {
    return "ATOMS";
  }
  if (!format.counted.empty())
  {
    return format.counted;
  }
  return header.counted.empty() || header.counted == "ATOMS" ? "ENTRIES" : header.counted;
}

/// Returns true if particles may be elsewhere when they are read again.
bool may_lose_digits(const DumpFormat& format) noexcept
{
  return !is_table(format) && !format.binary && format.numbers != automatic_numbers;
}

/// Makes one for particles where there is none.
void choose_box(
  Lead& lead, const FrameView& frame, const DumpFormat& format, const std::vector<Survey>& surveys)
{
  if (std::any_of(surveys.begin(), surveys.end(),
        [&](const Survey& rank) { return rank.kept > 0 && rank.has_box != frame.has_box; }))
  {
    throw Error("expected a box on all ranks or on none, got one on some");
  }
  lead.header.has_box = frame.has_box || !is_table(format);
  if (frame.has_box || is_table(format))
  {
    return;
  }
  if (frame.rows > 0 && frame.coordinates != Coordinates::Absolute)
  {
    throw Error("expected a box for "s + to_string(frame.coordinates) + " points, got none");
  }
  GrainBounds all;
  std::for_each(surveys.begin(), surveys.end(), [&](const Survey& rank) { all.add(rank.bounds); });
  lead.header.box = all.box();
  lead.notices.push_back({ {}, "the input has no box: it is made from the bounds of the grains" });
}

std::vector<std::string> choose_names(
  const FrameView& frame, const DumpFormat& format, Notices& notices)
{
  const bool chosen = !format.columns.empty();
  if (is_table(format))
  {
    return chosen ? expand_table_columns(format.columns, frame)
                  : default_table_columns(frame, notices);
  }
  return format.style == DumpStyle::Atom ? atom_columns(format.atom)
    : chosen                             ? expand_columns(format.columns, frame)
                                         : default_columns(frame, notices, format.binary);
}

ColumnPlan plan_names(const std::vector<std::string>& names, const FrameView& frame,
  const DumpFormat& format, Notices& notices)
{
  return is_table(format) ? plan_table_columns(names, frame)
                          : plan_columns(names, frame, format.binary, notices);
}

/// Chooses the format of real numbers, column by column.
void choose_numbers(const FrameView& frame, NumberFormat numbers, ColumnPlan& plan)
{
  for (ColumnSource& column : plan.columns)
  {
    column.numbers = numbers;
  }
  if (numbers != automatic_numbers)
  {
    return;
  }
  constexpr int least = 6; // zeros at the end are not printed
  for (std::size_t i = 0; i < std::min(frame.columns.size(), frame.header.digits.size()); ++i)
  {
    const auto column = std::ranges::find(plan.columns, frame.columns[i], &ColumnSource::name);
    if (column != plan.columns.end())
    {
      column->numbers.digits = std::max(least, frame.header.digits[i]);
    }
  }
}

void check_names(const std::vector<std::string>& names)
{
  if (names.empty())
  {
    throw Error("expected at least one column, got none");
  }
  for (const std::string& name : names)
  {
    if (split_words(name).size() != 1 || split_words(name).front() != name)
    {
      throw Error("expected the name of a column as one word, got '" + name + "'");
    }
  }
}

bool is_scaled(const ColumnSource& column) noexcept
{
  return column.kind == Kind::Coordinate && is_scaled(column.role);
}

/// Checks a text that stands in a line of the header of its own: it must not look like another section of it.
void check_line(const std::string& text, const char* what)
{
  if (text.find_first_of("\n\r") != text.npos)
  {
    throw FormatError(std::string("expected ") + what + " in one line, got a line break in it");
  }
}

/// Checks that the frame has what the format asks for.
void check_frame(const Lead& lead, const DumpFormat& format, Notices& notices)
{
  const Box& box = lead.header.box;
  const auto& columns = lead.columns.columns;
  const bool scaled = std::any_of(columns.begin(), columns.end(), is_scaled);
  if (scaled || lead.columns.wraps)
  {
    check_volume(box);
  }
  check_line(lead.header.label, "the label");
  check_line(lead.header.units, "the units");
  check_bounds(box);
  const bool lammps = lead.header.dialect == Dialect::Lammps; // the other has neither
  if (lammps && format.units && lead.header.units.empty())
  {
    throw Error("expected the units of the frame for ITEM: UNITS, got none");
  }
  if (lammps && format.time && !lead.header.time)
  {
    throw Error("expected the time of the frame for ITEM: TIME, got none");
  }
  if (format.sort_by_id && !lead.columns.ids)
  {
    notices.push_back({ {}, "no integer array 'id': the rows are not sorted" });
  }
  if (box.boundary.empty() && lead.header.has_box)
  {
    notices.push_back(
      { {}, "the boundaries of the box are not known: they are written as ff ff ff" });
  }
}

[[noreturn]] void fail_others(const std::string& column)
{
  throw Error("expected an array of the same kind on all ranks, got others", { .column = column });
}

/// The columns of a rank without rows, or the check that those of a rank with rows are the same.
ColumnPlan join_plan(const Lead& lead, const FrameView& frame, const DumpFormat& format)
{
  if (frame.rows == 0)
  {
    return lead.columns;
  }
  Notices told; // by the rank that leads
  const std::vector<std::string> names = lead.columns.names();
  ColumnPlan plan = plan_names(names, frame, format, told);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const ColumnSource& own = plan.columns[i];
    const ColumnSource& other = lead.columns.columns[i];
    if (own.kind != other.kind || own.own != other.own ||
      is_integer(own.values.type) != is_integer(other.values.type) ||
      (own.values.type == ValueType::Text) != (other.values.type == ValueType::Text))
    {
      fail_others(names[i]);
    }
    plan.columns[i].numbers = other.numbers;
  }
  if (plan.ids.has_value() != lead.columns.ids.has_value())
  {
    fail_others("id");
  }
  for (std::size_t axis = 0; axis < plan.images.size(); ++axis)
  {
    if (plan.images[axis].has_value() != lead.columns.images[axis].has_value())
    {
      fail_others(std::string("i") + "xyz"[axis]);
    }
  }
  return plan;
}
}

FramePlan plan_frame(
  const FrameView& frame, const DumpFormat& format, Communicator& ranks, Notices& notices)
{
  FramePlan plan;
  Survey survey;
  survey.kept = count_kept(frame, 0, frame.rows);
  survey.arrays = static_cast<std::int64_t>(frame.arrays.size());
  survey.has_box = frame.has_box;
  if (!frame.has_box && !is_table(format))
  {
    survey.bounds = bounds_of_grains(frame);
  }
  if (may_lose_digits(format))
  {
    survey.radius = smallest_radius(frame);
  }
  const std::vector<Survey> surveys = gather(ranks, survey);
  for (const Survey& rank : surveys)
  {
    plan.kept_rows.push_back(rank.kept);
    plan.smallest_radius = std::min(plan.smallest_radius, rank.radius);
  }
  const auto knows = [](const Survey& a, const Survey& b)
  { return std::pair(a.kept > 0, a.arrays > 0) < std::pair(b.kept > 0, b.arrays > 0); };
  const auto best = std::max_element(surveys.begin(), surveys.end(), knows);
  const auto leader = static_cast<int>(best - surveys.begin());

  Lead lead;
  std::string told;
  if (ranks.rank() == leader)
  {
    lead.header = frame.header;
    lead.header.dialect = choose_dialect(format, frame.header);
    choose_box(lead, frame, format, surveys);
    const std::vector<std::string> names = choose_names(frame, format, lead.notices);
    check_names(names);
    lead.columns = plan_names(names, frame, format, lead.notices);
    if (!format.binary)
    {
      choose_numbers(frame, format.numbers, lead.columns);
    }
    check_frame(lead, format, lead.notices);
    ArchiveWriter packer;
    pass(packer, lead);
    told = std::move(packer.bytes);
  }
  ranks.broadcast(told, leader);
  ArchiveReader unpacker(told);
  pass(unpacker, lead);
  plan.header = lead.header;
  plan.header.counted = name_of_rows(format, lead.header);
  plan.header.rows =
    std::accumulate(plan.kept_rows.begin(), plan.kept_rows.end(), std::int64_t{ 0 });
  plan.header.box.boundary =
    lead.header.box.boundary.empty() ? "ff ff ff" : parse_boundary(lead.header.box.boundary);
  plan.columns = join_plan(lead, frame, format);
  notices.insert(notices.end(), lead.notices.begin(), lead.notices.end());
  return plan;
}
}
