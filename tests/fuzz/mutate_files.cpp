// SPDX-License-Identifier: BSD-3-Clause
// Damaged copies of good files, thousands in one process, one after the other through the same pool of memory and the same
// indexes: what a file is read as must not depend on those before it. Arguments: the seed, the number of copies of each
// file, then files and folders. The same arguments give the same copies. A crash, a hang or an array that is not what it
// says is the failure; an Error is none.
#include "../support/file_damage.h"
#include "dump_checks.h"
#include "local_checks.h"

#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"
#include "granular/decomposition/decomposition_file.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/euler/euler_file.h"
#include "granular/euler/regular_grids.h"
#include "granular/frames/run_index.h"
#include "granular/local/local_file.h"
#include "granular/memory/block_pool.h"
#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

using namespace granular;
using file_damage::below;
using file_damage::content_of;
using file_damage::damage;
using file_damage::Random;

namespace
{
// ---- readers -----------------------------------------------------------------------------------

constexpr std::size_t most_frames = 3;

/// What lives as long as the process, as in a session of ParaView.
struct Session
{
  std::shared_ptr<BlockPool> pool = std::make_shared<BlockPool>(std::size_t{ 64 } << 20);
  std::vector<DumpFrame> shown; ///< of files before, which hold and give back memory
  std::size_t read = 0;
  std::size_t refused = 0;
};

void check_arrays(const DumpFrame& frame)
{
  const auto rows = static_cast<std::size_t>(frame.rows);
  for (const DumpArray& array : frame.arrays)
  {
    const std::size_t values = rows * array.info.columns.size();
    require(array.block.bytes() == values * size_of(array.info.type), "the size of an array");
    const auto* const words = static_cast<const std::int32_t*>(array.block.data());
    for (std::size_t i = 0; array.info.type == ValueType::Text && i < values; ++i)
    {
      require(words[i] >= 0 && static_cast<std::size_t>(words[i]) < array.words.size(), "a word");
    }
  }
}

/// Bytes that would be others if memory were shown that nobody has written to.
std::string content_of(const DumpFrame& frame)
{
  std::string all(static_cast<const char*>(frame.points.data()), frame.points.bytes());
  for (const DumpArray& array : frame.arrays)
  {
    all += array.info.name + values_of(array, frame.rows);
  }
  return all;
}

DumpFrame read_once(
  const RunIndex& run, std::size_t frame, DumpRequest request, int threads, std::size_t chunk)
{
  Notices notices;
  Progress progress;
  request.threads = threads;
  request.chunk_bytes = chunk;
  DumpFrame read = read_dump(run.pieces(frame), request, notices, progress);
  check_arrays(read);
  return read;
}

void read_particles(const RunIndex& run, std::size_t frame, Random& random, Session& session)
{
  std::vector<DumpRequest> all = requests();
  DumpRequest& request = all[below(random, all.size())];
  request.pool = session.pool;
  request.ranges = true;
  session.pool->next_frame();
  std::vector<DumpFrame>& shown = session.shown;
  shown.push_back(read_once(run, frame, request, 1, std::size_t{ 1 } << 18));
  const DumpFrame again = read_once(run, frame, request, 3, 200);
  require(content_of(shown.back()) == content_of(again), "what was read depends on the memory");
  if (shown.size() > 8)
  {
    shown.erase(shown.begin() + static_cast<std::ptrdiff_t>(below(random, shown.size())));
  }
}

/// Any preset that fits.
std::vector<std::string> choose_names(const std::vector<std::string>& columns, Random& random)
{
  const auto presets = local_presets();
  try
  {
    return name_columns(columns, presets[below(random, presets.size())]);
  }
  catch (const Error&)
  {
    return name_columns(columns);
  }
}

void read_rows(const RunIndex& run, std::size_t frame, Random& random, Session& session)
{
  LocalRequest request;
  request.columns = guess_names(run, run.first_piece(frame),
    [&](const std::vector<std::string>& columns) { return choose_names(columns, random); });
  request.lines.periodic = static_cast<PeriodicLines>(below(random, 3));
  request.lines.pool = session.pool;
  if (below(random, 2) == 0)
  {
    request.wanted = [](std::string_view) { return true; };
  }
  session.pool->next_frame();
  std::string before;
  for (const int threads : { 1, 3 })
  {
    SerialCommunicator alone;
    Notices notices;
    Progress progress;
    request.lines.threads = threads;
    const LocalFrame read = read_local(run.pieces(frame), request, alone, notices, progress);
    check_arrays(read.table);
    require(read.lines.points.bytes() == static_cast<std::size_t>(read.lines.count) * 48, "lines");
    require(!read.has_lines || read.lines.count >= read.table.rows, "as many lines as rows");
    const std::string content = content_of(read.table) +
      std::string(static_cast<const char*>(read.lines.points.data()), read.lines.points.bytes());
    require(threads == 1 || content == before, "what was read depends on the memory");
    before = content;
  }
}

void read_cells(const RunIndex& run, std::size_t frame, Random&, Session&)
{
  const FramePiece piece = run.first_piece(frame);
  Notices notices;
  Progress progress;
  const EulerFrame cells = read_euler(
    *open_indexed(piece.file), piece.entry, [](std::string_view) { return true; }, notices,
    progress);
  require(cells.centres.size() == 3 * static_cast<std::size_t>(cells.cells), "centres");
  static_cast<void>(find_regular_grids(cells, notices));
}

void read_subdomains(const RunIndex& run, std::size_t frame, Random&, Session&)
{
  const FramePiece piece = run.first_piece(frame);
  Notices notices;
  Progress progress;
  if (piece.entry.rows < 100'000)
  {
    read_decomposition(*open_indexed(piece.file), piece.entry, notices, progress);
  }
}

void read_records(const RunIndex& run, std::size_t frame, Random& random, Session& session)
{
  Notices notices;
  Progress progress;
  const FileIndex& file = run.first_piece(frame).file;
  const auto source = open_indexed(file);
  const auto layout = find_restart_layout(file, *source, notices, progress);
  RestartRequest request;
  request.lines.threads = static_cast<int>(below(random, 3)) + 1;
  request.lines.pool = session.pool;
  const RestartFrame read = read_restart(*source, *layout, request, notices, progress);
  check_arrays(read.particles);
  check_arrays(read.bonds.table);
}

void read_sections(const RunIndex& run, std::size_t frame, Random& random, Session& session)
{
  DataRequest request;
  request.atom_style = atom_styles()[below(random, atom_styles().size())].name;
  request.atom_style = below(random, 2) == 0 ? "" : request.atom_style;
  request.periodic_lines = static_cast<PeriodicLines>(below(random, 3));
  request.particles.threads = static_cast<int>(below(random, 3)) + 1;
  request.particles.pool = session.pool;
  request.particles.chunk_bytes = below(random, 2) == 0 ? 200 : request.particles.chunk_bytes;
  session.pool->next_frame();
  SerialCommunicator alone;
  Notices notices;
  Progress progress;
  const DataFrame read = read_data(run.first_piece(frame), request, alone, notices, progress);
  check_arrays(read.particles);
  check_arrays(read.bonds.table);
  require(read.bonds.lines.count >= read.bonds.table.rows, "as many lines as bonds");
}

using ReadFrame = void (*)(const RunIndex&, std::size_t, Random&, Session&);

/// A kind of files, and the run that has had all files of it so far.
struct Kind
{
  const FileFormat& (*format)() noexcept;
  ReadFrame read;
  const char* columns; ///< of binary files that do not name them; null: nobody has said
  RunIndex run = {};
};

void read_files(Kind& kind, const std::vector<std::string>& paths, Random& random, Session& session)
{
  IndexOptions options;
  options.format = &kind.format();
  for (const std::string_view word : split_words(kind.columns ? kind.columns : ""))
  {
    options.column_names.emplace_back(word);
  }
  Notices notices;
  Progress progress;
  if (below(random, 3) == 0)
  {
    kind.run = {};
  }
  try
  {
    kind.run.update(paths, options, notices, progress);
  }
  catch (const Error&)
  {
    ++session.refused;
    return;
  }
  const std::size_t frames = kind.run.size();
  for (std::size_t i = 0; i < std::min(most_frames, frames); ++i)
  {
    try
    {
      kind.read(kind.run, below(random, frames), random, session);
      ++session.read;
    }
    catch (const Error&)
    {
      ++session.refused;
    }
  }
}

std::vector<std::filesystem::path> files_of(int argc, char** argv)
{
  constexpr std::uintmax_t largest = 400'000; // larger ones take their time
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::filesystem::path& path)
  {
    if (std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) > 0 &&
      std::filesystem::file_size(path) <= largest)
    {
      files.push_back(path);
    }
  };
  for (int i = 3; i < argc; ++i)
  {
    add(argv[i]);
    if (std::filesystem::is_directory(argv[i]))
    {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i]))
      {
        add(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}
}

