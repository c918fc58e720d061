// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/frame_index.h"

#include "granular/dump/text_dump.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace granular
{
/// One file of the series and what is known of it.
struct FrameIndex::File
{
  FileStamp stamp;
  TextIndex index;
  std::exception_ptr error; ///< the file could not be opened or read
};

namespace
{
/// Whether the file only grew since it was indexed: the same file, and what was indexed last is
/// still there. A run that starts over writes a new file of the same name, or into the same one:
/// one that changed and is as long as it was is not the same.
bool only_grew(const ByteSource& source, const FileStamp& before, const FileStamp& now,
  const std::vector<FrameEntry>& frames)
{
  if (before.inode != now.inode || before.device != now.device || now.size <= before.size)
  {
    return false;
  }
  try
  {
    if (!frames.empty())
    {
      check_unchanged(source, frames.front());
      check_unchanged(source, frames.back());
    }
    return true;
  }
  catch (const IoError&)
  {
    return false; // changed: it is read anew
  }
}

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
}

FrameIndex::FrameIndex() = default;
FrameIndex::FrameIndex(FrameIndex&&) noexcept = default;
FrameIndex& FrameIndex::operator=(FrameIndex&&) noexcept = default;
FrameIndex::~FrameIndex() = default;

void FrameIndex::update(const std::vector<std::string>& files, Notices& notices, Progress& progress)
{
  std::map<std::string, File> known;
  for (std::size_t i = 0; i < paths_.size(); ++i)
  {
    known[paths_[i]] = std::move(records_[i]);
  }
  // if this is left by an exception, what is known so far is gone and will be read anew
  paths_.clear();
  records_.clear();
  frames_.clear();
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    progress.step(static_cast<double>(i) / static_cast<double>(files.size()));
    File file = std::move(known[files[i]]);
    FrameIndex::update_file(file, files[i], notices, progress);
    paths_.push_back(files[i]);
    records_.push_back(std::move(file));
  }
  this->collect(notices);
  if (frames_.empty())
  {
    this->fail();
  }
  for (const File& file : records_)
  {
    if (file.error)
    {
      notices.push_back(left_out(file.error));
    }
  }
}

void FrameIndex::update_file(
  File& file, const std::string& path, Notices& notices, Progress& progress)
{
  try
  {
    file.error = nullptr;
    const std::unique_ptr<ByteSource> source = open_file(path);
    const FileStamp stamp = source->stamp();
    if (stamp == file.stamp)
    {
      return;
    }
    if (!only_grew(*source, file.stamp, stamp, file.index.frames))
    {
      file.index = {};
    }
    file.index.notices.clear();
    file.index.defect.reset();
    index_text_dump(*source, file.index, progress);
    file.stamp = stamp;
    notices.insert(notices.end(), file.index.notices.begin(), file.index.notices.end());
    if (!file.index.defect)
    {
      file.index.defect = { { path },
        std::string("expected a dump, got ") +
          (stamp.size == 0 ? "an empty file" : "no complete frame") };
    }
  }
  catch (const Error&)
  {
    file = {};
    file.error = std::current_exception();
  }
}

/// Orders the frames of all files; of a repeated timestep the last stays.
void FrameIndex::collect(Notices& notices)
{
  for (std::size_t i = 0; i < records_.size(); ++i)
  {
    for (const FrameEntry& frame : records_[i].index.frames)
    {
      frames_.push_back(frame);
      frames_.back().file = i;
    }
  }
  const auto step = [](const FrameEntry& frame) { return frame.header.timestep; };
  std::ranges::stable_sort(frames_, {}, step);
  std::vector<FrameEntry> last;
  for (FrameEntry& frame : frames_)
  {
    if (!last.empty() && step(last.back()) == step(frame))
    {
      last.pop_back();
    }
    last.push_back(std::move(frame));
  }
  frames_ = std::move(last);
  this->note_hidden_files(notices);
  this->note_times(notices);
}

/// Says so if all frames of a file are hidden by those of later ones: a restart repeats a step or
/// two, but this is another run, or one file a process.
void FrameIndex::note_hidden_files(Notices& notices) const
{
  std::vector<bool> shown(records_.size());
  for (const FrameEntry& frame : frames_)
  {
    shown[frame.file] = true;
  }
  for (std::size_t i = 0; i < records_.size(); ++i)
  {
    if (!shown[i] && !records_[i].index.frames.empty())
    {
      notices.push_back(
        { { paths_[i] }, "no frame of this file is shown: later files have the same timesteps" });
    }
  }
}

/// Says so if only some frames have a time, or times that do not increase.
void FrameIndex::note_times(Notices& notices) const
{
  const auto has_time = [](const FrameEntry& frame) { return frame.header.time.has_value(); };
  if (std::ranges::any_of(frames_, has_time) && this->header_times().size() < frames_.size())
  {
    const bool all = std::ranges::all_of(frames_, has_time);
    notices.push_back({ { paths_[frames_.front().file] },
      std::string("expected an increasing ITEM: TIME in every frame, got ") +
        (all ? "one that does not increase" : "frames without") +
        "; times are timestep x TimestepSize" });
  }
}

void FrameIndex::fail() const
{
  if (records_.empty())
  {
    throw IoError("expected the name of a file, got none");
  }
  if (records_.front().error)
  {
    std::rethrow_exception(records_.front().error);
  }
  const Notice& defect = *records_.front().index.defect;
  throw FormatError(defect.text, defect.where);
}

/// The times of the headers, as far as they increase.
std::vector<double> FrameIndex::header_times() const
{
  std::vector<double> from_header;
  for (const FrameEntry& frame : frames_)
  {
    const std::optional<double>& time = frame.header.time;
    if (time && std::isfinite(*time) && (from_header.empty() || *time > from_header.back()))
    {
      from_header.push_back(*time);
    }
  }
  return from_header;
}

std::vector<double> FrameIndex::times(double timestep_size) const
{
  std::vector<double> from_header = this->header_times();
  if (from_header.size() == frames_.size())
  {
    return from_header;
  }
  std::vector<double> from_steps;
  for (const FrameEntry& frame : frames_)
  {
    from_steps.push_back(static_cast<double>(frame.header.timestep) * timestep_size);
  }
  return from_steps;
}

std::size_t FrameIndex::find(const std::vector<double>& times, double time) noexcept
{
  constexpr double tolerance = 1e-9; // of the distance between two frames
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  const auto next = static_cast<std::size_t>(after - times.begin());
  const bool nearly =
    next > 0 && after != times.end() && *after - time <= tolerance * (*after - times[next - 1]);
  return next == 0 || nearly ? next : next - 1;
}
}
