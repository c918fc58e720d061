// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/vtu_grids.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"

#include <iterator>
#include <limits>

namespace granular
{
namespace
{
constexpr std::int64_t points_a_cell = corners_of_voxel;

/// Arrays of a piece that count. Those of cells, which may not be there, are the last, as process_arrays() has them.
enum Kind : std::size_t
{
  Points,
  Connectivity,
  Offsets,
  Types,
  OfProcesses
};

struct Known
{
  std::string_view element; ///< around it, in a piece
  std::string_view name;    ///< empty: any
};

constexpr Known known[] = { { "Points", "" }, { "Cells", "connectivity" }, { "Cells", "offsets" },
  { "Cells", "types" }, { "CellData", "nlocal" }, { "CellData", "proc" },
  { "CellData", "procID" } };

const std::string piece_element = "/VTKFile/UnstructuredGrid/Piece";

/// An attribute that is a number; 0 where it is none.
std::int64_t count(const XmlTags& tags, std::string_view attribute) noexcept
{
  const std::string_view text = tags.attribute(attribute);
  std::int64_t number = 0;
  return parse_int64(text.data(), text.data() + text.size(), number) && number > 0 ? number : 0;
}

bool begins_with_tag(std::string_view text) noexcept
{
  text.remove_prefix(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  return take_word(text).starts_with('<');
}

void look_at_piece(const XmlTags& tags, VtuHead& head) noexcept
{
  const std::int64_t cells = count(tags, "NumberOfCells");
  const std::int64_t points = count(tags, "NumberOfPoints");
  const std::int64_t left = std::numeric_limits<std::int64_t>::max() - head.cells;
  head.cells += cells <= left ? cells : 0;
  head.fits = head.fits && (points > 0) == (cells > 0) && points / points_a_cell <= cells &&
    (points / points_a_cell < cells || points % points_a_cell == 0);
}

void look_at_array(const XmlTags& tags, VtuHead& head) noexcept
{
  const std::string_view name = tags.attribute("Name");
  head.has_particles = head.has_particles || name == "nlocal";
  head.has_ranks = head.has_ranks || name == "proc" || name == "procID";
}

void look_at_tags(std::string_view text, VtuHead& head)
{
  XmlTags tags(text, {});
  if (!begins_with_tag(text) || !tags.next() || tags.element() != "/VTKFile" ||
    tags.attribute("type") != "UnstructuredGrid")
  {
    return;
  }
  head.unstructured = true;
  while (tags.next() && tags.element() != "/VTKFile/AppendedData")
  {
    if (tags.element() == piece_element)
    {
      look_at_piece(tags, head);
    }
    else if (tags.element() == piece_element + "/CellData/DataArray")
    {
      look_at_array(tags, head);
    }
  }
}
}

VtuHead look_at(std::string_view text)
{
  VtuHead head;
  try
  {
    look_at_tags(text, head);
  }
  catch (const Error&)
  {
    return head; // what was found before the end of the text, or what is wrong there
  }
  return head;
}

VtuGrids::VtuGrids(std::string_view text, const std::string& path)
  : file_(text, path)
{
  static_assert(std::size(known) == array_kinds);
  while (file_.next())
  {
    const std::string& element = file_.tags().element();
    if (element == piece_element)
    {
      this->add_piece();
    }
    else if (keep_ && element.starts_with(piece_element))
    {
      this->add_array();
    }
  }
}

void VtuGrids::add_piece()
{
  Piece piece;
  piece.points = file_.count("NumberOfPoints");
  piece.cells = file_.count("NumberOfCells");
  piece.begin = file_.tags().begin();
  if (piece.cells > most_processes - cells_ || piece.points / points_a_cell > most_processes)
  {
    throw LimitError("expected at most " + std::to_string(most_processes) +
        " cells, with eight points each, got " + std::to_string(piece.cells) + " with " +
        std::to_string(piece.points),
      file_.tags().where(piece.begin));
  }
  cells_ += piece.cells;
  keep_ = piece.cells > 0;
  if (keep_)
  {
    pieces_.push_back(piece);
  }
}

void VtuGrids::add_array()
{
  const XmlTags& tags = file_.tags();
  const std::string_view inside = std::string_view(tags.element()).substr(piece_element.size() + 1);
  for (std::size_t kind = 0; kind < array_kinds; ++kind)
  {
    const bool same = inside.starts_with(known[kind].element) &&
      inside.substr(known[kind].element.size()) == "/DataArray" &&
      (known[kind].name.empty() || known[kind].name == tags.attribute("Name"));
    std::optional<VtkXmlArray>& array = pieces_.back().arrays[kind];
    if (same && array)
    {
      tags.fail("one array " + std::string(known[kind].element) + " " +
          std::string(known[kind].name) + " in a piece",
        "another");
    }
    if (same)
    {
      array = file_.array();
    }
  }
}

const VtkXmlArray& VtuGrids::need(const Piece& piece, std::size_t kind) const
{
  if (!piece.arrays[kind])
  {
    throw FormatError("expected an array " + std::string(known[kind].element) + " " +
        std::string(known[kind].name) + " in a piece with cells, got none",
      file_.tags().where(piece.begin));
  }
  return *piece.arrays[kind];
}

void VtuGrids::check_components(const VtkXmlArray& array, std::int64_t components) const
{
  if (array.components != components)
  {
    throw FormatError("expected NumberOfComponents " + std::to_string(components) + ", got " +
        std::to_string(array.components),
      file_.where(array));
  }
}

DecompositionGrid VtuGrids::read(std::size_t grid) const
{
  constexpr std::int64_t axes = 3;
  const Piece& piece = pieces_[grid];
  DecompositionGrid read;
  read.cells = piece.cells;
  const VtkXmlArray& points = this->need(piece, Points);
  this->check_components(points, axes);
  file_.read(points, axes * piece.points, read.points);
  this->read_cells(piece, read);
  this->read_data(piece, read);
  return read;
}

void VtuGrids::read_cells(const Piece& piece, DecompositionGrid& grid) const
{
  const VtkXmlArray& connectivity = this->need(piece, Connectivity);
  const VtkXmlArray& offsets = this->need(piece, Offsets);
  const VtkXmlArray& types = this->need(piece, Types);
  for (const VtkXmlArray* const array : { &connectivity, &offsets, &types })
  {
    this->check_components(*array, 1);
  }
  std::vector<std::int64_t> numbers;
  file_.read(types, piece.cells, numbers);
  check_types(numbers, [&](std::int64_t i) { return file_.where_of(types, i); });
  file_.read(offsets, piece.cells, numbers);
  std::int64_t last = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (numbers[i] != last + points_a_cell)
    {
      throw FormatError("expected offsets of eight points a cell, " +
          std::to_string(last + points_a_cell) + " behind cell " + std::to_string(i) + ", got " +
          std::to_string(numbers[i]),
        file_.where_of(offsets, static_cast<std::int64_t>(i)));
    }
    last += points_a_cell;
  }
  grid.voxels.size = piece.cells;
  file_.read(connectivity, points_a_cell * piece.cells, grid.voxels.connectivity);
}

void VtuGrids::read_data(const Piece& piece, DecompositionGrid& grid) const
{
  std::size_t kind = OfProcesses;
  for (const ProcessArray& entry : process_arrays())
  {
    const std::optional<VtkXmlArray>& array = piece.arrays[kind++];
    if (!array || (entry.only_if_none && grid.*entry.there))
    {
      continue;
    }
    this->check_components(*array, 1);
    std::vector<std::int64_t>& numbers = grid.*entry.numbers;
    file_.read(*array, piece.cells, numbers);
    entry.check(numbers, [&](std::int64_t i) { return file_.where_of(*array, i); });
    grid.*entry.there = true;
  }
}

Where VtuGrids::where_of(std::size_t grid, std::int64_t cell) const
{
  const Piece& piece = pieces_[grid];
  return file_.where_of(this->need(piece, Connectivity), points_a_cell * cell);
}
}
