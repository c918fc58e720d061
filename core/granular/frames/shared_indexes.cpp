// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/shared_indexes.h"

namespace granular
{
namespace
{
bool may_be_shared(const FileIndex& file) noexcept
{
  // too many seek points for one run are few enough for another, which finds them anew
  const bool lacks_points = file.compressed && file.frames.size() > 1 && !file.points;
  return file.shareable && !lacks_points;
}
}

void SharedIndexes::add(const std::shared_ptr<const Files>& files)
{
  const std::lock_guard lock(mutex_);
  std::erase_if(places_, [](const auto& entry) { return entry.second.files.expired(); });
  for (std::size_t i = 0; i < files->size(); ++i)
  {
    const FileIndex& file = (*files)[i];
    if (may_be_shared(file))
    {
      places_.emplace(std::pair(file.path, file.format), Place{ files, i });
    }
  }
}

template <class Visit>
void SharedIndexes::visit_newest(
  const std::string& path, const FileFormat* format, const Visit& visit) const
{
  const std::lock_guard lock(mutex_);
  const auto [first, last] = places_.equal_range({ path, format });
  for (auto newest = last; newest != first;)
  {
    const Place& place = (--newest)->second;
    if (const auto files = place.files.lock())
    {
      visit((*files)[place.number]);
      return;
    }
  }
}

std::optional<FileIndex> SharedIndexes::find(
  const std::string& path, const FileFormat* format) const
{
  std::optional<FileIndex> found;
  this->visit_newest(path, format, [&](const FileIndex& file) { found = file; });
  if (found)
  {
    found->told = 0; // to the user of the other run
  }
  return found;
}

bool SharedIndexes::has(const std::string& path, const FileFormat* format) const
{
  bool has = false;
  this->visit_newest(path, format, [&](const FileIndex&) { has = true; });
  return has;
}
}
