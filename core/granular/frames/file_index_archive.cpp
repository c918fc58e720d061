// SPDX-License-Identifier: BSD-3-Clause
// The kinds of frames, then the files with their frames. Numbers are as in memory.
#include "granular/frames/file_index_archive.h"

#include "granular/common/pass.h"

#include <algorithm>
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
}
