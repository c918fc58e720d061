// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_match_bonds_h
#define granular_formats_restart_match_bonds_h

#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The bonds of some particles, row by row.
struct BondCopies
{
  enum State : unsigned char
  {
    Left, ///< out: the partner is not there, or the partner's copy counts
    Kept,
    Higher ///< held by the particle with the higher id; as Kept
  };

  std::int64_t first_row = 0;
  std::vector<std::int64_t> begins = { 0 }; ///< of the copies of each row, and the end
  std::vector<std::int64_t> partners;       ///< ids, then rows; -1: not there
  std::vector<std::int32_t> types;
  Block history; ///< doubles of each copy
  std::vector<unsigned char> states;

  /// Calls visit(row, copy) for each copy in the rows of the file from first to end.
  template <class Visit>
  void for_each(std::int64_t first, std::int64_t end, const Visit& visit) const
  {
    const auto here = static_cast<std::int64_t>(this->rows());
    const std::int64_t last = std::min(end - first_row, here);
    for (std::int64_t row = std::max<std::int64_t>(first - first_row, 0); row < last; ++row)
    {
      const std::int64_t behind = begins[static_cast<std::size_t>(row) + 1];
      for (std::int64_t i = begins[static_cast<std::size_t>(row)]; i < behind; ++i)
      {
        visit(first_row + row, static_cast<std::size_t>(i));
      }
    }
  }

  /// The same for those that are bonds.
  template <class Visit>
  void for_kept(std::int64_t first, std::int64_t end, const Visit& visit) const
  {
    this->for_each(first, end,
      [&](std::int64_t row, std::size_t copy)
      {
        if (states[copy] != Left)
        {
          visit(row, copy);
        }
      });
  }

  std::size_t rows() const noexcept { return begins.size() - 1; }
  std::size_t size() const noexcept { return partners.size(); }
  const double* values() const noexcept { return static_cast<const double*>(history.data()); }
};

/// Counts for notices about bonds.
struct BondCounts
{
  std::int64_t without_partner = 0;
  std::int64_t of_itself = 0; ///< between a particle and itself
  std::int64_t differing = 0; ///< copies with another history, but for sign and rounding
  std::int64_t repeated_ids = 0;
};

/// Finds the rows of the partners, by ids, those of all rows, and which copies there are of each bond: both (once: each copy is a
/// bond), or where both particles hold one, that of the lower id. Of several bonds between two particles those of the
/// same type go together first. Two copies differ where the sizes of a value differ by more than 1e-6 of that value, and by more than
/// 1e-6 of the largest there is of its kind in all copies: near zero they are rounded to something else. Of 12 values and more the
/// first six are one kind (forces), the next six another (torques); each other value is a kind of its own. nan is as nan. In time
/// linear in the number of copies, but for sorting those of one particle.
BondCounts match_bonds(std::vector<BondCopies>& blocks, std::span<const std::int64_t> ids,
  bool once, std::size_t history_values, const Executor& executor, Progress& progress);
}
#endif
