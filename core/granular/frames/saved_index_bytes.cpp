// SPDX-License-Identifier: BSD-3-Clause
// An index file: a head, the kinds of frames, the files with their frames, a hash of all that.
// Numbers are as in memory; what another byte order or another version wrote is not read.
#include "granular/frames/saved_index.h"

#include "granular/common/hash.h"
#include "granular/common/pass.h"
#include "granular/frames/index_claims.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <span>
#include <utility>

namespace granular
{
namespace
{
/// What an index file begins with.
struct Head
{
  char magic[8] = { '\x89', 'G', 'I', 'D', 'X', '\r', '\n', '\x1a' };
  std::uint32_t byte_order = 0x01020304;
  /// To be raised with every change of what is written here, or of what it means: of the hashes, of
  /// how frames are found, of how columns become arrays.
  std::uint32_t version = 4;
};

/// A frame as it is kept.
struct FrameRecord
{
  std::int64_t timestep;
  std::int64_t rows;
  std::int64_t offset;
  std::int64_t end;
  std::int64_t line;
  double time;
  std::uint64_t shape;
  std::uint64_t kind; ///< index into the kinds of the index file
};
static_assert(sizeof(FrameRecord) == 64);

/// With the slash, as the user spells it; empty if there is none.
std::string folder_of(const std::string& path)
{
  return path.substr(0, path.rfind('/') + 1);
}

std::uint64_t hash_of(std::string_view bytes)
{
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

template <typename Archive, typename Points>
void visit_points(Archive& archive, Points& all)
{
  archive.number(all.spacing);
  archive.flag(all.claimed);
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
    archive.path(one.path);
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

/// The kinds of the frames of all files, numbered.
class KindTable
{
public:
  explicit KindTable(std::span<const FileIndex* const> files)
  {
    for (const FileIndex* file : files)
    {
      for (const FrameEntry& frame : file->frames)
      {
        this->number_of(*frame.kind);
      }
    }
  }

  std::uint64_t number_of(const FrameKind& kind)
  {
    const auto [place, added] = numbers_.try_emplace(&kind, kinds_.size());
    if (added)
    {
      kinds_.push_back(&kind);
    }
    return place->second;
  }

  void write(ArchiveWriter& out) const
  {
    out.list(kinds_,
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

private:
  std::vector<const FrameKind*> kinds_;
  std::map<const FrameKind*, std::uint64_t> numbers_;
};

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

void write_frames(ArchiveWriter& out, const std::vector<FrameEntry>& frames, KindTable& kinds)
{
  out.list(frames,
    [&](const FrameEntry& frame)
    {
      out.number(FrameRecord{ frame.timestep, frame.rows, frame.offset, frame.end, frame.line,
        frame.time, frame.shape, kinds.number_of(*frame.kind) });
    });
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
  check_claims(file);
  file.loaded = true;
}

/// The part of an index file between its head and the hash at its end, which are made sure of.
std::string_view body_of(std::string_view bytes)
{
  Head head;
  std::uint64_t hash = 0;
  if (bytes.size() < sizeof head + sizeof hash)
  {
    throw FormatError("expected at least " + std::to_string(sizeof head + sizeof hash) +
      " bytes, got " + std::to_string(bytes.size()));
  }
  std::memcpy(&head, bytes.data(), sizeof head);
  if (!begins_as_index(bytes))
  {
    throw FormatError("expected the first bytes of an index file, got others");
  }
  if (head.byte_order != Head().byte_order)
  {
    throw UnsupportedError("expected the byte order of this machine, got another");
  }
  if (head.version != Head().version)
  {
    throw UnsupportedError(
      "expected " + std::to_string(Head().version) + ", got " + std::to_string(head.version));
  }
  std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
  bytes.remove_suffix(sizeof hash);
  if (hash != hash_of(bytes))
  {
    throw FormatError("expected bytes that fit the hash at their end, got others");
  }
  return bytes.substr(sizeof head);
}

std::string encode(const std::vector<const FileIndex*>& files, const std::string& folder)
{
  ArchiveWriter out(folder);
  KindTable kinds(files);
  out.number(Head());
  kinds.write(out);
  out.list(files,
    [&](const FileIndex* file)
    {
      visit_file(out, *file);
      write_frames(out, file->frames, kinds);
    });
  out.number(hash_of(out.bytes));
  return std::move(out.bytes);
}
}

bool begins_as_index(std::string_view bytes) noexcept
{
  const Head head;
  return bytes.starts_with(std::string_view(head.magic, sizeof head.magic));
}

std::string encode_index(const std::vector<FileIndex>& files)
{
  std::vector<const FileIndex*> kept;
  for (const FileIndex& file : files)
  {
    if (!file.error)
    {
      kept.push_back(&file);
    }
  }
  return encode(kept, files.empty() ? "" : folder_of(files.front().path));
}

std::string encode_files(const std::vector<FileIndex>& files)
{
  std::vector<const FileIndex*> all(files.size());
  std::ranges::transform(files, all.begin(), [](const FileIndex& file) { return &file; });
  return encode(all, "");
}

std::vector<FileIndex> decode_index(
  std::string_view bytes, const std::string& first_file, const std::shared_ptr<FrameKinds>& kinds)
{
  ArchiveReader in(body_of(bytes), folder_of(first_file));
  const Kinds table = read_kinds(in, *kinds);
  std::vector<FileIndex> files;
  in.list(files,
    [&](FileIndex& file)
    {
      read_file(in, file, table);
      file.kinds = kinds;
    });
  require(in.ended(), "the end of the index file");
  return files;
}
}
