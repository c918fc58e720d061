// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/vtk_series.h"

#include "granular/formats/vtk_files/vtk_surface.h"
#include "granular/frames/file_index.h"
#include "granular/frames/named_steps.h"
#include "granular/numbers/number_scan.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
bool holds(std::string_view text, std::string_view word)
{
  return text.find(word) != std::string_view::npos;
}

void index_vtk(const ByteSource& source, FileIndex& index, Progress&, const ScanAhead&)
{
  constexpr std::int64_t tail_bytes = 256;
  forget_frames(index);
  const std::int64_t size = source.stamp().size;
  const std::string head = read_up_to(source, 6);
  const std::string_view end = head.starts_with('<') ? "</VTKFile>"
    : head == "solid "                               ? "endsolid"
                                                     : "";
  std::string tail(tail_bytes, '\0');
  source.read(std::max(size - tail_bytes, std::int64_t{ 0 }), tail.data(), tail.size());
  if (!source.compressed() && !holds(tail, end))
  {
    set_defect(index,
      { { source.path() }, "expected " + std::string(end) + " at the end of the file, got none" });
  }
  else if (size > 0)
  {
    add_whole(index, { .end = size, .line = 1 }, nullptr);
  }
}

/// Frames of a family to which name_steps gives one timestep, by a number that counts ranks, are pieces.
void complete_vtk(std::vector<FileIndex>& files, Notices& notices)
{
  name_steps(files, notices);
  for (const auto& [rest, family] : families_of(files))
  {
    std::map<std::int64_t, FrameEntry*> first;
    for (const auto& [number, numbers] : family)
    {
      for (FrameEntry& frame : files[number].frames)
      {
        const auto [seen, is_new] = first.try_emplace(frame.timestep, &frame);
        frame.shape = is_new ? FrameEntry::whole : 1;
        seen->second->shape = frame.shape;
      }
    }
  }
}

bool has_number(const std::string& path)
{
  return !split_name(path).numbers.empty();
}

/// LIGGGHTS and LAMMPS write their names, unless the user gives another title.
bool is_title(std::string_view text)
{
  return holds(text, "LIGGGHTS") || holds(text, "LAMMPS");
}

bool is_legacy_particles(const ByteSource& source)
{
  Progress progress;
  LegacyVtk file(source, {}, LegacyVtk::no_end, progress);
  const VtkHeader header = file.read_header();
  const bool has_box = !find_box_file(source.path()).empty();
  if (header.dataset != vtk_points || !(has_box || is_title(header.title)))
  {
    return false; // large files of others are not read
  }
  file.go_to(header.place);
  const VtkSurface points = read_surface(file, SurfaceRead::None);
  return points.part_cells() == points.parts[0].size &&
    (points.cells > 0 ? points.has("id") : has_box);
}

/// The first array is `id`, of points without polygons; of blocks one is the box.
bool is_xml_particles(std::string_view head)
{
  constexpr std::string_view id = "Name=\"id\"";
  const std::size_t polygons = head.find("NumberOfPolys=\"");
  const bool bare = polygons == head.npos || head.substr(polygons + 15).starts_with("0\"");
  const std::size_t first = head.find("Name=\"", std::min(head.find("PointData"), head.size()));
  return holds(head, "<VTKFile") &&
    (holds(head, "name=\"Domain\"") ||
      (bare && first != head.npos && head.substr(first).starts_with(id)));
}
}

const FileFormat& vtk_format() noexcept
{
  static constexpr FileFormat format = { .name = "a VTK, STL or PLY file",
    .index = &index_vtk,
    .complete = &complete_vtk,
    .names_pieces = true,
    .reads_all = true,
    .large_runs = true };
  return format;
}

bool is_vtk_particles(const std::string& path) noexcept
{
  return looks_so(path,
    [&](const ByteSource& source)
    {
      const std::string head = first_bytes_of(source);
      return head.starts_with('<')
        ? has_number(path) && is_xml_particles(head)
        : head.starts_with(legacy_vtk_mark) && is_legacy_particles(source);
    });
}

bool is_vtk_mesh(const std::string& path) noexcept
{
  return looks_so(path,
    [&](const ByteSource& source)
    {
      constexpr std::int64_t header = 300;
      const std::string head = read_up_to(source, header);
      const bool is_stl = head.starts_with("solid") || head.starts_with("STL");
      const bool is_legacy = head.starts_with(legacy_vtk_mark) && !holds(head, "DATASET RECT") &&
        !is_vtk_particles(path);
      return (is_stl || is_legacy) && is_title(head) && has_number(path);
    });
}

std::string find_box_file(const std::string& path)
{
  const std::size_t dot = std::min(path.rfind('.'), path.size());
  const std::string stem = path.substr(0, dot);
  std::vector<std::string> boxes = { stem + "_boundingBox" };
  for (std::size_t at = stem.rfind('/') + 1; at < stem.size(); ++at)
  {
    if (is_digit(stem[at]) && (at == 0 || !is_digit(stem[at - 1])))
    {
      boxes.push_back(stem.substr(0, at) + "boundingBox_" + stem.substr(at));
    }
  }
  for (const std::string& box : boxes)
  {
    for (const char* ending : { ".vtk", ".vtr", ".vtu", ".pvtr", ".pvtu" })
    {
      if (stamp_of(box + ending).size > 0)
      {
        return box + ending;
      }
    }
  }
  return {};
}
}
