// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/euler/euler_file.h"

#include "granular/formats/euler/euler_dataset.h"
#include "granular/frames/file_index.h"
#include "granular/frames/named_steps.h"

#include <algorithm>
#include <set>
#include <utility>

namespace granular
{
namespace
{
bool none(std::string_view)
{
  return false;
}

/// Says what is wrong with a file; once, also if it is looked at again when it has grown.
void tell(FileIndex& index, const Notice& notice)
{
  const auto same = [&](const Notice& other) { return to_string(other) == to_string(notice); };
  if (std::ranges::none_of(index.notices, same))
  {
    index.notices.push_back(notice);
  }
}

void add_frame(LegacyVtk& file, const EulerDataset& dataset, FileIndex& index)
{
  add_whole(index,
    { .rows = dataset.cells,
      .offset = dataset.header.place.offset,
      .end = file.place().offset,
      .line = dataset.header.binary ? 0 : dataset.header.place.line },
    nullptr);
  if (file.at_header())
  {
    tell(index,
      { file.where(file.place()),
        "expected the end of the file behind Euler cells, got another header; what follows is left "
        "out" });
  }
}

/// A file is one frame, and looked at from its beginning: arrays may have come.
void index_euler(const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead&)
{
  forget_frames(index);
  LegacyVtk file(source, {}, LegacyVtk::no_end, progress);
  if (!file.at_header() && file.at_end())
  {
    return;
  }
  const auto leave_out = [&](const Error& error)
  {
    set_defect(index, { error.where(), error.text() });
    if (!file.ended()) // else it may still be growing
    {
      tell(index, { error.where(), error.text() + "; the frame is left out" });
    }
  };
  try
  {
    EulerDataset dataset;
    read_dataset(file, EulerRead::Names, none, dataset);
    add_frame(file, dataset, index);
  }
  catch (const FormatError& error)
  {
    leave_out(error);
  }
  catch (const LimitError& error)
  {
    leave_out(error);
  }
}

bool look_at(const ByteSource& source)
{
  Progress progress;
  LegacyVtk file(source, {}, LegacyVtk::no_end, progress);
  if (!file.at_header())
  {
    return false;
  }
  EulerDataset dataset;
  try
  {
    read_dataset(file, EulerRead::Look, none, dataset);
  }
  catch (const FormatError&)
  {
    if (dataset.header.dataset.empty())
    {
      return dataset.has_title() && file.ended();
    }
  }
  return dataset.is_euler() || dataset.may_become_euler();
}
}

const FileFormat& euler_format() noexcept
{
  static constexpr FileFormat format = { .name = "a file of Euler cells",
    .index = &index_euler,
    .complete = &name_steps,
    .reads_vtk = true };
  return format;
}

bool is_euler_file(const std::string& path) noexcept
{
  return looks_so(path, [](const ByteSource& source) { return look_at(source); });
}

EulerFrame read_euler(const ByteSource& source, const FrameEntry& entry,
  const std::function<bool(std::string_view)>& wanted, Notices& notices, Progress& progress)
{
  LegacyVtk file(source, { entry.offset, entry.line }, entry.end, progress);
  EulerDataset dataset;
  read_dataset(file, EulerRead::Values, wanted, dataset);
  const Where where = file.where(dataset.header.place);
  check_cells(entry, dataset.cells, where);
  if (!dataset.texts.empty())
  {
    notices.push_back({ where,
      "expected arrays of numbers, got " + std::to_string(dataset.texts.size()) +
        " of text, which are left out: the first is '" + dataset.texts.front() + "'" });
  }
  return std::move(dataset.frame);
}

namespace
{
/// Adds the cells of one frame to another, with the arrays that both have. Others are left out, and their names noted.
void append(EulerFrame& all, const EulerFrame& more, std::set<std::string>& lost)
{
  const auto find = [](const EulerFrame& frame, const EulerValues& array)
  {
    return std::ranges::find_if(frame.arrays,
      [&](const EulerValues& other)
      { return other.name == array.name && other.components == array.components; });
  };
  for (const EulerValues& array : more.arrays)
  {
    if (find(all, array) == all.arrays.end())
    {
      lost.insert(array.name);
    }
  }
  std::erase_if(all.arrays,
    [&](EulerValues& array)
    {
      const auto same = find(more, array);
      if (same == more.arrays.end())
      {
        lost.insert(array.name);
        return true;
      }
      array.values.insert(array.values.end(), same->values.begin(), same->values.end());
      return false;
    });
  all.centres.insert(all.centres.end(), more.centres.begin(), more.centres.end());
  all.cells += more.cells;
  for (std::vector<double>& faces : all.faces)
  {
    faces.clear();
  }
}
}

EulerFrame read_euler_pieces(const std::vector<FramePiece>& pieces,
  const std::function<bool(std::string_view)>& wanted, int /*threads*/, Notices& notices,
  Progress& progress)
{
  EulerFrame all;
  std::set<std::string> lost;
  for (const FramePiece& piece : pieces)
  {
    EulerFrame frame =
      read_euler(*open_indexed(piece.file), piece.entry, wanted, notices, progress);
    if (all.cells == 0)
    {
      all = std::move(frame);
    }
    else if (frame.cells > 0) // else it may have no arrays
    {
      append(all, frame, lost);
    }
  }
  for (const std::string& name : lost)
  {
    notices.push_back({ where_of(pieces.front().file.path, pieces.front().entry),
      "the array '" + name + "' is not in all files of the timestep, and left out" });
  }
  return all;
}

std::vector<std::string> euler_array_names(
  const ByteSource& source, const FrameEntry& entry, Progress& progress)
{
  LegacyVtk file(source, { entry.offset, entry.line }, entry.end, progress);
  EulerDataset dataset;
  read_dataset(file, EulerRead::Names, none, dataset);
  check_cells(entry, dataset.cells, file.where(dataset.header.place));
  return std::move(dataset.names);
}
}
