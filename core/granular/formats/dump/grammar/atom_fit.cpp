// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/atom_fit.h"

#include "granular/common/words.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::string_view scaled_atom = "id type xs ys zs ix iy iz";
constexpr std::string_view absolute_atom = "id type x y z ix iy iz";

bool is_inside(const Vector3& scaled) noexcept
{
  constexpr double margin = 0.02;
  return std::ranges::all_of(
    scaled, [](double part) { return part >= -margin && part <= 1 + margin; });
}

/// Returns true if the rows of a frame do not tell which coordinates they hold.
bool lacks_names(const FrameEntry& frame)
{
  return frame.kind->guessed && (!frame.kind->named || frame.rows == 0);
}
}

bool is_atom(std::size_t columns) noexcept
{
  return columns == 5 || columns == 8;
}

UnnamedColumns name_columns(
  std::size_t columns, const std::vector<std::string>& of_user, AtomFit fit)
{
  if (!of_user.empty())
  {
    return { of_user };
  }
  const bool guessed = is_atom(columns);
  const bool named = guessed && fit.scaled != fit.absolute;
  const std::vector<std::string_view> atom = split_words(fit.scaled ? scaled_atom : absolute_atom);
  UnnamedColumns found = { {}, named, guessed };
  for (std::size_t i = 0; i < columns; ++i)
  {
    found.names.push_back(named ? std::string(atom[i]) : "column" + std::to_string(i + 1));
  }
  return found;
}

std::string describe_fit(std::size_t columns, AtomFit fit)
{
  return !is_atom(columns) ? ""
    : fit.scaled ? "; its rows lie in the box both as id type x y z and as id type xs ys zs"
                 : "; its rows lie in the box neither as id type x y z nor as id type xs ys zs";
}

AtomFit fit_atom(const ByteSource& source, const BinaryHeader& header, const BinaryLayout& layout)
{
  constexpr std::int64_t most = 4096;
  constexpr std::int64_t some = 64;  // enough where one kind of coordinates fits
  constexpr std::int64_t strays = 5; // one row in so many may be anywhere
  const Vector3 origin = values_of(header.frame.box.origin);
  std::array<Vector3, 3> edges;
  std::ranges::transform(header.frame.box.vectors, edges.begin(), values_of);
  const auto& [a, b, c] = edges;
  const std::array<Vector3, 3> faces = { cross(b, c), cross(c, a), cross(a, b) };
  const double volume = dot(a, faces[0]);
  const bool is_unit = origin == Vector3{} && a == Vector3{ 1, 0, 0 } && b == Vector3{ 0, 1, 0 } &&
    c == Vector3{ 0, 0, 1 };
  const auto columns = static_cast<std::size_t>(header.size_one);
  if (!is_atom(columns) || is_unit || header.frame.rows == 0)
  {
    return { .scaled = true };
  }
  BinaryCursor cursor(source, header.chunks_offset, layout.swapped);
  AtomFit fit;
  std::int64_t scaled = 0;
  std::int64_t absolute = 0;
  std::int64_t left = 0; // rows of the chunk
  for (std::int64_t row = 1; row <= std::min(header.frame.rows, most); ++row, --left)
  {
    for (; left <= 0; left = cursor.take<std::int32_t>() / header.size_one)
    {
      if (cursor.ended())
      {
        return {}; // the file has changed meanwhile
      }
    }
    std::vector<double> values(columns);
    std::ranges::generate(values, [&] { return cursor.take<double>(); });
    scaled += volume != 0 && is_inside({ values[2], values[3], values[4] }) ? 1 : 0;
    const Vector3 place = { values[2] - origin[0], values[3] - origin[1], values[4] - origin[2] };
    absolute += is_inside({ dot(place, faces[0]) / volume, dot(place, faces[1]) / volume,
                  dot(place, faces[2]) / volume })
      ? 1
      : 0;
    const auto fits = [row](std::int64_t inside) { return strays * (row - inside) <= row; };
    fit = { fits(scaled), fits(absolute) };
    if (row >= some && fit.scaled != fit.absolute)
    {
      break;
    }
  }
  return fit;
}

bool lack_atom_names(const std::vector<FileIndex>& files)
{
  return std::ranges::any_of(files,
    [](const FileIndex& file)
    { return file.unnamed && std::ranges::any_of(file.frames, lacks_names); });
}

void complete_atom_names(std::vector<FileIndex>& files, Notices&)
{
  std::map<std::size_t, std::set<std::string>> told; // names, by their number
  const auto for_each_frame = [&](const auto& visit)
  {
    for (FileIndex& file : files)
    {
      std::ranges::for_each(file.frames, [&](FrameEntry& frame) { visit(file, frame); });
    }
  };
  for_each_frame(
    [&](const FileIndex&, const FrameEntry& frame)
    {
      if (frame.kind->guessed && !lacks_names(frame))
      {
        told[frame.kind->schema.columns().size()].insert(frame.kind->schema.text());
      }
    });
  for_each_frame(
    [&](const FileIndex& file, FrameEntry& frame)
    {
      const auto names = told.find(frame.kind->schema.columns().size());
      if (lacks_names(frame) && names != told.end() && names->second.size() == 1)
      {
        const std::vector<std::string_view> words = split_words(*names->second.begin());
        FrameKind kind = *frame.kind;
        kind.schema = ColumnSchema({ words.begin(), words.end() });
        kind.named = true;
        frame.kind = file.kinds->share(std::move(kind));
      }
    });
}
}
