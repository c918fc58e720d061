// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/decomposition_text.h"

#include "granular/formats/decomposition/voxels.h"
#include "granular/grid/process_grid.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
constexpr std::size_t corners = corners_of_voxel;

/// Calls add(number, subdomain) for each, and reports progress now and then.
template <class Add>
void for_each(const std::vector<Subdomain>& subdomains, Progress& progress, const Add& add)
{
  constexpr std::size_t report_interval = 16384;
  const std::size_t count = subdomains.size();
  for (std::size_t p = 0; p < count; ++p)
  {
    if (p % report_interval == 0)
    {
      progress.step(static_cast<double>(p) / static_cast<double>(count));
    }
    add(p, subdomains[p]);
  }
}

/// A number as it is written, and a blank.
struct Word
{
  explicit Word(double value)
    : size(static_cast<std::size_t>(print_number(text.data(), value, { 0 }) - text.data() + 1))
  {
    text[size - 1] = ' ';
  }

  operator std::string_view() const noexcept { return { text.data(), size }; }

  std::array<char, most_number_chars + 1> text;
  std::size_t size;
};

/// Three points a line.
void add_points(std::string& text, const std::vector<Subdomain>& subdomains, Progress& progress)
{
  for_each(subdomains, progress,
    [&](std::size_t p, const Subdomain& subdomain)
    {
      // each bound is printed once, for four corners
      const Word x[2] = { Word(subdomain.lo[0]), Word(subdomain.hi[0]) };
      const Word y[2] = { Word(subdomain.lo[1]), Word(subdomain.hi[1]) };
      const Word z[2] = { Word(subdomain.lo[2]), Word(subdomain.hi[2]) };
      for (std::size_t i = 0; i < corners; ++i)
      {
        text.append(x[i >> 2]).append(y[i >> 1 & 1]).append(z[i & 1]);
        if ((corners * p + i) % 3 == 2)
        {
          text += '\n';
        }
      }
    });
  text += '\n';
}

/// The numbers of its points, one cell a line.
void add_cells(std::string& text, std::string_view before, const std::vector<Subdomain>& subdomains,
  Progress& progress)
{
  for_each(subdomains, progress,
    [&](std::size_t p, const Subdomain&)
    {
      text += before;
      for (const std::int64_t corner : voxel_corners)
      {
        text += std::to_string(static_cast<std::int64_t>(corners * p) + corner);
        text += ' ';
      }
      text += '\n';
    });
  text += '\n';
}

void add_types(std::string& text, std::size_t count)
{
  for (std::size_t p = 0; p < count; ++p)
  {
    text += "11\n";
  }
  text += '\n';
}

template <class T>
bool fits_int(const std::vector<Subdomain>& subdomains, T Subdomain::*value)
{
  return std::ranges::all_of(
    subdomains, [&](const Subdomain& each) { return std::in_range<std::int32_t>(each.*value); });
}

/// One value a cell, nine a line.
template <class T>
void add_values(std::string& text, const std::vector<Subdomain>& subdomains, T Subdomain::*value)
{
  for (std::size_t p = 0; p < subdomains.size(); ++p)
  {
    text += std::to_string(subdomains[p].*value);
    text += p % 9 == 8 ? " \n" : " ";
  }
  text += '\n';
}

template <class T>
void add_array(std::string& text, std::string_view name, const std::vector<Subdomain>& subdomains,
  T Subdomain::*value)
{
  add_line(
    text, name, " 1 ", subdomains.size(), fits_int(subdomains, value) ? " int" : " vtktypeint64");
  add_values(text, subdomains, value);
}

void add_arrays(std::string& text, const Decomposition& decomposition)
{
  const auto& [subdomains, has_particles, has_ranks] = decomposition;
  if (!has_particles && !has_ranks)
  {
    return;
  }
  add_line(text, "CELL_DATA ", subdomains.size());
  add_line(text, "FIELD FieldData ", has_particles && has_ranks ? 2 : 1);
  if (has_particles)
  {
    add_array(text, "nlocal", subdomains, &Subdomain::particles);
  }
  if (has_ranks)
  {
    add_array(text, "proc", subdomains, &Subdomain::rank);
  }
}