int main(int argc, char** argv)
{
  if (argc < 4)
  {
    std::fprintf(stderr, "usage: %s SEED COPIES FILE_OR_FOLDER...\n", argv[0]);
    return 1;
  }
  const std::vector<std::filesystem::path> files = files_of(argc, argv);
  const std::uint64_t seed = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t copies = std::strtoull(argv[2], nullptr, 10);
  std::vector<std::string> contents;
  std::ranges::transform(files, std::back_inserter(contents),
    [](const std::filesystem::path& path) { return content_of(path); });
  Kind kinds[] = {
    { dump_format, read_particles, nullptr },
    { dump_format, read_particles, "id type x y z" },
    { dump_format, read_particles, "id type x y z ix iy iz vx vy vz radius element" },
    { local_format, read_rows, nullptr },
    { euler_format, read_cells, nullptr },
    { decomposition_format, read_subdomains, nullptr },
    { restart_format, read_records, nullptr },
    { data_file_format, read_sections, nullptr },
  };
  const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("granular_mutate." + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  Session session;
  for (std::uint64_t copy = 0; copy < copies; ++copy)
  {
    for (std::size_t i = 0; i < files.size(); ++i)
    {
      // each copy by itself: one that is read alone is the same
      Random random(seed * 1'000'003 + copy * 10'007 + i);
      const std::string& other = contents[below(random, contents.size())];
      std::vector<std::string> paths;
      for (std::size_t pieces = below(random, 4) == 0 ? 2 : 1; paths.size() < pieces;)
      {
        const std::string number = std::to_string(paths.size());
        paths.push_back((folder / ("a." + number + files[i].extension().string())).string());
        std::ofstream(paths.back(), std::ios::binary) << damage(contents[i], other, random);
      }
      std::ofstream(folder / "last") << files[i].string() << " copy " << copy << "\n";
      for (Kind& kind : kinds)
      {
        read_files(kind, paths, random, session);
      }
    }
  }
  std::filesystem::remove_all(folder);
  std::printf("%zu files, %zu frames read, %zu refused\n", files.size() * copies, session.read,
    session.refused);
  return files.empty() || session.read == 0 ? 1 : 0;
}
