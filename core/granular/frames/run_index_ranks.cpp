// SPDX-License-Identifier: BSD-3-Clause
// One index for all ranks.
#include "granular/common/hash.h"
#include "granular/common/pass.h"
#include "granular/frames/file_index_archive.h"
#include "granular/frames/frame_order.h"
#include "granular/frames/run_index.h"
#include "granular/frames/update_files.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
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
  const std::vector<std::string> came = ranks.all_gather(sent);
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
