// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/sorted_rows.h"

#include "granular/common/shares.h"
#include "granular/formats/dump/write/row_values.h"
#include "granular/sorting/sort_rows.h"
#include "granular/sorting/text_dictionary.h"

#include <algorithm>
#include <numeric>

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

template <class From, class To>
void copy_numbers(const RowValues::Column& column, std::size_t rows, To* to)
{
  for (std::size_t row = 0; row < rows; ++row)
  {
    to[row] = static_cast<To>(column.at<From>(row));
  }
}

/// The integers of a column, of whatever width.
void copy_integers(const RowValues::Column& column, std::size_t rows, std::int64_t* to)
{
  if (column.type == ValueType::Int32)
  {
    copy_numbers<std::int32_t>(column, rows, to);
    return;
  }
  copy_numbers<std::int64_t>(column, rows, to);
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
  RowValues values;
  std::int64_t done = 0;
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  for (std::int64_t first = 0; first < frame.rows; first += most)
  {
    progress.step(static_cast<double>(first) / static_cast<double>(frame.rows));
    values.load(frame, wanted, plan.header.box, first, std::min(most, frame.rows - first), 0);
    for (std::size_t i = 0; i < rows_.arrays.size(); ++i)
    {
      const RowValues::Column& column = values.columns()[i];
      auto* indices = static_cast<std::int32_t*>(rows_.arrays[i].block.data()) + done;
      switch (rows_.arrays[i].info.type)
      {
        case ValueType::Text:
          for (const std::string* text : column.texts)
          {
            *indices++ = words[i].index(*text, {});
          }
          break;
        case ValueType::Float64:
          copy_numbers<double>(
            column, values.rows(), static_cast<double*>(rows_.arrays[i].block.data()) + done);
          break;
        default:
          copy_integers(
            column, values.rows(), static_cast<std::int64_t*>(rows_.arrays[i].block.data()) + done);
          break;
      }
    }
    copy_integers(
      values.columns().back(), values.rows(), static_cast<std::int64_t*>(ids_.data()) + done);
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
