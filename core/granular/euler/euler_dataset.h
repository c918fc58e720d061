// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_euler_dataset_h
#define granular_euler_euler_dataset_h

#include "granular/euler/euler_file.h"
#include "granular/vtk_files/legacy_vtk.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What of a dataset is read; numbers of the rest are passed over.
enum class EulerRead : std::uint8_t
{
  Look,  ///< types of cells, and no more than tells whether this is an Euler file
  Names, ///< no numbers
  Values
};

/// A dataset of an Euler file as it stands there.
struct EulerDataset
{
  VtkHeader header;
  bool has_vertices = false;      ///< of one point each
  std::vector<std::string> names; ///< of the arrays of the cells
  std::vector<std::string> texts; ///< of those that have no numbers
  EulerFrame frame;

  bool has(std::string_view name) const noexcept;

  /// Whether the arrays are there that tell Euler cells from others.
  bool is_euler() const noexcept;

  /// Whether this is as LIGGGHTS begins: points that are vertices, which those of its meshes are not, and no other
  /// arrays.
  bool may_become_euler() const noexcept;

  /// Whether it has the title that LIGGGHTS writes, of meshes as well.
  bool has_title() const noexcept;
};

/// Reads a dataset, from its header to the next one or the end; of arrays the values of those that `wanted` says yes
/// to by name. What was read before an error is there. Throws Error; see LegacyVtk::ended.
void read_dataset(LegacyVtk& file, EulerRead what,
  const std::function<bool(std::string_view)>& wanted, EulerDataset& dataset);
}
#endif
