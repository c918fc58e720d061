// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/vtu_grids.h"

#include "granular/common/words.h"

#include <iterator>

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
  Particles,
  Ranks,
  OtherRanks,
  OfProcesses = Particles
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

bool is_grid_file(const VtkXml& file)
{
  return file.element() == "/VTKFile" && file.attribute("type") == "UnstructuredGrid";
}
}

bool is_vtu(std::string_view text)
{
  std::string_view rest = text;
  rest.remove_prefix(rest.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  VtkXml file(text, {});
  try
  {
    return take_word(rest).starts_with('<') && file.next() && is_grid_file(file);
  }
  catch (const Error&)
  {
    return is_grid_file(file); // which a reader may not know how to read
  }
}

VtuGrids::VtuGrids(std::string_view text, const std::string& path)
  : file_(text, path)
{
  static_assert(std::size(known) == array_kinds);
  try
  {
    this->find_grids();
  }
  catch (const Error&)
  {
    error_ = error_ ? error_ : std::current_exception();
  }
}

void VtuGrids::check() const
{
  if (error_)
  {
    std::rethrow_exception(error_);
  }
}

bool VtuGrids::may_be_subdomains() const noexcept
{
  return fits_ && seen_[Particles];
}

bool VtuGrids::has_ranks() const noexcept
{
  return seen_[Ranks] || seen_[OtherRanks];
}

void VtuGrids::find_grids()
{
  while (file_.next())
  {
    const std::string& element = file_.element();
    if (element == piece_element)
    {
      this->add_piece();
    }
    else if (element.starts_with(piece_element))
    {
      try
      {
        this->add_array();
      }
      catch (const Error&) // what else there is tells what the file is
      {
        error_ = error_ ? error_ : std::current_exception();
        keep_ = false;
      }
    }
  }
}

void VtuGrids::add_piece()
{
  Piece piece;
  piece.points = file_.count("NumberOfPoints");
  piece.cells = file_.count("NumberOfCells");
  piece.begin = file_.begin();
  if (piece.cells > most_processes - cells_ || piece.points / points_a_cell > most_processes)
  {
    throw LimitError("expected at most " + std::to_string(most_processes) +
        " cells, with eight points each, got " + std::to_string(piece.cells) + " with " +
        std::to_string(piece.points),
      file_.where(piece.begin));
  }
  cells_ += piece.cells;
  fits_ =
    fits_ && (piece.points > 0) == (piece.cells > 0) && piece.points <= points_a_cell * piece.cells;
  keep_ = piece.cells > 0;
  if (keep_)
  {
    pieces_.push_back(piece);
  }
}

void VtuGrids::add_array()
{
  const std::string_view inside =
    std::string_view(file_.element()).substr(piece_element.size() + 1);
  for (std::size_t kind = 0; kind < array_kinds; ++kind)
  {
    const bool same = inside.starts_with(known[kind].element) &&
      inside.substr(known[kind].element.size()) == "/DataArray" &&
      (known[kind].name.empty() || known[kind].name == file_.attribute("Name"));
    seen_[kind] = seen_[kind] || same;
    if (!same || !keep_)
    {
      continue;
    }
    std::optional<VtkXmlArray>& array = pieces_.back().arrays[kind];
    if (array)
    {
      file_.fail("one array " + std::string(known[kind].element) + " " +
          std::string(known[kind].name) + " in a piece",
        "another");
    }
    array = file_.array();
  }
}

const VtkXmlArray& VtuGrids::need(const Piece& piece, std::size_t kind) const
{
  if (!piece.arrays[kind])
  {
    throw FormatError("expected an array " + std::string(known[kind].element) + " " +
        std::string(known[kind].name) + " in a piece with cells, got none",
      file_.where(piece.begin));
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
