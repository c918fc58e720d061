// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/update_files.h"

#include "granular/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <set>
#include <thread>

namespace granular
{
namespace
{
/// Progress of all files together. The caller's thread reports that; the others only hear of it that they
/// should stop.
class FilesProgress final : public Progress
{
public:
  FilesProgress(Progress& progress, std::size_t files)
    : progress_(progress)
    , files_(static_cast<double>(std::max<std::size_t>(files, 1)))
  {
  }

  void finish_file() { ++finished_; }

  /// fraction: of the file that the caller's thread is at, or less where it begins one.
  bool report(double fraction) override
  {
    if (std::this_thread::get_id() == caller_)
    {
      const auto finished = static_cast<double>(finished_.load());
      stop_ = !progress_.report(std::min(1.0, (finished + fraction) / files_));
    }
    return !stop_;
  }

private:
  PartialProgress progress_; // which never goes back, as the fraction of a file may
  double files_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<std::size_t> finished_ = 0;
  std::atomic<bool> stop_ = false;
};
}

void update_files(std::vector<FileIndex>& files, const std::vector<std::string>& column_names,
  int threads, Progress& progress, std::size_t most_seek_bytes)
{
  const Executor executor(threads);
  ScanAhead ahead;
  ahead.threads = executor.threads() / static_cast<int>(executor.workers(files.size()));
  FilesProgress all(progress, files.size());
  std::mutex mutex;
  std::set<std::size_t> kept;          // files with seek points
  std::size_t bytes = 0;               // of these points
  std::size_t end_kept = files.size(); // from this file on none are kept
  // in whatever order files are done, the points of the first ones stay, and there is never more than one file too many
  const auto keep_points = [&](std::size_t file)
  {
    const std::lock_guard lock(mutex);
    if (files[file].points)
    {
      kept.insert(file);
      bytes += files[file].points->bytes();
    }
    while (!kept.empty() && (bytes > most_seek_bytes || *kept.rbegin() >= end_kept))
    {
      const std::size_t last = *kept.rbegin();
      end_kept = std::min(end_kept, last);
      bytes -= files[last].points->bytes();
      files[last].points.reset();
      kept.erase(last);
    }
  };
  const auto update = [&](std::size_t file, std::size_t)
  {
    update_file_index(files[file], column_names, all, ahead);
    keep_points(file);
    all.finish_file();
  };
  executor.parallel_for(files.size(), update, all);
}
}
