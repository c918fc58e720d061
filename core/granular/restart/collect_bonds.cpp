// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/collect_bonds.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace granular
{
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
    const FoundBonds& found = rows.bonds[i];
    const auto count = static_cast<std::size_t>(found.block.bonds);
    try
    {
      for (std::size_t bond = 0; bond < count; ++bond)
      {
        copies.types.push_back(to_int32(found.block.pairs[2 * bond], found.form, "a bond type"));
        copies.partners.push_back(to_whole(found.block.pairs[2 * bond + 1], found.form));
      }
    }
    catch (const FormatError& error)
    {
      refuse_record(
        batch, row - static_cast<std::size_t>(batch.first_row), error.text() + " for a bond");
    }
    if (found.block.history_values > 0)
    {
      history = std::copy_n(found.block.history, count * history_values_, history);
    }
    copies.begins.push_back(static_cast<std::int64_t>(copies.size()));
  }
}
}
