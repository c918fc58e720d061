// SPDX-License-Identifier: BSD-3-Clause
// One index for all ranks.
#include "granular/common/archive.h"
#include "granular/common/hash.h"
#include "granular/frames/run_index.h"
#include "granular/frames/shared_indexes.h"
#include "granular/frames/update_files.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
std::string pack(const std::vector<std::string>& names)
{
  ArchiveWriter out;
  out.list(names, [&](const std::string& name) { out.text(name); });
  return std::move(out.bytes);
}

std::vector<std::string> unpack_names(std::string_view bytes)
{
  ArchiveReader in(bytes);
  std::vector<std::string> names;
  in.list(names, [&](std::string& name) { in.text(name); });
  return names;
}

/// Whether all that is known of a file can be sent, and nothing is wrong with it that rank 0 should say.
bool may_be_sent(const FileIndex& file)
{
  return file.shareable && !file.error && !file.defect && !file.layout && file.beside.empty() &&
    !file.frames.empty();
}

/// Whether rank 0 sees the file as the rank that looked through it. Devices and inodes may have other numbers there.
bool is_same_here(FileIndex& file)
{
  try
  {
    const std::unique_ptr<ByteSource> packed = open_file(file.path);
    const FileStamp here = packed->stamp();
    const bool same = here.size == file.stamp.size && here.modified == file.stamp.modified &&
      hash_ends(*packed, here.size) == file.ends_hash;
    file.stamp = here;
    return same;
  }
  catch (const IoError&)
  {
    return false;
  }
}

/// Looks through every so many of the files. Returns, on rank 0, what all ranks have found.
std::vector<FileIndex> look_together(const std::vector<std::string>& names,
  const IndexOptions& options, Communicator& ranks, Progress& progress)
{
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto size = static_cast<std::size_t>(ranks.size());
  const auto kinds = std::make_shared<FrameKinds>();
  std::vector<FileIndex> files;
  for (std::size_t i = rank; i < names.size(); i += size)
  {
    FileIndex& file = files.emplace_back();
    file.path = names[i];
    file.kinds = kinds;
    file.format = options.format;
    file.largest_expansion = options.largest_expansion;
  }
  constexpr std::size_t most_seek_bytes = std::size_t{ 1 } << 28; // of all ranks
  update_files(files, options.column_names, options.threads, progress, most_seek_bytes / size);
  std::erase_if(files, [](const FileIndex& file) { return !may_be_sent(file); });
  const std::string sent = rank == 0 ? "" : encode_files(files);
  std::vector<std::int64_t> counts(size);
  counts[0] = static_cast<std::int64_t>(sent.size());
  const std::vector<std::int64_t> come = swap_numbers(counts, ranks);
  const std::vector<char> parts = trade(sent, counts, come, ranks);
  const char* part = parts.data();
  for (const std::int64_t bytes : come)
  {
    const auto length = static_cast<std::size_t>(bytes);
    std::vector<FileIndex> of_rank;
    if (length > 0)
    {
      of_rank = decode_index({ part, length }, "", kinds);
    }
    for (FileIndex& file : of_rank)
    {
      file.loaded = false;
      file.shareable = true;
      file.format = options.format;
      file.largest_expansion = options.largest_expansion;
      if (is_same_here(file))
      {
        files.push_back(std::move(file));
      }
    }
    part += length;
  }
  return files;
}
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
        SharedIndexes of_ranks;
        std::shared_ptr<const std::vector<FileIndex>> looked;
        IndexOptions own = options;
        own.shared = options.shared ? options.shared : &of_ranks;
        if (ranks.size() > 1 && options.format != nullptr && options.format->large_runs)
        {
          std::vector<std::string> names = looks ? index.unknown_files(files, options) : files;
          std::string bytes =
            looks && names.size() > 1 ? pack(names) : ""; // one is nothing to share
          ranks.broadcast(bytes, 0);
          if (!bytes.empty())
          {
            parts.set_part(0, 0.95);
            looked = std::make_shared<const std::vector<FileIndex>>(
              look_together(unpack_names(bytes), options, ranks, parts));
            own.shared->add(looked);
            parts.set_part(0.95, 1);
          }
        }
        std::string bytes; // empty: nothing is new
        if (looks)
        {
          index.update(files, own, notices, parts);
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
    index.series_ = {};
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
