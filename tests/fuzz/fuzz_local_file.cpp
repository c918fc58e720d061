// SPDX-License-Identifier: BSD-3-Clause
// A file of local data, all the way: index, what the columns are, then the rows and lines of each frame; and the same bytes
// cut in two, as the files of two processes. Whatever the bytes are, there is an Error, or as many rows as the index says;
// and a file that grew is indexed as one that was always as long, if there is nothing to be said of it.
#include "dump_checks.h"

#include "granular/formats/local/local_file.h"
#include "granular/formats/local/local_reader.h"
#include "granular/lines/line_columns.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

using namespace granular;

namespace
{
/// Where the files of this process are, as long as it lives.
struct Folder
{
  std::filesystem::path path =
    std::filesystem::temp_directory_path() / ("fuzz_local_file." + std::to_string(getpid()));

  Folder() { std::filesystem::create_directories(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path); }
};

std::string write(const std::string& name, std::string_view text)
{
  static const Folder folder;
  const std::string path = (folder.path / name).string();
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

void index(std::string_view text, FileIndex& index)
{
  const auto source = open_memory(text);
  Progress progress;
  index.kinds = index.kinds ? index.kinds : std::make_shared<FrameKinds>();
  local_format().index(*source, index, progress, {});
  const auto size = static_cast<std::int64_t>(text.size());
  for (const FrameEntry& frame : index.frames)
  {
    require(frame.kind && frame.kind->is_text(), "the kind of a frame");
    require(
      frame.offset >= 0 && frame.offset <= frame.end && frame.end <= size, "the place of a frame");
    require(frame.rows >= 0 && frame.rows <= frame.end - frame.offset, "the rows of a frame");
  }
  require(index.resume_offset >= 0 && index.resume_offset <= size, "where to go on");
}

Table read(const RunIndex& run, std::size_t frame, const std::vector<std::string>& names,
  const Request& request)
{
  SerialCommunicator alone;
  Notices notices;
  Progress progress;
  return read_local(run.pieces(frame), names, request, alone, notices, progress);
}

/// Guesses names from the rows; where they tell nothing, from the columns alone.
std::vector<std::string> guess_names(const RunIndex& run, const FramePiece& first)
{
  std::vector<std::string> columns;
  std::ranges::transform(
    first.entry.kind->schema.columns(), std::back_inserter(columns), &ColumnInfo::name);
  Notices notices;
  Progress progress;
  try
  {
    const LocalSample sample = read_sample(run, *first.entry.kind, progress);
    const std::vector<std::string> names = find_columns(columns, sample, where_of(first), notices);
    require(names.size() == columns.size(), "a name for each column");
    return names;
  }
  catch (const Error&)
  {
    return name_columns(columns);
  }
}

/// As many values and ends of lines as rows; two parts have each row once.
void check(const RunIndex& run, std::size_t number)
{
  std::int64_t rows = 0;
  for (const FramePiece& piece : run.pieces(number))
  {
    rows += piece.entry.rows;
  }
  const std::vector<std::string> names = guess_names(run, run.first_piece(number));
  Request request;
  request.threads = 2;
  request.wanted = [](std::string_view, bool) { return true; };
  for (const auto periodic : { PeriodicLines::MinimumImage, PeriodicLines::Split })
  {
    request.periodic_lines = periodic;
    try
    {
      const Table frame = read(run, number, names, request);
      require(frame.rows == rows, "rows");
      for (const TableArray& array : frame.arrays)
      {
        const bool words = array.info.type == ValueType::Text;
        const std::size_t size = words ? sizeof(std::int32_t) : size_of(array.info.type);
        require(
          array.block.bytes() == static_cast<std::size_t>(rows) * array.info.columns.size() * size,
          "array");
      }
      const std::int64_t lines = frame.has_lines ? rows : 0;
      require(
        frame.lines.rows.empty() ? frame.lines.count == lines : frame.lines.count > lines, "lines");
      require(frame.lines.points.bytes() == static_cast<std::size_t>(frame.lines.count) * 48,
        "ends of lines");
      std::int64_t parts = 0;
      Request part = request;
      part.pieces = 2;
      for (part.piece = 0; part.piece < 2; ++part.piece)
      {
        parts += read(run, number, names, part).rows;
      }
      require(parts == rows, "rows of parts");
      part = request;
      part.pool = used_memory();
      const Table again = read(run, number, names, part);
      require(
        content_of({ &again }) == content_of({ &frame }), "what was read depends on the memory");
    }
    catch (const FormatError& error)
    {
      require(!error.where().path.empty(), "an error without a place");
    }
  }
}

void read_all(const std::vector<std::string>& files)
{
  RunIndex run;
  IndexOptions options;
  options.format = &local_format();
  Notices notices;
  Progress progress;
  try
  {
    run.update(files, options, notices, progress);
    for (std::size_t frame = 0; frame < run.size(); ++frame)
    {
      check(run, frame);
    }
  }
  catch (const Error& error)
  {
    require(!error.where().path.empty(), "an error without a file");
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  FileIndex all;
  index(text, all);
  FileIndex grown; // as if the file had been half as long before
  index(text.substr(0, size / 2), grown);
  index(text, grown);
  // rows too many are seen once they are there: what was a frame before them stays one
  const bool good = !all.defect && all.notices.empty();
  require(!good || all.frames.size() == grown.frames.size(), "frames of a file that grew");
  read_all({ write("run.0.dump", text) });
  // a NUL ends the first of two files
  const std::size_t end = text.find('\0');
  if (end != text.npos)
  {
    read_all(
      { write("run.0.dump", text.substr(0, end)), write("run.1.dump", text.substr(end + 1)) });
  }
  return 0;
}