/// Tells the loss of six decimals in the cuts of an axis.
void tell_rounding(const std::vector<double>& cuts, char axis, Notices& notices)
{
  double thinnest = std::numeric_limits<double>::infinity(); // of the slabs that are not flat
  double length = 0;
  double moved = 0;       // at most
  std::size_t joined = 0; // cuts that differ from the one before, and no longer do
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    const double rounded = as_fixed(cuts[i]);
    moved = std::max(moved, std::abs(rounded - cuts[i]));
    if (i > 0 && cuts[i] != cuts[i - 1])
    {
      thinnest = std::min(thinnest, cuts[i] - cuts[i - 1]);
      length += cuts[i] - cuts[i - 1];
      joined += rounded == as_fixed(cuts[i - 1]) ? 1U : 0U;
    }
  }
  constexpr double much = 1e-3; // of the thinnest slab
  if (joined == 0 && moved <= much * thinnest)
  {
    return;
  }
  if (joined > 0 && joined + 1 == cuts.size())
  {
    throw Error("expected a box that six decimals, which is what LIGGGHTS-PUBLIC writes, do not "
                "make flat, got one with a length of " +
      to_text(length) + " along " + std::string(1, axis) + "; the dialect INL keeps all digits");
  }
  std::string text = "six decimals, which is what LIGGGHTS-PUBLIC writes, are few along " +
    std::string(1, axis) + ": coordinates change by up to " + to_text(moved) +
    ", the thinnest slab has " + to_text(thinnest);
  if (joined > 0)
  {
    text += "; " + std::to_string(joined) + " of " + std::to_string(cuts.size() - 1) +
      (joined == 1 ? " slabs becomes flat" : " slabs become flat");
  }
  notices.push_back(
    { {}, text + "; the dialect INL keeps all digits", std::string("rounding along ") + axis });
}
}

std::string encode_voxels(const Decomposition& decomposition, Progress& progress)
{
  std::string text = "# vtk DataFile Version 3.0\nGenerated by vtk-granular\nASCII\n"
                     "DATASET UNSTRUCTURED_GRID\n";
  const std::size_t count = decomposition.subdomains.size();
  PartialProgress part(progress);
  part.set_part(0, 0.7);
  add_line(text, "POINTS ", corners * count, " double");
  add_points(text, decomposition.subdomains, part);
  part.set_part(0.7, 0.9);
  add_line(text, "CELLS ", count, " ", (1 + corners) * count);
  add_cells(text, "8 ", decomposition.subdomains, part);
  add_line(text, "CELL_TYPES ", count);
  add_types(text, count);
  add_arrays(text, decomposition);
  progress.step(1);
  return text;
}

std::string encode_vtu(
  const Decomposition& decomposition, std::optional<double> time, Progress& progress)
{
  const auto& [subdomains, has_particles, has_ranks] = decomposition;
  const std::size_t count = subdomains.size();
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                     "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  const std::string_view end = "</DataArray>\n";
  const auto begin = [&](std::string_view type, std::string_view name, std::string_view more = {})
  {
    add_line(
      text, "<DataArray type=\"", type, "\" Name=\"", name, "\"", more, " format=\"ascii\">");
  };
  if (time)
  {
    text += "<FieldData>\n";
    begin("Float64", "TimeValue", " NumberOfTuples=\"1\"");
    text.append(Word(*time)).append("\n").append(end) += "</FieldData>\n";
  }
  PartialProgress part(progress);
  part.set_part(0, 0.7);
  add_line(text, "<Piece NumberOfPoints=\"", corners * count, "\" NumberOfCells=\"", count,
    "\">\n<Points>");
  begin("Float64", "Points", " NumberOfComponents=\"3\"");
  add_points(text, subdomains, part);
  text.append(end) += "</Points>\n<Cells>\n";
  part.set_part(0.7, 0.9);
  begin("Int64", "connectivity");
  add_cells(text, "", subdomains, part);
  text += end;
  begin("Int64", "offsets");
  for (std::size_t p = 1; p <= count; ++p)
  {
    add_line(text, corners * p);
  }
  text += end;
  begin("UInt8", "types");
  add_types(text, count);
  text.append(end) +=
    has_particles ? "</Cells>\n<CellData Scalars=\"nlocal\">\n" : "</Cells>\n<CellData>\n";
  if (has_particles)
  {
    begin(fits_int(subdomains, &Subdomain::particles) ? "Int32" : "Int64", "nlocal");
    add_values(text, subdomains, &Subdomain::particles);
    text += end;
  }
  if (has_ranks)
  {
    begin("Int32", "proc");
    add_values(text, subdomains, &Subdomain::rank);
    text += end;
  }
  progress.step(1);
  return text + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string encode_grid(const Decomposition& decomposition, Notices& notices)
{
  const std::optional<ProcessGrid> grid = find_process_grid(decomposition.subdomains);
  if (!grid)
  {
    throw UnsupportedError("expected subdomains that form a grid, which is all that a rectilinear "
                           "grid can hold, got " +
      std::to_string(decomposition.subdomains.size()) + " that do not");
  }
  const auto& cuts = grid->cuts;
  std::string text = "# vtk DataFile Version 2.0\nLIGGGHTS mesh/gran/VTK export\nASCII\n"
                     "DATASET RECTILINEAR_GRID\n";
  add_line(text, "DIMENSIONS ", cuts[0].size(), " ", cuts[1].size(), " ", cuts[2].size());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    text += "XYZ"[axis];
    add_line(text, "_COORDINATES ", cuts[axis].size(), " float");
    for (const double cut : cuts[axis])
    {
      std::array<char, most_fixed_chars> digits;
      text.append(digits.data(), print_fixed(digits.data(), cut)) += ' ';
    }
    tell_rounding(cuts[axis], "xyz"[axis], notices);
    text += '\n';
  }
  return text;
}
}
