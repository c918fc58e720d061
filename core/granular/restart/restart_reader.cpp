// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/restart_reader.h"

#include "granular/common/shares.h"
#include "granular/restart/bond_frame.h"
#include "granular/restart/collect_bonds.h"
#include "granular/restart/decode_records.h"
#include "granular/restart/record_plan.h"
#include "granular/restart/record_scan.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace granular
{
namespace
{
/// Decodes the records of a file.
class FrameReader
{
public:
  FrameReader(const ByteSource& source, const RestartLayout& layout, const RestartRequest& request,
    const RecordPlan& plan)
    : plan_(plan)
    , records_(layout.records)
    , first_(begin_of_part(layout.records, request.piece, request.pieces))
    , end_(begin_of_part(layout.records, request.piece + 1, request.pieces))
    , executor_(request.lines.threads)
    , scan_(source, layout)
    , particles_(plan, layout, request, first_, end_)
  {
    if (request.bonds && plan.has_bonds())
    {
      const bool all = request.pieces == 1;
      const bool absolute = request.lines.point_origin == Vector3{};
      bonds_.emplace(plan, records_, scan_.blocks(), all ? particles_.ids() : nullptr,
        all && absolute ? particles_.points() : nullptr, request.lines.pool);
    }
  }

  void read(Progress& progress)
  {
    // what fixes have is the same in all records or left out, which all pieces must know
    const bool all = bonds_ || plan_.fixes() > 0;
    std::vector<RecordRows> rows(executor_.workers(scan_.blocks()), RecordRows(plan_));
    const auto visit = [&](std::size_t worker, std::size_t block, const RecordBatch& batch)
    {
      const auto size = static_cast<std::int64_t>(batch.size());
      const auto place_of = [&](std::int64_t row) {
        return static_cast<std::size_t>(std::clamp<std::int64_t>(row - batch.first_row, 0, size));
      };
      const std::size_t end = all ? batch.size() : place_of(end_);
      RecordRows& some = rows[worker];
      for (std::size_t at = all ? 0 : place_of(first_); at < end; at += some.count)
      {
        some.load(plan_, batch, at, end);
        particles_.store(some);
        if (bonds_)
        {
          bonds_->collect(block, batch, some);
        }
      }
    };
    scan_.run(executor_, all ? records_ : end_, visit, progress);
  }

  RestartFrame take(const RestartLayout& layout, const RestartRequest& request, const Where& where,
    Notices& notices, Progress& progress)
  {
    RestartFrame frame;
    FrameHeader& header = frame.bonds.table.header;
    header = particles_.header();
    header.rows = 0;
    header.counted = "BONDS";
    if (bonds_)
    {
      make_bond_frame(
        *bonds_, layout, request, first_, end_, where, frame.bonds, notices, progress);
    }
    frame.particles = particles_.take(where, notices);
    return frame;
  }

private:
  const RecordPlan& plan_;
  std::int64_t records_;
  std::int64_t first_;
  std::int64_t end_;
  Executor executor_;
  RecordScan scan_;
  ParticleStore particles_;
  std::optional<BondCollector> bonds_;
};
}

RestartColumns find_restart_columns(
  const ByteSource& source, const RestartLayout& layout, Notices& notices, Progress& progress)
{
  const RecordPlan plan(source, layout, notices, progress);
  RestartColumns columns;
  for (const RecordColumn& column : plan.columns())
  {
    columns.particles.push_back(column.name);
  }
  columns.has_bonds = plan.has_bonds();
  columns.history_values = plan.history_values();
  return columns;
}

RestartFrame read_restart(const ByteSource& source, const RestartLayout& layout,
  const RestartRequest& request, Notices& notices, Progress& progress)
{
  PartialProgress part(progress);
  part.set_part(0, 0.05);
  const RecordPlan plan(source, layout, notices, part);
  FrameReader reader(source, layout, request, plan);
  part.set_part(0.05, plan.has_bonds() ? 0.7 : 1);
  reader.read(part);
  part.set_part(0.7, 1);
  return reader.take(layout, request, { source.path() }, notices, part);
}
}
