// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/run_index.h"

#include "granular/frames/named_steps.h"
#include "granular/frames/run_index_parts.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

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

Notice left_out(const std::exception_ptr& error)
{
  try
  {
    std::rethrow_exception(error);
  }
  catch (const Error& e)
  {
    return { e.where(), e.text() + "; the file is left out" };
  }
}

/// See FileFormat::describe; nothing if it cannot be read.
std::string first_row_of(const FileIndex& file)
{
  const FrameEntry& entry = file.frames.front();
  try
  {
    return file.format->describe ? file.format->describe(*open_indexed(file), entry) : "";
  }
  catch (const Error&)
  {
    return {};
  }
}

/// LIGGGHTS' boxes lie beside dumps under a name that a pattern for these matches too.
bool is_beside(const std::string& path)
{
  return path.find("boundingBox", path.rfind('/') + 1) != path.npos;
}

/// The files that are looked at, in their order; of one that occurs again the last counts.
std::vector<std::string> distinct_dumps(const std::vector<std::string>& names)
{
  std::set<std::string_view> seen;
  std::vector<std::string> kept;
  for (auto name = names.rbegin(); name != names.rend(); ++name)
  {
    if (seen.insert(*name).second)
    {
      kept.push_back(*name);
    }
  }
  std::ranges::reverse(kept);
  if (!std::ranges::all_of(kept, is_beside))
  {
    std::erase_if(kept, is_beside);
  }
  return kept;
}

FramePiece piece_at(const std::vector<FileIndex>& files, const FrameOrder::Place& place)
{
  const FileIndex& file = files[place.file];
  return { file, file.frames[place.frame] };
}

/// The source of a piece, if it is open already.
std::shared_ptr<const ByteSource> lent_by(const FramePiece& piece)
{
  return { piece.source, [](const ByteSource*) {} };
}
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
  // also while they are found, there are no more than that; in whatever order files are done, the first ones keep theirs
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

std::shared_ptr<const ByteSource> open_piece(const FramePiece& piece)
{
  return piece.source ? lent_by(piece) : open_indexed(piece.file);
}

std::shared_ptr<const ByteSource> open_piece(const FramePiece& piece, int threads)
{
  return piece.source ? lent_by(piece) : open_indexed(piece.file, piece.entry, threads);
}

Where where_of(const FramePiece& piece)
{
  return where_of(piece.file.path, piece.entry);
}

void RunIndex::update(const std::vector<std::string>& files, const IndexOptions& options,
  Notices& notices, Progress& progress)
{
  this->update(files, options, {}, notices, progress);
}

void RunIndex::update(const std::vector<std::string>& files, const IndexOptions& options,
  std::vector<FileIndex>&& of_ranks, Notices& notices, Progress& progress)
{
  if (options.format == nullptr)
  {
    throw Error("expected the format of the files in the options, got none");
  }
  order_ = {};
  std::vector<FileIndex> updated =
    this->update_files(distinct_dumps(files), options, std::move(of_ranks), notices, progress);
  Notices found;
  scanned_ = std::make_shared<const std::vector<FileIndex>>(std::move(updated));
  files_ = scanned_;
  if (options.format->complete && (!options.format->lacks || options.format->lacks(*scanned_)))
  {
    updated = *scanned_;
    if (options.format->names_pieces && options.repeated_steps == RepeatedSteps::Merge)
    {
      mark_pieces(updated);
    }
    options.format->complete(updated, found);
    files_ = std::make_shared<const std::vector<FileIndex>>(std::move(updated));
  }
  order_ = std::make_shared<const FrameOrder>(order_frames(*files_, options.repeated_steps, found));
  if (this->size() == 0)
  {
    this->fail(found);
  }
  notices.insert(notices.end(), found.begin(), found.end());
  this->note_files(notices);
  this->note_times(notices);
}

std::vector<std::string> RunIndex::unknown_files(const std::vector<std::string>& files) const
{
  std::set<std::string_view> known;
  for (const FileIndex& file : *scanned_)
  {
    known.insert(file.path);
  }
  std::vector<std::string> unknown = distinct_dumps(files);
  std::erase_if(unknown, [&](const std::string& path) { return known.contains(path); });
  return unknown;
}

std::vector<FileIndex> RunIndex::update_files(const std::vector<std::string>& files,
  const IndexOptions& options, std::vector<FileIndex>&& of_ranks, Notices& notices,
  Progress& progress)
{
  std::vector<FileIndex> before = *scanned_; // a copy: who copied this index has them, too
  const std::shared_ptr<FrameKinds> kinds =
    of_ranks.empty() ? this->kinds() : of_ranks.front().kinds;
  // if this is left by an exception, what is known so far is gone and will be read anew
  files_ = scanned_ = std::make_shared<const std::vector<FileIndex>>();
  std::map<std::string, FileIndex> known;
  for (std::vector<FileIndex>* looked : { &before, &of_ranks })
  {
    for (FileIndex& file : *looked)
    {
      known.try_emplace(file.path, std::move(file));
    }
  }
  std::vector<FileIndex> updated(files.size());
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    if (const auto own = known.find(files[i]); own != known.end())
    {
      updated[i] = std::move(own->second);
    }
    updated[i].path = files[i];
    updated[i].kinds = kinds;
    updated[i].format = options.format;
  }
  granular::update_files(updated, options.column_names, options.threads, progress);
  for (FileIndex& file : updated)
  {
    notices.insert(notices.end(), file.notices.begin() + static_cast<std::ptrdiff_t>(file.told),
      file.notices.end());
    file.told = file.notices.size();
  }
  return updated;
}

