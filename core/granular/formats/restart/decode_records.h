// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_decode_records_h
#define granular_formats_restart_decode_records_h

#include "granular/formats/restart/match_bonds.h"
#include "granular/formats/restart/record_plan.h"
#include "granular/formats/restart/record_scan.h"
#include "granular/formats/restart/restart_reader.h"
#include "granular/particles/table.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace granular
{
/// Records that are examined together while they are in the cache.
struct RecordRows
{
  static constexpr std::size_t most = 128;

  explicit RecordRows(const RecordPlan& plan);

  std::int64_t first_row = 0; ///< of the file
  std::size_t count = 0;
  std::size_t stride = 0;
  std::vector<const double*> parts; ///< of record i from i * stride on: see RecordPlan::find_parts
  std::array<std::int64_t, most> ids = {};
  std::array<std::int32_t, most> types = {};
  std::array<std::int32_t, most> masks = {};
  std::array<ImageCounts, most> images = {};
  std::array<std::int64_t, most> molecules = {};
  std::array<BondBlock, most> bonds = {};

  /// Finds the fields of at most end - begin records of a batch. Throws FormatError with the record.
  void load(const RecordPlan& plan, const RecordBatch& batch, std::size_t begin, std::size_t end);

private:
  void load_record(const RecordPlan& plan, std::span<const double> record, std::size_t i);

  const RecordColumn* molecule_;
};

/// Stores the particles of a range of rows in a frame. Any number of threads may store different rows.
class ParticleStore
{
public:
  /// Allocates rows from first to end. Throws std::bad_alloc.
  ParticleStore(const RecordPlan& plan, const RestartLayout& layout, const Request& request,
    std::int64_t first, std::int64_t end);

  /// Stores the requested rows; of other rows only the data of fixes are checked.
  void store(const RecordRows& rows);

  /// Returns the ids of the rows, or null if they were not requested.
  const std::int64_t* ids() const noexcept;

  /// Returns the coordinates of the points.
  const double* points() const noexcept { return static_cast<const double*>(frame_.points.data()); }

  const FrameHeader& header() const noexcept { return frame_.header; }

  Table take(const Where& where, Notices& notices);

private:
  /// Doubles from one place of each record, stored one after the other.
  struct Doubles
  {
    std::size_t part;
    std::size_t slot;
    std::size_t count;
    char* to;
    std::size_t stride;
  };

  /// A number that is converted before it is stored.
  struct Number
  {
    RecordColumn column;
    char* to;
    std::size_t stride;
  };

  /// Requested records, and their rows.
  struct Part
  {
    std::size_t begin;
    std::size_t end;
    std::size_t row; ///< of the frame, that of the first
  };

  void add_array(const RecordPlan& plan, const ArrayInfo& info, const Request& request);
  static void store_doubles(const Doubles& doubles, const RecordRows& rows, const Part& part);
  static void store_number(const Number& number, const RecordRows& rows, const Part& part);
  std::int64_t count_misfits(const RecordRows& rows) const noexcept;
  void store_points(const RecordRows& rows, const Part& part);

  Table frame_;
  Vector3 point_origin_;
  std::int64_t first_;
  std::int64_t end_;
  std::size_t styles_;
  std::vector<Doubles> doubles_;
  std::vector<Doubles> of_fixes_;
  std::vector<Number> numbers_;
  std::vector<std::size_t> fix_arrays_; ///< in the frame
  std::atomic<std::int64_t> misfits_ =
    0; ///< records in which the parts of fixes are not as in others
};

/// The bonds of all particles of a file, and the data to draw them.
class BondCollector
{
public:
  /// blocks: of the layout. ids and points of all rows, from 0, which may not be filled yet; if null they are collected,
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
