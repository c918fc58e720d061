// SPDX-License-Identifier: BSD-3-Clause
// Euler files in memory, and what is expected of them.
#ifndef granular_tests_euler_euler_files_h
#define granular_tests_euler_euler_files_h

#include "../support/memory_file.h"

#include "granular/formats/euler/euler_file.h"
#include "granular/grid/cells.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

inline bool all_arrays(std::string_view)
{
  return true;
}

/// An Euler file in memory, of which all arrays are read.
class EulerFile : public MemoryFile<granular::EulerFrame>
{
public:
  explicit EulerFile(std::string bytes)
    : MemoryFile(
        granular::euler_format(),
        [](const auto& source, const auto& entry, auto& notices, auto& progress)
        { return granular::read_euler(source, entry, &all_arrays, notices, progress); },
        std::move(bytes))
  {
  }
};

/// A frame as cells: what is no array of theirs is left out.
inline granular::EulerCells cells_of(const granular::EulerFrame& frame)
{
  granular::EulerCells cells;
  cells.centres = frame.centres;
  for (const granular::EulerValues& array : frame.arrays)
  {
    const auto known =
      std::ranges::find(granular::euler_arrays(), array.name, &granular::EulerArray::name);
    if (known != granular::euler_arrays().end())
    {
      cells.*known->values = array.values;
    }
  }
  return cells;
}

/// The three lines that LIGGGHTS begins with.
inline const std::string euler_header =
  "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\n";

/// The arrays of two cells; stresses: as PFM writes them.
inline std::string arrays_of_two(bool stresses)
{
  return std::string("VECTORS v_avg float\n1.000000 2.000000 3.000000\n-0.500000 0.250000 "
                     "-0.000000\nSCALARS volumefraction float 1\nLOOKUP_TABLE default\n0.500000\n"
                     "0.625000\nSCALARS radius float 1\nLOOKUP_TABLE default\n0.125000\n0.000000\n"
                     "SCALARS pressure float 1\nLOOKUP_TABLE default\n-100.500000\n1000.000000\n") +
    (stresses ? "VECTORS sigma float\n1.500000 2.500000 3.500000\n4.500000 5.500000 6.500000\n"
                "VECTORS tau float\n-1.500000 -2.500000 -3.500000\n-4.500000 -5.500000 -6.500000\n"
              : "");
}

/// As LIGGGHTS or, with stresses, PFM writes two cells.
inline std::string two_points(bool stresses = false)
{
  return euler_header +
    "DATASET POLYDATA\nPOINTS 2 float\n-0.250000 0.500000 1.000000\n0.250000 0.500000 1.000000\n"
    "VERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\n" +
    arrays_of_two(stresses);
}

/// PFM, cell_center no: the same cells with their faces.
inline std::string two_boxes()
{
  return euler_header +
    "DATASET RECTILINEAR_GRID\nDIMENSIONS 3 2 2\nX_COORDINATES 3 float\n-0.500000 0.000000 "
    "0.500000\nY_COORDINATES 2 float\n0.250000 0.750000\nZ_COORDINATES 2 float\n0.750000 "
    "1.250000\nCELL_DATA 2\n" +
    arrays_of_two(true);
}

/// PFM, cell_center no, of fix ave/euler/region.
inline std::string two_hexahedra()
{
  return euler_header +
    "DATASET UNSTRUCTURED_GRID\nPOINTS 16 float\n"
    "-0.500000 0.250000 0.750000 0.000000 0.250000 0.750000\n"
    "0.000000 0.750000 0.750000 -0.500000 0.750000 0.750000\n"
    "-0.500000 0.250000 1.250000 0.000000 0.250000 1.250000\n"
    "0.000000 0.750000 1.250000 -0.500000 0.750000 1.250000\n"
    "0.000000 0.250000 0.750000 0.500000 0.250000 0.750000\n"
    "0.500000 0.750000 0.750000 0.000000 0.750000 0.750000\n"
    "0.000000 0.250000 1.250000 0.500000 0.250000 1.250000\n"
    "0.500000 0.750000 1.250000 0.000000 0.750000 1.250000\n"
    "CELLS 2 18\n8 0 1 2 3 4 5 6 7\n8 8 9 10 11 12 13 14 15\nCELL_TYPES 2\n12\n12\nCELL_DATA 2\n" +
    arrays_of_two(true);
}

/// What is in them.
inline granular::EulerCells cells_of_two(bool stresses)
{
  granular::EulerCells cells = { { -0.25, 0.5, 1, 0.25, 0.5, 1 }, { 1, 2, 3, -0.5, 0.25, 0 },
    { 0.5, 0.625 }, { 0.125, 0 }, { -100.5, 1000 }, {}, {} };
  if (stresses)
  {
    cells.normal_stress = { 1.5, 2.5, 3.5, 4.5, 5.5, 6.5 };
    cells.shear_stress = { -1.5, -2.5, -3.5, -4.5, -5.5, -6.5 };
  }
  return cells;
}

/// Without cells, as LIGGGHTS writes it.
inline std::string no_points()
{
  std::string text =
    euler_header + "DATASET POLYDATA\nPOINTS 0 float\nVERTICES 0 0\nPOINT_DATA 0\n";
  text += "VECTORS v_avg float\n";
  for (const char* name : { "volumefraction", "radius", "pressure" })
  {
    text += "SCALARS " + std::string(name) + " float 1\nLOOKUP_TABLE default\n";
  }
  return text;
}
#endif