std::shared_ptr<FrameKinds> RunIndex::kinds() const
{
  return scanned_->empty() ? std::make_shared<FrameKinds>() : scanned_->front().kinds;
}

bool RunIndex::changed() const
{
  return std::ranges::any_of(*files_, [](const FileIndex& file) { return is_changed(file); });
}

std::size_t RunIndex::size() const noexcept
{
  return order_ ? order_->size() : 0;
}

FramePiece RunIndex::first_piece(std::size_t frame) const
{
  return piece_at(*files_, order_->pieces(frame).front());
}

std::vector<FramePiece> RunIndex::pieces(std::size_t frame) const
{
  std::vector<FramePiece> pieces;
  for (const FrameOrder::Place place : order_->pieces(frame))
  {
    pieces.push_back(piece_at(*files_, place));
  }
  return pieces;
}

/// Says which files cannot be read or checked, and, once, that columns have names that are not in the file.
void RunIndex::note_files(Notices& notices) const
{
  for (const FileIndex& file : *files_)
  {
    if (file.error)
    {
      notices.push_back(left_out(file.error));
    }
    if (!file.unchecked.empty() && !file.frames.empty())
    {
      notices.push_back({ { file.path }, file.unchecked });
    }
  }
  const auto guessed = std::ranges::find_if(*files_,
    [](const FileIndex& file)
    {
      return !file.frames.empty() && file.frames.front().kind->guessed &&
        file.frames.front().kind->named;
    });
  if (guessed != files_->end())
  {
    notices.push_back({ { guessed->path },
      "set ColumnNames if the columns, which the file does not name, are others than " +
        guessed->frames.front().kind->schema.text() + first_row_of(*guessed) });
  }
}

/// Says so if only some frames have a time, or times that do not increase.
void RunIndex::note_times(Notices& notices) const
{
  const std::vector<FrameInstant> frames = this->instants();
  const auto has_time = [](const FrameInstant& frame) { return !std::isnan(frame.time); };
  if (std::ranges::any_of(frames, has_time) && !have_times(frames))
  {
    notices.push_back({ { this->first_piece(0).file.path },
      std::string("expected an increasing ITEM: TIME in every frame, got ") +
        (std::ranges::all_of(frames, has_time) ? "one that does not increase" : "frames without") +
        "; times are timestep x TimestepSize" });
  }
}

void RunIndex::fail(const Notices& notices) const
{
  if (files_->empty())
  {
    throw IoError("expected the name of a file, got none");
  }
  if (files_->front().error)
  {
    std::rethrow_exception(files_->front().error);
  }
  if (!notices.empty()) // pieces are missing, perhaps because a file cannot be read
  {
    const auto unread =
      std::ranges::find_if(*files_, [](const FileIndex& file) { return file.error != nullptr; });
    if (unread != files_->end())
    {
      std::rethrow_exception(unread->error);
    }
    throw FormatError(notices.front().text, notices.front().where);
  }
  const Notice defect = files_->front().defect.value_or(Notice{ { files_->front().path },
    std::string("expected ") + files_->front().format->name + ", got no complete frame" });
  throw FormatError(defect.text, defect.where);
}

std::vector<FrameInstant> RunIndex::instants() const
{
  std::vector<FrameInstant> frames;
  frames.reserve(this->size());
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    const FrameEntry& entry = this->first_piece(i).entry;
    frames.push_back({ entry.timestep, entry.time });
  }
  return frames;
}

std::vector<double> RunIndex::times(double timestep_size, Notices& notices) const
{
  return frame_times(this->instants(), timestep_size,
    this->size() > 0 ? this->first_piece(0).file.path : std::string(), notices);
}

std::vector<double> RunIndex::times(double timestep_size) const
{
  Notices told_elsewhere;
  return this->times(timestep_size, told_elsewhere);
}

std::size_t RunIndex::find(const std::vector<double>& times, double time) noexcept
{
  constexpr double tolerance = 1e-9; // of the distance between two frames
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  const auto next = static_cast<std::size_t>(after - times.begin());
  const bool nearly =
    next > 0 && after != times.end() && *after - time <= tolerance * (*after - times[next - 1]);
  return next == 0 || nearly ? next : next - 1;
}
}
