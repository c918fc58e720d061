// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_statistics_h
#define granular_paths_statistics_h

#include "granular/geometry/reproducible_sum.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Returns numbers as terms, eight in each; 0 fills the last.
std::vector<SumScale::Terms> terms_of(std::span<const double> numbers);

/// Returns the scale for exact sums of the terms of all ranks; lanes with the same number modulo `sums`, which divides
/// SumScale::lanes, have the same range. Throws LimitError for magnitudes from 2^900. Collective.
SumScale make_scale(std::span<const SumScale::Terms> terms, std::size_t sums, Communicator& ranks,
  const Executor& executor = Executor());

/// Sums the terms of all ranks: lanes with the same number modulo `sums`, which divides SumScale::lanes, belong to one sum.
/// Returns the sums in the first lanes, each correctly rounded, hence the same for any order of terms, and any ranks. Terms
/// are finite. Throws LimitError for magnitudes from 2^900. Collective.
SumScale::Terms sum_exactly(std::span<const SumScale::Terms> terms, std::size_t sums,
  Communicator& ranks, const Executor& executor = Executor());

/// Properties of the numbers of all ranks together.
struct Statistics
{
  std::int64_t count = 0; ///< of finite numbers, which alone count
  double mean =
    0; ///< their sum, correctly rounded, divided by the count; nan, like the others, if there are none
  double least = 0;
  double greatest = 0;
  std::vector<double> quantiles; ///< as they were asked for
};

/// Returns statistics of the numbers of all ranks, the same for any order of them. The quantile q, 0 to 1, is the smallest of
/// the numbers up to which at least the part q of them lies: it is one of them. Throws what sum_exactly throws. Collective.
Statistics find_statistics(
  std::vector<double> numbers, std::span<const double> quantiles, Communicator& ranks);
}
#endif
