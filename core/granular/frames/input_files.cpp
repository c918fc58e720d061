// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/input_files.h"

#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"

#include <set>

namespace granular
{
namespace
{
std::pair<std::uint64_t, std::uint64_t> identity_of(const FileStamp& stamp)
{
  return { stamp.device, stamp.inode };
}

/// The files whose frames have their other pieces in other files.
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
  const std::set<const FileIndex*> pieces = find_pieces(index);
  for (const FileIndex& file : index.files())
  {
    if (const FileStamp stamp = stamp_of(file.path); stamp != FileStamp{}) // it may be gone
    {
      files_[identity_of(stamp)] = file.defect
        ? "a frame of it is not complete: " + to_string(*file.defect)
        : std::string(pieces.contains(&file) ? "other files have the rest of its frames" : "");
    }
  }
}

bool InputFiles::has(const std::string& path) const
{
  if (files_.empty())
  {
    return false;
  }
  const auto found = files_.find(identity_of(stamp_of(path)));
  if (found != files_.end() && !found->second.empty())
  {
    throw Error(
      "expected another file to write, got one that is read, and " + found->second, { path });
  }
  return found != files_.end();
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
  file->hold(durable);
  held_.push_back(std::move(file));
  return false;
}

void HeldFiles::finish_all(bool durable)
{
  for (const std::unique_ptr<NewFile>& file : held_)
  {
    file->finish(durable);
  }
  held_.clear();
}
}
