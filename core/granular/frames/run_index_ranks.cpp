// SPDX-License-Identifier: BSD-3-Clause
// One index for all ranks: the kinds of frames, then the files with their frames, then their order. Numbers are as in memory.
#include "granular/common/hash.h"
#include "granular/common/pass.h"
#include "granular/frames/run_index.h"
#include "granular/frames/run_index_parts.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
template <typename Archive, typename Points>
void visit_points(Archive& archive, Points& all)
{
  archive.number(all.spacing);
  archive.list(all.points,
    [&](auto& point)
    {
      archive.number(point.offset);
      archive.number(point.packed);
      archive.number(point.bits);
      archive.number(point.check);
      archive.number(point.member_bytes);
      archive.text(point.window);
    });
}

/// All of a frame but its kind.
template <typename Archive, typename Frame>
void visit_frame(Archive& archive, Frame& frame)
{
  archive.number(frame.timestep);
  archive.number(frame.rows);
  archive.number(frame.offset);
  archive.number(frame.end);
  archive.number(frame.line);
  archive.number(frame.time);
  archive.number(frame.shape);
}

/// All of a file; visit_kind: for the kind of each frame.
template <typename Archive, typename File, typename VisitKind>
void visit_file(Archive& archive, File& file, const VisitKind& visit_kind)
{
  const auto known = [&](auto& one)
  {
    archive.text(one.path);
    archive.number(one.stamp);
  };
  known(file);
  archive.number(file.ends_hash);
  archive.number(file.resume_offset);
  archive.number(file.resume_line);
  archive.text(file.units);
  archive.text(file.unchecked);
  pass(archive, file.notices);
  archive.perhaps(file.defect, [&](auto& said) { pass(archive, said); });
  archive.flag(file.unnamed);
  archive.flag(file.compressed);
  pass(archive, file.column_names);
  archive.list(file.beside, known);
  archive.perhaps(file.points, [&](auto& points) { visit_points(archive, points); });
  archive.list(file.frames,
    [&](auto& frame)
    {
      visit_frame(archive, frame);
      visit_kind(frame.kind);
    });
}

/// All of a kind but its columns.
template <typename Archive, typename Kind>
void visit_kind(Archive& archive, Kind& kind)
{
  archive.text(kind.units);
  archive.number(kind.layout);
  archive.flag(kind.named);
  archive.flag(kind.guessed);
}

using KindList = std::vector<const FrameKind*>;

KindList list_kinds(const std::vector<FileIndex>& files)
{
  KindList kinds;
  for (const FileIndex& file : files)
  {
    for (const FrameEntry& frame : file.frames)
    {
      if (std::ranges::find(kinds, frame.kind.get()) == kinds.end()) // they are few
      {
        kinds.push_back(frame.kind.get());
      }
    }
  }
  return kinds;
}

/// Columns are sent as their names and the numbers of unknown ones with texts: their types follow from these.
void write_kinds(ArchiveWriter& out, const KindList& kinds)
{
  out.list(kinds,
    [&](const FrameKind* kind)
    {
      std::vector<std::string> names;
      std::vector<std::int32_t> texts;
      for (const ColumnInfo& column : kind->schema.columns())
      {
        if (!column.known && column.type == ValueType::Text)
        {
          texts.push_back(static_cast<std::int32_t>(names.size()));
        }
        names.push_back(column.name);
      }
      visit_kind(out, *kind);
      pass(out, names);
      pass(out, texts);
    });
}

using Kinds = std::vector<std::shared_ptr<const FrameKind>>;

Kinds read_kinds(ArchiveReader& in, FrameKinds& store)
{
  Kinds kinds;
  in.list(kinds,
    [&](std::shared_ptr<const FrameKind>& shared)
    {
      FrameKind kind;
      std::vector<std::string> names;
      std::vector<std::int32_t> texts;
      visit_kind(in, kind);
      pass(in, names);
      pass(in, texts);
      require(kind.layout >= FrameKind::bare, "a layout of frames");
      require(!names.empty() || kind.is_text(), "a column"); // other files have none
      kind.schema = kind.is_text() ? ColumnSchema(names) : binary_schema(names);
      std::vector<ColumnSchema::TypeChange> types;
      for (const std::int32_t column : texts)
      {
        require(kind.is_text() && column >= 0 && column < std::ssize(names) &&
            !kind.schema.columns()[static_cast<std::size_t>(column)].known,
          "a column of texts");
        types.push_back({ column, ValueType::Text });
      }
      kind.schema.set_types(types);
      shared = store.share(std::move(kind));
    });
  return kinds;
}
void write_order(ArchiveWriter& out, const FrameOrder& order)
{
  pass(out, order.places);
  pass(out, order.starts);
}

/// files must be the same files as before. Throws FormatError.
FrameOrder read_order(ArchiveReader& in, const std::vector<FileIndex>& files)
{
  FrameOrder order;
  pass(in, order.places);
  pass(in, order.starts);
  const auto is_there = [&](const FrameOrder::Place& place)
  { return place.file < files.size() && place.frame < files[place.file].frames.size(); };
  require(std::ranges::all_of(order.places, is_there), "a frame that is there");
  const auto& starts = order.starts;
  const auto not_before = [](std::uint32_t a, std::uint32_t b) { return a >= b; };
  require(!starts.empty() && starts.front() == 0 && starts.back() == order.places.size() &&
      std::ranges::adjacent_find(starts, not_before) == starts.end(),
    "a piece for each frame");
  return order;
}

