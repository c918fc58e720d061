// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/file_index.h"

#include "granular/common/hash.h"
#include "granular/frames/other_files.h"

#include <algorithm>
#include <array>
#include <utility>

namespace granular
{
namespace
{
/// Returns true if the file only grew since it was indexed: the same file, and the ends of what it was are
/// still there. A run that starts over writes a new file of the same name, or into the same one:
/// one that changed and is as long as it was is not the same.
bool only_grew(const ByteSource& packed, const FileStamp& now, const FileIndex& index)
{
  const FileStamp& before = index.stamp;
  return before.inode == now.inode && before.device == now.device && now.size > before.size &&
    before.size > 0 && hash_ends(packed, before.size) == index.ends_hash;
}

bool others_changed(const FileIndex& index)
{
  return std::ranges::any_of(
    index.beside, [](const KnownFile& file) { return !(stamp_of(file.path) == file.stamp); });
}

/// Returns true if a source has bytes behind the last frame: an unfinished frame.
bool goes_on(const ByteSource& source, const FileIndex& index)
{
  char byte = 0;
  return source.read(index.frames.back().end, &byte, 1) > 0;
}

/// A file that was not indexed yet, of the same name and run.
FileIndex blank(const FileIndex& index)
{
  FileIndex fresh;
  fresh.path = index.path;
  fresh.kinds = index.kinds;
  fresh.format = index.format;
  return fresh;
}

/// The text behind the last frame that was kept is looked at each time that the file has grown: what
/// is wrong there is not said again.
void drop_repeated(Notices& notices, std::size_t known)
{
  const auto first_new = notices.begin() + static_cast<std::ptrdiff_t>(known);
  const auto repeated = [&](const Notice& notice)
  {
    return std::any_of(notices.begin(), first_new,
      [text = to_string(notice)](const Notice& said) { return to_string(said) == text; });
  };
  notices.erase(std::remove_if(first_new, notices.end(), repeated), notices.end());
}

/// Returns true if there are seek points, and all are starts of gzip members or Zstandard frames.
bool has_free_points(const FileIndex& index)
{
  const std::vector<SeekPoints::Point>& points = index.points->points;
  return !points.empty() &&
    std::ranges::all_of(
      points, [](const SeekPoints::Point& point) { return point.window.empty(); });
}

void update(FileIndex& index, const std::vector<std::string>& column_names, Progress& progress,
  const ScanAhead& ahead)
{
  std::unique_ptr<ByteSource> packed = open_file(index.path);
  const FileStamp stamp = packed->stamp();
  const bool renamed = (index.unnamed || index.error) && index.column_names != column_names;
  const bool anew = renamed || others_changed(index);
  if (index.stamp == stamp && !anew)
  {
    return;
  }
  if (anew || !only_grew(*packed, stamp, index))
  {
    index = blank(index);
  }
  std::erase_if(
    index.frames, [&](const FrameEntry& frame) { return frame.offset >= index.resume_offset; });
  index.stamp = stamp;
  index.error = nullptr;
  index.defect.reset();
  index.layout.reset();
  index.column_names = column_names;
  // what is appended meanwhile is for the next time: an end that moves on makes frames look cut
  packed = first_bytes(std::move(packed), stamp.size);
  index.ends_hash = hash_ends(*packed, stamp.size);
  if (!index.points)
  {
    index.points = std::make_shared<SeekPoints>();
  }
  else if (index.points.use_count() > 1)
  {
    index.points = std::make_shared<SeekPoints>(*index.points); // others read by them
  }
  const std::unique_ptr<ByteSource> source = unpack(std::move(packed), index.points);
  const std::size_t known = index.notices.size();
  index.compressed = source->compressed();
  if (index.frames.empty() && !index.format->reads_all)
  {
    refuse_other(*source, index.format->name, index.format->reads_vtk, !index.column_names.empty());
  }
  index.format->index(*source, index, progress, ahead);
  drop_repeated(index.notices, known);
  index.unchecked = source->unchecked();
  if (index.defect && !index.unchecked.empty())
  {
    index.defect->text += "; " + index.unchecked;
  }
  // a single frame is read from the start anyway: points serve several threads alone, and are kept where they take no memory
  if (!source->compressed() || index.frames.empty() ||
    (index.frames.size() == 1 && !goes_on(*source, index) && !has_free_points(index)))
  {
    index.points.reset();
  }
  index.frames.shrink_to_fit();
  if (index.frames.empty() || stamp.size == 0)
  {
    set_defect(index,
      { { index.path },
        std::string("expected ") + index.format->name + ", got " +
          (stamp.size == 0 ? "an empty file: its program has written nothing to it yet"
                           : "no complete frame") });
  }
}

/// Throws if the file is no longer the one that was indexed.
std::unique_ptr<ByteSource> open_packed(const FileIndex& index)
{
  std::unique_ptr<ByteSource> packed = open_file(index.path);
  const FileStamp now = packed->stamp();
  if (now.size < index.stamp.size)
  {
    throw IoError("the file was shortened since it was indexed: expected at least " +
        std::to_string(index.stamp.size) + " bytes, got " + std::to_string(now.size) +
        "; reload the files",
      { index.path });
  }
  if (!(now == index.stamp) && hash_ends(*packed, index.stamp.size) != index.ends_hash)
  {
    throw IoError("the file changed since it was indexed; reload the files", { index.path });
  }
  return packed;
}
}

void set_defect(FileIndex& index, const Notice& defect)
{
  if (!index.defect)
  {
    index.defect = defect;
  }
}

void forget_frames(FileIndex& index)
{
  index.frames.clear();
  index.beside.clear();
  index.defect.reset();
  index.resume_offset = 0;
  index.resume_line = 1;
}

void add_whole(FileIndex& index, FrameEntry entry, std::shared_ptr<const FileLayout> layout)
{
  entry.kind = index.kinds->share(FrameKind{});
  index.resume_offset = entry.end;
  index.layout = std::move(layout);
  index.frames.push_back(std::move(entry));
}

void leave_out(FileIndex& index, const Error& error)
{
  set_defect(index, { error.where(), error.text() });
  index.notices.push_back({ error.where(), error.text() + "; the file is left out" });
}

std::string first_bytes_of(const ByteSource& source)
{
  return read_up_to(source, 65536);
}

void update_file_index(FileIndex& index, const std::vector<std::string>& column_names,
  Progress& progress, const ScanAhead& ahead)
{
  const auto fail = [&](const FileStamp& stamp)
  {
    FileIndex failed = blank(index);
    failed.stamp = stamp;
    failed.column_names = column_names;
    failed.error = std::current_exception();
    index = std::move(failed);
  };
  try
  {
    update(index, column_names, progress, ahead);
  }
  catch (const IoError&)
  {
    fail({}); // the system may be in a better mood next time
  }
  catch (const Error&)
  {
    fail(index.stamp); // it is not read again until it changes
  }
  catch (...)
  {
    index = blank(index); // half of it would pass for all
    throw;
  }
}

void adopt(FileIndex& index)
{
  try
  {
    const std::unique_ptr<ByteSource> packed = open_file(index.path);
    const FileStamp here = packed->stamp();
    if (!(here == index.stamp) && here.size == index.stamp.size &&
      here.modified == index.stamp.modified && hash_ends(*packed, here.size) == index.ends_hash)
    {
      index.stamp = here;
    }
  }
  catch (const IoError&)
  {
    // who looks through the file tells the error
  }
}

bool is_changed(const FileIndex& index)
{
  return !(stamp_of(index.path) == index.stamp) || others_changed(index);
}

FileStamp stamp_of(const std::string& path)
{
  try
  {
    return open_file(path)->stamp();
  }
  catch (const IoError&)
  {
    return {};
  }
}

std::unique_ptr<ByteSource> open_indexed(const FileIndex& index)
{
  return unpack_known(open_packed(index), index.points);
}

std::unique_ptr<ByteSource> open_indexed(
  const FileIndex& index, const FrameEntry& entry, int threads)
{
  std::unique_ptr<ByteSource> packed = open_packed(index);
  if (!index.points)
  {
    return unpack_known(std::move(packed), std::make_shared<const SeekPoints>());
  }
  std::unique_ptr<ByteSource> source =
    unpack_segments(packed, *index.points, entry.offset, entry.end, threads);
  return source ? std::move(source) : unpack_known(std::move(packed), index.points);
}

std::uint64_t hash_ends(const ByteSource& packed, std::int64_t size)
{
  constexpr std::int64_t block = 4096;
  std::array<char, block> bytes;
  Hash hash;
  for (const std::int64_t from : { std::int64_t{ 0 }, std::max(std::int64_t{ 0 }, size - block) })
  {
    const auto wanted = static_cast<std::size_t>(std::min(block, size - from));
    hash.add(bytes.data(), packed.read(from, bytes.data(), wanted));
  }
  return hash.value();
}
}
