// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_runs_offer_h
#define granular_runs_offer_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/common/pass.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// The kind of rows of a table, which decides how they are written.
enum class RowKind : std::uint8_t
{
  Particles,
  Lines, ///< contacts and bonds
  Cells,
  Subdomains
};

/// An array that a frame has in its files.
struct OfferedArray
{
  std::string name;
  ValueType type = ValueType::Float64; ///< as far as known before the rows are read
  int components = 1;
  bool is_usual =
    true; ///< false: read only if asked for by name, such as coordinates that make the points
  const KnownColumn* known =
    nullptr;                ///< its unit and meaning; null: not known, or told by another rank
  std::string columns = {}; ///< that make it: see ColumnSchema::text
};

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<OfferedArray>& array)
{
  archive.text(array.name);
  archive.number(array.type);
  archive.number(array.components);
  archive.number(array.is_usual);
  archive.text(array.columns);
}

/// All that the files of a frame tell before its rows are read.
struct Offer
{
  std::array<std::vector<OfferedArray>, 2> tables = {}; ///< the arrays of each
  std::vector<std::string> columns = {}; ///< of local data: their meaning, see find_columns
  std::string error = {};                ///< why the meaning cannot be known; empty: it is
  Where where = {};                      ///< of the error
  Notices notices = {}; ///< for whoever reads a frame of these columns; they name the first asked
};

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<Offer>& offer)
{
  for (auto& table : offer.tables)
  {
    pass(archive, table);
  }
  pass(archive, offer.columns);
  archive.text(offer.error);
  pass(archive, offer.where);
  pass(archive, offer.notices);
}
}
#endif
