// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/input_files.h"

#include "granular/parallel/communicator.h"

#include <algorithm>
#include <utility>

namespace granular
{
namespace
{
/// Returns true if a file of a run is that of a stamp or a name.
bool is_same(const FileIndex& file, const FileStamp& stamp, const std::string& path)
{
  return file.path == path ||
    (file.stamp.device == stamp.device && file.stamp.inode == stamp.inode);
}

/// Returns the files whose frames have their other pieces in other files.
std::set<const FileIndex*> find_pieces(const RunIndex& index)
{
  std::set<const FileIndex*> files;
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    const std::vector<FramePiece> pieces = index.pieces(frame);
    for (const FramePiece& piece : pieces)
    {
      if (pieces.size() > 1)
      {
        files.insert(&piece.file);
      }
    }
  }
  return files;
}
}

void InputFiles::add(const RunIndex& index)
{
  const bool known = std::ranges::any_of(
    runs_, [&](const Run& run) { return &run.index.files() == &index.files(); });
  if (!known)
  {
    runs_.push_back({ index, {} });
  }
}

bool InputFiles::has(const std::string& path) const
{
  const FileStamp stamp = runs_.empty() ? FileStamp{} : stamp_of(path);
  if (stamp == FileStamp{})
  {
    return false;
  }
  bool found = false;
  for (Run& run : runs_)
  {
    const auto file = std::ranges::find_if(
      run.index.files(), [&](const FileIndex& each) { return is_same(each, stamp, path); });
    if (file == run.index.files().end())
    {
      continue;
    }
    found = true;
    if (!run.pieces)
    {
      run.pieces = find_pieces(run.index);
    }
    const std::string why = file->defect
      ? "a frame of it is not complete: " + to_string(*file->defect)
      : std::string(run.pieces->contains(&*file) ? "other files have the rest of its frames" : "");
    if (!why.empty())
    {
      throw Error("expected another file to write, got one that is read, and " + why, { path });
    }
  }
  return found;
}

bool HeldFiles::is_read(const std::string& path, Communicator& ranks) const
{
  if (inputs_ == nullptr)
  {
    return false;
  }
  std::int64_t found = inputs_->has(path) ? 1 : 0;
  ranks.sum({ &found, 1 });
  return found > 0;
}

bool HeldFiles::finish(std::unique_ptr<NewFile> file, bool durable)
{
  if (inputs_ == nullptr || !inputs_->has(file->path()))
  {
    file->finish(durable);
    return true;
  }
  // a later frame of the same file takes the place of the one before
  std::erase_if(held_, [&](const auto& other) { return other->target() == file->target(); });
  file->hold(durable);
  held_.push_back(std::move(file));
  return false;
}

void HeldFiles::finish_all(bool durable)
{
  for (const std::unique_ptr<NewFile>& file : held_)
  {
    file->expect_name();
  }
  for (const std::unique_ptr<NewFile>& file : held_)
  {
    file->finish(durable);
  }
  held_.clear();
}
}
