// SPDX-License-Identifier: BSD-3-Clause
// How programs that try damaged files of dump local name their columns.
#ifndef granular_tests_fuzz_local_checks_h
#define granular_tests_fuzz_local_checks_h

#include "dump_checks.h"

#include "granular/local/local_columns.h"
#include "granular/local/local_reader.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace granular
{
/// Guesses names from the rows; where they tell nothing, those that otherwise(columns) gives.
template <class Otherwise>
std::vector<std::string> guess_names(
  const RunIndex& run, const FramePiece& first, const Otherwise& otherwise)
{
  std::vector<std::string> columns;
  std::ranges::transform(
    first.entry.kind->schema.columns(), std::back_inserter(columns), &ColumnInfo::name);
  Notices notices;
  Progress progress;
  try
  {
    const LocalSample sample = read_sample(run, *first.entry.kind, progress);
    const Where where = where_of(first);
    const std::vector<std::string> names = find_columns(columns, sample, where, notices);
    require(names.size() == columns.size(), "a name for each column");
    return names;
  }
  catch (const Error&)
  {
    return otherwise(columns);
  }
}
}

#endif
