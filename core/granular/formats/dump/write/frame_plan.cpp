// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/frame_plan.h"

#include "granular/common/shares.h"
#include "granular/common/words.h"
#include "granular/formats/dump/write/row_batches.h"
#include "granular/formats/dump/write/row_values.h"
#include "granular/frames/header_archive.h"
#include "granular/parallel/trade.h"
#include "granular/particles/rounding_loss.h"

#include <algorithm>
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
  Vector3 lo = { HUGE_VAL, HUGE_VAL, HUGE_VAL };    ///< of the particles, where there is no box
  Vector3 hi = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL }; ///< of the particles
  double radius = HUGE_VAL;                         ///< the smallest, where numbers may lose digits
};

/// The leading rank tells the others the header, and the columns without their values.
template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<FramePlan>& plan)
{
  const auto there_or_not = [](auto&) {};
  pass(archive, plan.header);
  pass(archive, plan.columns.columns);
  for (auto& image : plan.columns.images)
  {
    archive.perhaps(image, there_or_not);
  }
  archive.perhaps(plan.columns.ids, there_or_not);
  archive.number(plan.columns.binary);
  archive.number(plan.columns.wraps);
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

double radius_of(const RowValues::Column& column, std::size_t row) noexcept
{
  return column.type == ValueType::Int32 ? column.at<std::int32_t>(row)
    : column.type == ValueType::Int64    ? static_cast<double>(column.at<std::int64_t>(row))
                                         : column.at<double>(row);
}

/// Finds the bounds of the spheres, or of the points without radii; duplicates and points that are not finite are ignored.
void find_bounds(const FrameView& frame, Survey& survey)
{
  std::vector<std::string> names = { "x", "y", "z" };
  const std::optional<ValueSource> radii = find_values(frame, "radius");
  if (radii && radii->type != ValueType::Text)
  {
    names.emplace_back("radius");
  }
  Notices none;
  const ColumnPlan plan = plan_columns(names, frame, true, none);
  RowValues values;
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  for (std::int64_t first = 0; first < frame.rows; first += most)
  {
    values.load(frame, plan, {}, first, std::min(most, frame.rows - first), 0);
    for (std::size_t i = 0; i < 3 * values.rows(); ++i)
    {
      const std::size_t axis = i % 3;
      const double x = values.columns()[axis].at<double>(i / 3);
      const double r = names.size() > 3 ? radius_of(values.columns()[3], i / 3) : 0;
      if (std::isfinite(x - r) && std::isfinite(x + r))
      {
        survey.lo[axis] = std::min(survey.lo[axis], x - r);
        survey.hi[axis] = std::max(survey.hi[axis], x + r);
      }
    }
  }
}

/// Makes one for particles where there is none, with boundaries that nothing crosses; at 0 without particles.
void choose_box(FramePlan& plan, const FrameView& frame, const DumpFormat& format,
  const std::vector<Survey>& surveys, Notices& notices)
{
  if (std::ranges::any_of(surveys,
        [&](const Survey& rank) { return rank.kept > 0 && rank.has_box != frame.has_box; }))
  {
    throw Error("expected a box on all ranks or on none, got one on some");
  }
  plan.header.has_box = frame.has_box || !is_table(format);
  if (frame.has_box || is_table(format))
  {
    return;
  }
  if (frame.rows > 0 && frame.coordinates != Coordinates::Absolute)
  {
    throw Error("expected a box for "s + to_string(frame.coordinates) + " points, got none");
  }
  Vector3 from = {};
  Vector3 to = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double lo = HUGE_VAL;
    double hi = -HUGE_VAL;
    for (const Survey& rank : surveys)
    {
      lo = std::min(lo, rank.lo[axis]);
      hi = std::max(hi, rank.hi[axis]);
    }
    from[axis] = lo <= hi ? lo : 0;
    to[axis] = lo <= hi ? hi : 0;
  }
  plan.header.box = Box::from_bounds(from, to);
  plan.header.box.boundary = "ff ff ff";
  notices.push_back({ {}, "the input has no box: it is made from the bounds of the grains" });
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
void check_frame(const FramePlan& plan, const DumpFormat& format, Notices& notices)
{
  const Box& box = plan.header.box;
  const auto& columns = plan.columns.columns;
  const bool scaled = std::any_of(columns.begin(), columns.end(), is_scaled);
  if (scaled || plan.columns.wraps)
  {
    check_volume(box);
  }
  check_line(plan.header.label, "the label");
  check_line(plan.header.units, "the units");
  check_bounds(box);
  const bool lammps = plan.header.dialect == Dialect::Lammps; // the other has neither
  if (lammps && format.units && plan.header.units.empty())
  {
    throw Error("expected the units of the frame for ITEM: UNITS, got none");
  }
  if (lammps && format.time && !plan.header.time)
  {
    throw Error("expected the time of the frame for ITEM: TIME, got none");
  }
  if (format.sort_by_id && !plan.columns.ids)
  {
    notices.push_back({ {}, "no integer array 'id': the rows are not sorted" });
  }
  if (box.boundary.empty() && plan.header.has_box)
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
ColumnPlan join_plan(const ColumnPlan& lead, const FrameView& frame, const DumpFormat& format)
{
  if (frame.rows == 0)
  {
    return lead;
  }
  Notices told; // by the rank that leads
  const std::vector<std::string> names = lead.names();
  ColumnPlan plan = plan_names(names, frame, format, told);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const ColumnSource& own = plan.columns[i];
    const ColumnSource& other = lead.columns[i];
    if (own.kind != other.kind || own.own != other.own ||
      is_integer(own.values.type) != is_integer(other.values.type) ||
      (own.values.type == ValueType::Text) != (other.values.type == ValueType::Text))
    {
      fail_others(names[i]);
    }
    plan.columns[i].numbers = other.numbers;
  }
  if (plan.ids.has_value() != lead.ids.has_value())
  {
    fail_others("id");
  }
  for (std::size_t axis = 0; axis < plan.images.size(); ++axis)
  {
    if (plan.images[axis].has_value() != lead.images[axis].has_value())
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
    find_bounds(frame, survey);
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

  Notices told;
  std::string bytes;
  if (ranks.rank() == leader)
  {
    plan.header = frame.header;
    plan.header.dialect = choose_dialect(format, frame.header);
    choose_box(plan, frame, format, surveys, told);
    const std::vector<std::string> names = choose_names(frame, format, told);
    check_names(names);
    plan.columns = plan_names(names, frame, format, told);
    if (!format.binary)
    {
      choose_numbers(frame, format.numbers, plan.columns);
    }
    check_frame(plan, format, told);
    ArchiveWriter packer;
    pass(packer, plan);
    pass(packer, told);
    bytes = std::move(packer.bytes);
  }
  ranks.broadcast(bytes, leader);
  ArchiveReader unpacker(bytes);
  pass(unpacker, plan);
  pass(unpacker, told);
  plan.header.counted = name_of_rows(format, plan.header);
  plan.header.rows = sum_of(plan.kept_rows);
  std::string& boundary = plan.header.box.boundary;
  boundary = boundary.empty() ? "ff ff ff" : parse_boundary(boundary);
  plan.columns = join_plan(plan.columns, frame, format);
  notices.insert(notices.end(), told.begin(), told.end());
  return plan;
}
}
