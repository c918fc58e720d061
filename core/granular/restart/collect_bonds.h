// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_collect_bonds_h
#define granular_restart_collect_bonds_h

#include "granular/restart/decode_records.h"
#include "granular/restart/match_bonds.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace granular
{
/// The bonds of all particles of a file, and the data to draw them.
class BondCollector
{
public:
  /// blocks: of a RecordScan. ids and points of all rows, from 0, which may not be filled yet; if null they are collected,
  /// too.
  BondCollector(const RecordPlan& plan, std::int64_t rows, std::size_t blocks,
    const std::int64_t* ids, const double* points, const std::shared_ptr<BlockPool>& pool);

  /// Rows of a block, those of each block one behind the other. Any number of threads, each at a block of its own. Throws
  /// FormatError with the record.
  void collect(std::size_t block, const RecordBatch& batch, const RecordRows& rows);

  std::size_t history_values() const noexcept { return history_values_; }
  std::span<const std::int64_t> ids() const noexcept { return { ids_, rows_ }; }
  const double* point(std::int64_t row) const noexcept { return points_ + 3 * row; }
  std::vector<BondCopies>& copies() noexcept { return copies_; }
  const std::vector<BondCopies>& copies() const noexcept { return copies_; }

private:
  std::size_t history_values_;
  std::size_t rows_;
  std::shared_ptr<BlockPool> pool_;
  Block own_ids_;
  Block own_points_;
  std::int64_t* to_ids_ = nullptr; ///< where they are collected
  double* to_points_ = nullptr;
  const std::int64_t* ids_;
  const double* points_;
  std::vector<BondCopies> copies_; ///< of each block
};
}
#endif
