// SPDX-License-Identifier: BSD-3-Clause
#include "local_read.h"

#include "bench.h"
#include "dump_frame.h"

#include "granular/local/local_file.h"
#include "granular/local/local_reader.h"
#include "granular/memory/block_pool.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using namespace granular;

constexpr const char* columns = "x1 y1 z1 x2 y2 z2 id1 id2 periodic forcex forcey forcez";

/// Contacts as LIGGGHTS prints them, with another header on top of the same rows, so that they are a dump of particles
/// with as many columns of the same types.
struct Contacts
{
  explicit Contacts(std::int64_t count)
    : rows(count)
    , local(file(count, "ENTRIES", columns))
    , dump(file(count, "ATOMS", "x y z vx vy vz id mol type fx fy fz"))
    , dump_index(index_of({ dump->path() }))
  {
    IndexOptions options;
    options.format = &local_format();
    local_index = index_of({ local->path() }, options);
    pool = std::make_shared<BlockPool>(std::size_t{ 4 } << 30);
  }

  static std::unique_ptr<TemporaryFile> file(
    std::int64_t count, const std::string& counted, const std::string& names)
  {
    std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF " + counted + "\n" +
      std::to_string(count) + "\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\nITEM: " + counted + " " +
      names + " \n";
    Random random(3);
    const auto number = [&](double value)
    {
      append(text, value, Print::General);
      text += ' ';
    };
    for (std::int64_t row = 0; row < count; ++row)
    {
      const double first[3] = { random.unit(), random.unit(), random.unit() };
      for (const double coordinate : first)
      {
        number(coordinate);
      }
      bool crosses = false;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double second = first[axis] + random.between(-0.01, 0.01);
        const double wrapped = axis < 2 ? second - std::floor(second) : second;
        crosses = crosses || wrapped != second;
        number(wrapped);
      }
      for (int end = 0; end < 2; ++end)
      {
        append(text, static_cast<std::int64_t>(1 + random.bits() % 900'000));
        text += ' ';
      }
      text += crosses ? "1 " : "0 ";
      for (int axis = 0; axis < 3; ++axis)
      {
        number(random.between(-1, 1));
      }
      text += '\n';
    }
    auto made = std::make_unique<TemporaryFile>();
    made->append(text);
    return made;
  }

  /// split: lines at the faces; lines: at all. Gives the number of lines, or rows.
  std::int64_t read(int threads, bool lines, PeriodicLines periodic) const
  {
    LocalRequest request;
    request.columns = name_columns(local_columns);
    if (!lines)
    {
      request.columns[0] = "c_x"; // then the ends are not known
    }
    request.wanted = [](std::string_view) { return true; };
    request.lines.periodic = periodic;
    request.lines.threads = threads;
    request.lines.pool = pool;
    Notices notices;
    Progress progress;
    SerialCommunicator alone;
    const LocalFrame frame = read_local(local_index.pieces(0), request, alone, notices, progress);
    return lines ? frame.lines.count : frame.table.rows;
  }

  std::int64_t rows;
  std::unique_ptr<TemporaryFile> local;
  std::unique_ptr<TemporaryFile> dump;
  RunIndex dump_index;
  RunIndex local_index;
  std::vector<std::string> local_columns{ "x1", "y1", "z1", "x2", "y2", "z2", "id1", "id2",
    "periodic", "forcex", "forcey", "forcez" };
  std::shared_ptr<BlockPool> pool;
};

void measure(benchmark::State& state, std::int64_t rows, int threads)
{
  const Contacts data(rows);
  Rounds rounds(threads > 1 ? wall : now);
  rounds.add("dump",
    [&]
    {
      DumpRequest request;
      request.threads = threads;
      request.pool = data.pool;
      return read_frame(data.dump_index, 0, request).rows == rows;
    });
  rounds.add("table", [&] { return data.read(threads, false, PeriodicLines::AsWritten) == rows; });
  rounds.add(
    "lines", [&] { return data.read(threads, true, PeriodicLines::MinimumImage) == rows; });
  rounds.add("split", [&] { return data.read(threads, true, PeriodicLines::Split) > rows; });
  if (!rounds.run_all(state, "rows are missing", static_cast<double>(rows)))
  {
    return;
  }
  const Samples& base = rounds.of("dump");
  tell(state, "dump", 1e9 * median(base), "ns/row");
  for (const char* name : { "table", "lines", "split" })
  {
    tell(
      state, std::string(name) + ", time against dump", median_ratio(rounds.of(name), base), "1");
  }
  tell(state, "spread", spread_of_ratio(rounds.of("lines"), base), "1");
}
}

void add_reading(const Size& size)
{
  const std::int64_t rows = size.pick(1'000'000, 1'000);
  for (const int threads : { 1, 2 })
  {
    add("local/read, threads: " + std::to_string(threads), size.pick(11, 1),
      [rows, threads](benchmark::State& state) { measure(state, rows, threads); });
  }
}
}
