// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/update_files.h"

#include "granular/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <map>
#include <mutex>
#include <thread>

namespace granular
{
namespace
{
/// Sees to it that the seek points of all files take no more than there is for them, also while
/// they are found. In whatever order files are done, it keeps those of the first ones.
class RestartBudget
{
public:
  RestartBudget(std::vector<FileIndex>& files, std::size_t most)
    : files_(files)
    , most_(most)
    , end_(files.size())
  {
  }

  /// A file is done with.
  void take(std::size_t file)
  {
    if (!files_[file].points)
    {
      return;
    }
    const std::lock_guard lock(mutex_);
    kept_[file] = files_[file].points->bytes();
    bytes_ += kept_[file];
    while (!kept_.empty() && (bytes_ > most_ || std::prev(kept_.end())->first >= end_))
    {
      const auto last = std::prev(kept_.end());
      end_ = std::min(end_, last->first);
      bytes_ -= last->second;
      files_[last->first].points.reset();
      kept_.erase(last);
    }
  }

private:
  std::vector<FileIndex>& files_;
  std::size_t most_;
  std::mutex mutex_;
  std::map<std::size_t, std::size_t> kept_; ///< bytes by file
  std::size_t bytes_ = 0;                   ///< of them
  std::size_t end_;                         ///< from this file on none are kept
};

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
  RestartBudget budget(files, most_seek_bytes);
  FilesProgress all(progress, files.size());
  const auto update = [&](std::size_t file, std::size_t)
  {
    update_file_index(files[file], column_names, all, ahead);
    budget.take(file);
    all.finish_file();
  };
  executor.parallel_for(files.size(), update, all);
}
}
