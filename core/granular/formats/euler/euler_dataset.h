// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_euler_euler_dataset_h
#define granular_formats_euler_euler_dataset_h

#include "granular/formats/euler/euler_file.h"
#include "granular/formats/vtk_files/vtk_grid.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The part of a dataset that is read; other numbers are skipped.
enum class EulerRead : std::uint8_t
{
  Look,  ///< types of cells, and no more than tells whether this is an Euler file
  Names, ///< no numbers
  Values
};

/// A dataset of an Euler file as it stands there.
struct EulerDataset : VtkGrid
{
  std::vector<std::string> names; ///< of the arrays of the cells
  std::vector<std::string> texts; ///< of those that have no numbers
  EulerFrame frame;               ///< of Values

  bool has(std::string_view name) const noexcept;

  /// Returns true if the arrays that mark Euler cells are there.
  bool is_euler() const noexcept;

  /// Returns true if this begins like LIGGGHTS' file: points that are vertices, unlike its meshes, and no other arrays.
  bool may_become_euler() const noexcept;

  /// Returns true if it has LIGGGHTS' title, which meshes have, too.
  bool has_title() const noexcept;
};

/// Reads a dataset, from its header to the next one or the end, with the values of the arrays that `wanted` accepts by name.
/// Data before an error are kept. Throws Error; see LegacyVtk::ended.
void read_dataset(LegacyVtk& file, EulerRead what,
  const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset);
}
#endif
