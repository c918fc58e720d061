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
/// A frame as it is sent.
struct FrameRecord
{
  std::int64_t timestep;
  std::int64_t rows;
  std::int64_t offset;
  std::int64_t end;
  std::int64_t line;
  double time;
  std::uint64_t shape;
  std::uint64_t kind; ///< index into the kinds
};
static_assert(sizeof(FrameRecord) == 64);

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

/// All of a file but its frames.
template <typename Archive, typename File>
void visit_file(Archive& archive, File& file)
{
  const auto notice = [&](auto& said) { pass(archive, said); };
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
  archive.list(file.notices, notice);
  archive.perhaps(file.defect, notice);
  archive.flag(file.unnamed);
  archive.flag(file.compressed);
  archive.list(file.column_names, [&](auto& name) { archive.text(name); });
  archive.list(file.beside, known);
  archive.perhaps(file.points, [&](auto& points) { visit_points(archive, points); });
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

void write_kinds(ArchiveWriter& out, const KindList& kinds)
{
  out.list(kinds,
    [&](const FrameKind* kind)
    {
      out.text(kind->units);
      out.number(std::int32_t{ kind->layout });
      out.flag(kind->named);
      out.flag(kind->guessed);
      out.list(kind->schema.columns(),
        [&](const ColumnInfo& column)
        {
          out.text(column.name);
          out.flag(!column.known && column.type == ValueType::Text);
        });
    });
}

/// A column; its type follows from the name, where that is known, and else from the first row.
struct KeptColumn
{
  std::string name;
  bool words = false;
};

ColumnSchema make_schema(const std::vector<KeptColumn>& columns, bool text)
{
  std::vector<std::string> names;
  for (const KeptColumn& column : columns)
  {
    names.push_back(column.name);
  }
  ColumnSchema schema(names);
  std::vector<ColumnSchema::TypeChange> types;
  for (const KeptColumn& column : columns)
  {
    const auto i = static_cast<int>(&column - columns.data());
    const ColumnInfo& info = schema.columns()[static_cast<std::size_t>(i)];
    require(!column.words || (text && !info.known), "a column of texts");
    if (column.words)
    {
      types.push_back({ i, ValueType::Text });
    }
    else if (info.known && info.type == ValueType::Text && !text)
    {
      types.push_back({ i, ValueType::Int32 }); // an element is written as its type
    }
  }
  schema.set_types(types);
  return schema;
}

using Kinds = std::vector<std::shared_ptr<const FrameKind>>;

Kinds read_kinds(ArchiveReader& in, FrameKinds& store)
{
  Kinds kinds;
  in.list(kinds,
    [&](std::shared_ptr<const FrameKind>& shared)
    {
      FrameKind kind;
      std::int32_t layout = 0;
      std::vector<KeptColumn> columns;
      in.text(kind.units);
      in.number(layout);
      in.flag(kind.named);
      in.flag(kind.guessed);
      in.list(columns,
        [&](KeptColumn& column)
        {
          in.text(column.name);
          in.flag(column.words);
        });
      require(layout >= FrameKind::bare, "a layout of frames");
      kind.layout = layout;
      require(!columns.empty() || kind.is_text(), "a column"); // other files have none
      kind.schema = make_schema(columns, kind.is_text());
      shared = store.share(std::move(kind));
    });
  return kinds;
}

void read_file(ArchiveReader& in, FileIndex& file, const Kinds& kinds)
{
  visit_file(in, file);
  in.list(file.frames,
    [&](FrameEntry& entry)
    {
      FrameRecord frame;
      in.number(frame);
      require(frame.kind < kinds.size(), "a kind of frames");
      entry = { frame.timestep, frame.rows, frame.offset, frame.end, frame.line, frame.time,
        frame.shape, kinds[static_cast<std::size_t>(frame.kind)] };
    });
}
}

std::string encode_files(const std::vector<FileIndex>& files)
{
  ArchiveWriter out;
  const KindList kinds = list_kinds(files);
  write_kinds(out, kinds);
  out.list(files,
    [&](const FileIndex& file)
    {
      visit_file(out, file);
      out.list(file.frames,
        [&](const FrameEntry& frame)
        {
          const auto kind = std::ranges::find(kinds, frame.kind.get()) - kinds.begin();
          out.number(FrameRecord{ frame.timestep, frame.rows, frame.offset, frame.end, frame.line,
            frame.time, frame.shape, static_cast<std::uint64_t>(kind) });
        });
    });
  return std::move(out.bytes);
}

std::vector<FileIndex> decode_files(
  std::string_view bytes, const std::shared_ptr<FrameKinds>& kinds)
{
  ArchiveReader in(bytes);
  const Kinds table = read_kinds(in, *kinds);
  std::vector<FileIndex> files;
  in.list(files,
    [&](FileIndex& file)
    {
      read_file(in, file, table);
      file.kinds = kinds;
    });
  require(in.ended(), "the end of the index");
  return files;
}
}
