// SPDX-License-Identifier: BSD-3-Clause
// Small files of Euler cells for the tests of the VTK classes, made with the simplest means.
#ifndef tests_euler_made_files_h
#define tests_euler_made_files_h

#include <array>
#include <cstdio>
#include <string>
#include <vector>

using Place = std::array<double, 3>;

/// The centres of a grid's cells, x fastest.
inline std::vector<Place> Centres(
  const Place& lo, const Place& size, const std::array<int, 3>& counts)
{
  std::vector<Place> centres;
  for (int k = 0; k < counts[2]; ++k)
  {
    for (int j = 0; j < counts[1]; ++j)
    {
      for (int i = 0; i < counts[0]; ++i)
      {
        centres.push_back({ lo[0] + (i + 0.5) * size[0], lo[1] + (j + 0.5) * size[1],
          lo[2] + (k + 0.5) * size[2] });
      }
    }
  }
  return centres;
}

inline std::vector<Place> operator+(std::vector<Place> all, const std::vector<Place>& more)
{
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

inline std::string SixDecimals(double value)
{
  char text[400];
  std::snprintf(text, sizeof text, "%f", value);
  return text;
}

/// What LIGGGHTS writes of cells: cell i has the velocity (i, -i, 0.5), the volume fraction i / 100, the radius
/// 0.25 and the pressure 1000 i.
inline std::string EulerText(const std::vector<Place>& centres)
{
  const std::string count = std::to_string(centres.size());
  std::string text =
    "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET POLYDATA\nPOINTS " +
    count + " float\n";
  const auto add = [&](const Place& values)
  {
    text +=
      SixDecimals(values[0]) + " " + SixDecimals(values[1]) + " " + SixDecimals(values[2]) + "\n";
  };
  for (const Place& centre : centres)
  {
    add(centre);
  }
  text += "VERTICES " + count + " " + std::to_string(2 * centres.size()) + "\n";
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    text += "1 " + std::to_string(i) + "\n";
  }
  text += "POINT_DATA " + count + "\nVECTORS v_avg float\n";
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    const auto value = static_cast<double>(i);
    add({ value, -value, 0.5 });
  }
  const auto scalars = [&](const char* name, double constant, double factor)
  {
    text += "SCALARS " + std::string(name) + " float 1\nLOOKUP_TABLE default\n";
    for (std::size_t i = 0; i < centres.size(); ++i)
    {
      text += SixDecimals(constant + factor * static_cast<double>(i)) + "\n";
    }
  };
  scalars("volumefraction", 0, 0.01);
  scalars("radius", 0.25, 0);
  scalars("pressure", 0, 1000);
  return text;
}

#endif
