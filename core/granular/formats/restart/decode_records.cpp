// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/decode_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace granular
{
namespace
{
using Kind = RecordColumn::Kind;

/// The image of a particle. Where ids are values some programs write it as a value and others as bits; where they are bits it is
/// these, too: the bits of a large count along z are a whole number of 2^52 and more, as a value could be.
std::int64_t load_image(double number, WholeNumbers form) noexcept
{
  const bool value =
    form == WholeNumbers::Values && number >= 1 && number < 0x1p63 && std::trunc(number) == number;
  return value ? static_cast<std::int64_t>(number) : std::bit_cast<std::int64_t>(number);
}

/// The bits of the groups, of which the last may be the sign.
std::int32_t load_mask(double number, WholeNumbers form)
{
  const std::int64_t mask = to_whole(number, form);
  if (mask < std::numeric_limits<std::int32_t>::min() ||
    mask > std::numeric_limits<std::uint32_t>::max())
  {
    throw FormatError("expected the bits of 32 groups in double " +
      std::to_string(RecordSlots::mask) + " of a record, got " + std::to_string(mask));
  }
  return static_cast<std::int32_t>(mask);
}
}

RecordRows::RecordRows(const RecordPlan& plan)
  : stride(plan.styles() + plan.fixes())
  , parts(stride * most)
  , molecule_(plan.molecule())
{
}

void RecordRows::load_record(const RecordPlan& plan, std::span<const double> record, std::size_t i)
{
  plan.find_parts(record, std::span(parts).subspan(i * stride, stride), bonds[i]);
  const WholeNumbers form = whole_numbers_of(record);
  ids[i] = to_whole(record[RecordSlots::tag], form);
  types[i] = static_cast<std::int32_t>(to_whole(record[RecordSlots::type], form));
  masks[i] = load_mask(record[RecordSlots::mask], form);
  images[i] = unpack_image(load_image(record[RecordSlots::image], form), plan.image_bits());
  if (molecule_)
  {
    const std::span part(parts[i * stride + molecule_->part], molecule_->slot + 1);
    molecules[i] = to_whole(part[molecule_->slot], whole_numbers_of(part));
  }
}

void RecordRows::load(
  const RecordPlan& plan, const RecordBatch& batch, std::size_t begin, std::size_t end)
{
  first_row = batch.first_row + static_cast<std::int64_t>(begin);
  count = std::min(end - begin, most);
  for (std::size_t i = 0; i < count; ++i)
  {
    try
    {
      this->load_record(plan, batch.record(begin + i), i);
    }
    catch (const FormatError& error)
    {
      refuse_record(batch, begin + i, error.text());
    }
  }
}

ParticleStore::ParticleStore(const RecordPlan& plan, const RestartLayout& layout,
  const Request& request, std::int64_t first, std::int64_t end)
  : point_origin_(request.point_origin)
  , first_(first)
  , end_(end)
  , styles_(plan.styles())
{
  const RestartHeader& header = layout.header;
  frame_.rows = end - first;
  frame_.header = { header.timestep, header.time, {}, header.units, layout.records, header.box };
  frame_.points = Block(static_cast<std::size_t>(frame_.rows) * sizeof(Vector3), request.pool);
  std::vector<std::string> names;
  for (const RecordColumn& column : plan.columns())
  {
    names.push_back(column.name);
  }
  frame_.schema = ColumnSchema(names);
  for (const ArrayInfo& info : frame_.schema.arrays())
  {
    if (is_wanted(request.wanted, info.name, !info.position_form))
    {
      this->add_array(plan, info, request);
    }
  }
}

void ParticleStore::add_array(const RecordPlan& plan, const ArrayInfo& info, const Request& request)
{
  TableArray array{ info, {}, {}, {} };
  const std::size_t width = size_of(info.type);
  const std::size_t bytes = width * info.columns.size();
  array.block = Block(bytes * static_cast<std::size_t>(frame_.rows), request.pool);
  auto* to = static_cast<char*>(array.block.data());
  const auto column_of = [&](int number) -> const RecordColumn&
  { return plan.columns()[static_cast<std::size_t>(number)]; };
  const bool fix = column_of(info.columns.front()).kind == Kind::OfAFix;
  std::vector<Doubles>& all = fix ? of_fixes_ : doubles_;
  const std::size_t others = all.size();
  for (const int number : info.columns)
  {
    const RecordColumn& column = column_of(number);
    const std::size_t part = column.part + (fix ? styles_ : 0);
    if (all.size() > others && all.back().part == part &&
      all.back().slot + all.back().count == column.slot)
    {
      ++all.back().count;
    }
    else if (fix || column.kind == Kind::Double)
    {
      all.push_back({ part, column.slot, 1, to, bytes });
    }
    else
    {
      numbers_.push_back({ column, to, bytes });
    }
    to += width;
  }
  if (fix)
  {
    fix_arrays_.push_back(frame_.arrays.size());
  }
  frame_.arrays.push_back(std::move(array));
}

const std::int64_t* ParticleStore::ids() const noexcept
{
  const auto found = std::ranges::find_if(
    frame_.arrays, [](const TableArray& array) { return array.info.role == ColumnRole::Id; });
  return found == frame_.arrays.end() ? nullptr
                                      : static_cast<const std::int64_t*>(found->block.data());
}

void ParticleStore::store_doubles(const Doubles& doubles, const RecordRows& rows, const Part& part)
{
  const auto copy = [&](auto count)
  {
    char* to = doubles.to + part.row * doubles.stride;
    for (std::size_t i = part.begin; i < part.end; ++i, to += doubles.stride)
    {
      const double* const from = rows.parts[i * rows.stride + doubles.part] + doubles.slot;
      std::memcpy(to, from, count * sizeof(double));
    }
  };
  switch (doubles.count)
  {
    case 1:
      return copy(std::integral_constant<std::size_t, 1>());
    case 3:
      return copy(std::integral_constant<std::size_t, 3>());
    default:
      return copy(doubles.count);
  }
}

void ParticleStore::store_number(const Number& number, const RecordRows& rows, const Part& part)
{
  const auto store = [&](const auto& value_of)
  {
    char* to = number.to + part.row * number.stride;
    for (std::size_t i = part.begin; i < part.end; ++i, to += number.stride)
    {
      const auto value = value_of(i);
      std::memcpy(to, &value, sizeof value);
    }
  };
  switch (number.column.kind)
  {
    case Kind::Id:
      return store([&](std::size_t i) { return rows.ids[i]; });
    case Kind::Type:
      return store([&](std::size_t i) { return rows.types[i]; });
    case Kind::Mask:
      return store([&](std::size_t i) { return rows.masks[i]; });
    case Kind::Image:
    {
      constexpr std::int32_t ImageCounts::*axes[] = { &ImageCounts::x, &ImageCounts::y,
        &ImageCounts::z };
      const auto axis = axes[number.column.slot];
      return store([&](std::size_t i) { return rows.images[i].*axis; });
    }
    default:
      return store([&](std::size_t i) { return rows.molecules[i]; });
  }
}

void ParticleStore::store_points(const RecordRows& rows, const Part& part)
{
  auto* to = static_cast<double*>(frame_.points.data()) + 3 * part.row;
  const auto [x, y, z] = point_origin_;
  for (std::size_t i = part.begin; i < part.end; ++i, to += 3)
  {
    const double* const from = rows.parts[i * rows.stride] + RecordSlots::x;
    to[0] = from[0] - x;
    to[1] = from[1] - y;
    to[2] = from[2] - z;
  }
}

std::int64_t ParticleStore::count_misfits(const RecordRows& rows) const noexcept
{
  std::int64_t misfits = 0;
  for (std::size_t i = 0; !of_fixes_.empty() && i < rows.count; ++i)
  {
    misfits += rows.parts[i * rows.stride + styles_] ? 0 : 1;
  }
  return misfits;
}

void ParticleStore::store(const RecordRows& rows)
{
  const auto count = static_cast<std::int64_t>(rows.count);
  const std::int64_t misfits = this->count_misfits(rows);
  if (misfits > 0)
  {
    misfits_ += misfits; // of all threads
  }
  const std::int64_t first = std::clamp<std::int64_t>(first_ - rows.first_row, 0, count);
  const std::int64_t last = std::clamp<std::int64_t>(end_ - rows.first_row, 0, count);
  if (first >= last)
  {
    return;
  }
  const Part part = { static_cast<std::size_t>(first), static_cast<std::size_t>(last),
    static_cast<std::size_t>(rows.first_row + first - first_) };
  this->store_points(rows, part);
  for (const Doubles& doubles : doubles_)
  {
    store_doubles(doubles, rows, part);
  }
  for (const Number& number : numbers_)
  {
    store_number(number, rows, part);
  }
  if (misfits == 0)
  {
    for (const Doubles& doubles : of_fixes_)
    {
      store_doubles(doubles, rows, part);
    }
  }
}

Table ParticleStore::take(const Where& where, Notices& notices)
{
  if (misfits_ > 0)
  {
    notices.push_back({ where,
      "what fixes have of particles is left out: of " + std::to_string(misfits_) +
        " it is not where it should be" });
    for (auto i = fix_arrays_.rbegin(); i != fix_arrays_.rend(); ++i)
    {
      frame_.arrays.erase(frame_.arrays.begin() + static_cast<std::ptrdiff_t>(*i));
    }
  }
  return std::move(frame_);
}

BondCollector::BondCollector(const RecordPlan& plan, std::int64_t rows, std::size_t blocks,
  const std::int64_t* ids, const double* points, const std::shared_ptr<BlockPool>& pool)
  : history_values_(static_cast<std::size_t>(plan.history_values()))
  , rows_(static_cast<std::size_t>(rows))
  , pool_(pool)
  , ids_(ids)
  , points_(points)
  , copies_(blocks)
{
  if (!ids_)
  {
    own_ids_ = Block(rows_ * sizeof(std::int64_t), pool);
    ids_ = to_ids_ = static_cast<std::int64_t*>(own_ids_.data());
  }
  if (!points_)
  {
    own_points_ = Block(rows_ * sizeof(Vector3), pool);
    points_ = to_points_ = static_cast<double*>(own_points_.data());
  }
}

void BondCollector::collect(std::size_t block, const RecordBatch& batch, const RecordRows& rows)
{
  BondCopies& copies = copies_[block];
  if (copies.rows() == 0)
  {
    copies.first_row = batch.first_row;
    copies.begins.reserve(batch.size() + 1);
    // enough for any number of bonds; the rest is never touched, but counts for the limit of the pool
    copies.history = Block(history_values_ > 0 ? batch.starts.back() * sizeof(double) : 0, pool_);
  }
  double* history = static_cast<double*>(copies.history.data()) + copies.size() * history_values_;
  for (std::size_t i = 0; i < rows.count; ++i)
  {
    const auto row = static_cast<std::size_t>(rows.first_row) + i;
    if (to_ids_)
    {
      to_ids_[row] = rows.ids[i];
    }
    if (to_points_)
    {
      std::memcpy(
        to_points_ + 3 * row, rows.parts[i * rows.stride] + RecordSlots::x, sizeof(Vector3));
    }
    const BondBlock& found = rows.bonds[i];
    const auto count = static_cast<std::size_t>(found.bonds);
    try
    {
      for (std::size_t bond = 0; bond < count; ++bond)
      {
        copies.types.push_back(to_int32(found.pairs[2 * bond], found.form, "a bond type"));
        copies.partners.push_back(to_whole(found.pairs[2 * bond + 1], found.form));
      }
    }
    catch (const FormatError& error)
    {
      refuse_record(
        batch, row - static_cast<std::size_t>(batch.first_row), error.text() + " for a bond");
    }
    if (found.history_values > 0)
    {
      history = std::copy_n(found.history, count * history_values_, history);
    }
    copies.begins.push_back(static_cast<std::int64_t>(copies.size()));
  }
}
}