/// Returns true if all that is known of a file can be sent.
bool may_be_sent(const FileIndex& file)
{
  return !file.error && !file.layout && file.beside.empty();
}

/// Looks through every so many of the files. Returns, on rank 0, what all ranks have found.
std::vector<FileIndex> look_together(const std::vector<std::string>& names,
  const IndexOptions& options, const std::shared_ptr<FrameKinds>& kinds, Communicator& ranks,
  Progress& progress)
{
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto size = static_cast<std::size_t>(ranks.size());
  std::vector<FileIndex> files;
  for (std::size_t i = rank; i < names.size(); i += size)
  {
    FileIndex& file = files.emplace_back();
    file.path = names[i];
    file.kinds = kinds;
    file.format = options.format;
  }
  constexpr std::size_t most_seek_bytes = std::size_t{ 1 } << 28; // of all ranks
  update_files(files, options.column_names, options.threads, progress,
    most_seek_bytes / std::min(size, names.size()));
  const std::size_t own = files.size();
  std::string sent;
  if (rank > 0)
  {
    std::erase_if(files, [](const FileIndex& file) { return !may_be_sent(file); });
    sent = encode_files(files);
  }
  const std::vector<std::string> came =
    ranks.all_gather(sent); // all get the whole index soon, anyway
  if (rank == 0)
  {
    for (std::size_t other = 1; other < size; ++other)
    {
      std::ranges::move(decode_files(came[other], kinds), std::back_inserter(files));
    }
    Executor(options.threads)
      .parallel_for(
        files.size() - own, [&](std::size_t file, std::size_t) { adopt(files[own + file]); },
        progress);
  }
  return files;
}
}

std::string encode_files(const std::vector<FileIndex>& files)
{
  ArchiveWriter out;
  const KindList kinds = list_kinds(files);
  write_kinds(out, kinds);
  const auto write_kind = [&](const std::shared_ptr<const FrameKind>& kind)
  { out.count(static_cast<std::size_t>(std::ranges::find(kinds, kind.get()) - kinds.begin())); };
  out.list(files, [&](const FileIndex& file) { visit_file(out, file, write_kind); });
  return std::move(out.bytes);
}

std::vector<FileIndex> decode_files(
  std::string_view bytes, const std::shared_ptr<FrameKinds>& kinds)
{
  ArchiveReader in(bytes);
  const Kinds table = read_kinds(in, *kinds);
  const auto read_kind = [&](std::shared_ptr<const FrameKind>& kind)
  {
    std::uint64_t number = 0;
    in.number(number);
    require(number < table.size(), "a kind of frames");
    kind = table[static_cast<std::size_t>(number)];
  };
  std::vector<FileIndex> files;
  in.list(files,
    [&](FileIndex& file)
    {
      visit_file(in, file, read_kind);
      file.kinds = kinds;
    });
  require(in.ended(), "the end of the index");
  return files;
}

std::string RunIndex::encode() const
{
  ArchiveWriter out;
  out.text(encode_files(*files_));
  write_order(out, order_ ? *order_ : FrameOrder());
  return std::move(out.bytes);
}

void RunIndex::decode(std::string_view bytes)
{
  ArchiveReader in(bytes);
  RunIndex index;
  std::string bytes_of_files;
  in.text(bytes_of_files);
  std::vector<FileIndex> files = decode_files(bytes_of_files, std::make_shared<FrameKinds>());
  index.order_ = std::make_shared<const FrameOrder>(read_order(in, files));
  index.files_ = std::make_shared<const std::vector<FileIndex>>(std::move(files));
  index.scanned_ = index.files_;
  require(in.ended(), "the end of the index");
  *this = std::move(index);
}

void update_run_index(RunIndex& index, Communicator& ranks, const std::vector<std::string>& files,
  const IndexOptions& options, Notices& notices, Progress& progress)
{
  const bool looks = ranks.rank() == 0;
  try
  {
    do_together(ranks, // or rank 0 would believe that all have it
      [&]
      {
        SharedProgress shared(progress, ranks);
        PartialProgress parts(shared);
        std::vector<FileIndex> of_ranks;
        if (ranks.size() > 1 && options.format != nullptr && options.format->large_runs)
        {
          std::vector<std::string> names;
          if (looks)
          {
            names = index.unknown_files(files);
          }
          ArchiveWriter out;
          pass(out, names);
          std::string bytes =
            names.size() > 1 ? std::move(out.bytes) : ""; // one is nothing to share
          ranks.broadcast(bytes, 0);
          if (!bytes.empty())
          {
            ArchiveReader in(bytes);
            pass(in, names);
            parts.set_part(0, 0.9);
            of_ranks = look_together(names, options, index.kinds(), ranks, parts);
            parts.set_part(0.9, 1);
          }
        }
        std::string bytes; // empty: nothing is new
        if (looks)
        {
          index.update(files, options, std::move(of_ranks), notices, parts);
          bytes = ranks.size() > 1 ? index.encode() : "";
          Hash hash;
          hash.add(bytes.data(), bytes.size());
          bytes = hash.value() == index.shared_ ? "" : std::move(bytes);
          index.shared_ = hash.value();
        }
        ranks.broadcast(bytes, 0);
        if (!looks && !bytes.empty())
        {
          index.decode(bytes);
        }
      });
  }
  catch (...)
  {
    index.order_ = {};
    index.shared_ = 0;
    throw;
  }
}

bool is_changed(const RunIndex& index, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      std::int64_t changed = ranks.rank() == 0 && index.changed() ? 1 : 0;
      ranks.sum({ &changed, 1 });
      return changed != 0;
    });
}
}
