// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/shared_indexes.h"

#include <chrono>

namespace granular
{
void SharedIndexes::add(const std::shared_ptr<const Files>& files)
{
  using namespace std::chrono;
  const std::int64_t settled =
    duration_cast<nanoseconds>((system_clock::now() - seconds(2)).time_since_epoch()).count();
  const std::lock_guard lock(mutex_);
  std::erase_if(places_, [](const auto& entry) { return entry.second.files.expired(); });
  for (std::size_t i = 0; i < files->size(); ++i)
  {
    const FileIndex& file = (*files)[i];
    if (!file.error && file.stamp.modified < settled)
    {
      places_[{ file.path, file.format }] = { files, i };
    }
  }
}

std::optional<FileIndex> SharedIndexes::find(
  const std::string& path, const FileFormat* format) const
{
  const std::lock_guard lock(mutex_);
  const auto found = places_.find({ path, format });
  const auto files = found == places_.end() ? nullptr : found->second.files.lock();
  if (!files)
  {
    return {};
  }
  FileIndex file = (*files)[found->second.number];
  file.told = 0; // to the user of the other run
  return file;
}
}
