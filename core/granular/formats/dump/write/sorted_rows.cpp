// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/frame_plan.h"

#include "granular/common/shares.h"
#include "granular/formats/dump/write/row_values.h"
#include "granular/particles/point_forms.h"
#include "granular/sorting/sort_rows.h"
#include "granular/sorting/text_dictionary.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace granular
{
namespace
{
using Kind = ColumnSource::Kind;

ValueType type_of(const ColumnSource& column) noexcept
{
  const bool array = column.kind == Kind::Array;
  const bool integer = array ? is_integer(column.values.type) && column.values.factor == 1
                             : column.kind != Kind::Coordinate;
  return array && column.values.type == ValueType::Text ? ValueType::Text
    : integer                                           ? ValueType::Int64
                                                        : ValueType::Float64;
}
}

SortedRows::SortedRows(const FrameView& frame, FramePlan& plan, Communicator& ranks,
  const Executor& executor, Progress& progress)
{
  this->copy(frame, plan, ranks.rank(), progress);
  Notices none;
  sort_by_id(rows_, ids_, ranks, none, {}, executor);
  this->show(plan);
  const std::int64_t all =
    std::accumulate(plan.kept_rows.begin(), plan.kept_rows.end(), std::int64_t{ 0 });
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    plan.kept_rows[static_cast<std::size_t>(rank)] =
      begin_of_part(all, rank + 1, ranks.size()) - begin_of_part(all, rank, ranks.size());
  }
}

void SortedRows::copy(const FrameView& frame, const FramePlan& plan, int rank, Progress& progress)
{
  ColumnPlan wanted = plan.columns;
  wanted.binary = false; // integers stay what they are until they are written
  wanted.columns.push_back({ .name = "id", .values = *plan.columns.ids });
  rows_.rows = plan.kept_rows[static_cast<std::size_t>(rank)];
  const auto rows = static_cast<std::size_t>(rows_.rows);
  for (const ColumnSource& column : plan.columns.columns)
  {
    TableArray& array = rows_.arrays.emplace_back();
    array.info.name = column.name;
    array.info.type = type_of(column);
    array.info.columns = { 0 };
    array.block = Block(rows * size_of(array.info.type));
  }
  ids_ = Block(rows * sizeof(std::int64_t));
  std::vector<TextDictionary> words(rows_.arrays.size());
  std::array<std::int64_t, RowValues::most_rows> numbers;
  std::iota(numbers.begin(), numbers.end(), 0);
  RowValues values;
  std::int64_t done = 0;
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  for (std::int64_t first = 0; first < frame.rows; first += most)
  {
    progress.step(static_cast<double>(first) / static_cast<double>(frame.rows));
    values.load(frame, wanted, plan.header.box, first, std::min(most, frame.rows - first), 0);
    const auto kept = std::span<const std::int64_t>(numbers).first(values.rows());
    const auto load = [&](const RowValues::Column& column, auto* to) {
      load_numbers({ column.type, column.data, column.step }, kept, to + done);
    };
    for (std::size_t i = 0; i < rows_.arrays.size(); ++i)
    {
      const RowValues::Column& column = values.columns()[i];
      void* const to = rows_.arrays[i].block.data();
      switch (rows_.arrays[i].info.type)
      {
        case ValueType::Text:
          std::ranges::transform(column.texts, static_cast<std::int32_t*>(to) + done,
            [&](const std::string* text) { return words[i].index(*text, {}); });
          break;
        case ValueType::Float64:
          load(column, static_cast<double*>(to));
          break;
        default:
          load(column, static_cast<std::int64_t*>(to));
          break;
      }
    }
    load(values.columns().back(), static_cast<std::int64_t*>(ids_.data()));
    done += static_cast<std::int64_t>(values.rows());
  }
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    rows_.arrays[i].words = words[i].take();
  }
}

/// The blocks as a view, and the plan of it.
void SortedRows::show(FramePlan& plan)
{
  view_.rows = rows_.rows;
  plan.columns.images = {};
  plan.columns.wraps = false;
  for (std::size_t i = 0; i < rows_.arrays.size(); ++i)
  {
    const TableArray& array = rows_.arrays[i];
    ColumnSource& column = plan.columns.columns[i];
    column.kind = Kind::Array;
    column.own = false;
    column.values = { array.info.type, array.block.data() };
    if (array.info.type == ValueType::Text)
    {
      std::vector<std::string>& texts = texts_.emplace_back();
      const auto* indices = static_cast<const std::int32_t*>(array.block.data());
      for (std::int64_t row = 0; row < rows_.rows; ++row)
      {
        texts.push_back(array.words[static_cast<std::size_t>(indices[row])]);
      }
      column.values = { ValueType::Text, texts.data() };
    }
  }
}
}
