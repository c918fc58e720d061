// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_grain_rows_h
#define granular_packing_grain_rows_h

#include "granular/packing/packing.h"
#include "granular/packing/random_grains.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace granular
{
constexpr std::int64_t rows_a_chunk = 8192;

inline std::size_t chunks_of_rows(std::int64_t rows) noexcept
{
  return static_cast<std::size_t>((rows + rows_a_chunk - 1) / rows_a_chunk);
}

/// Calls work(begin, end, worker) for chunks of the rows.
template <class Work>
void for_row_chunks(std::int64_t rows, int threads, Progress& progress, const Work& work)
{
  const std::size_t chunks = chunks_of_rows(rows);
  Executor(threads).parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t worker)
    {
      const std::int64_t begin = static_cast<std::int64_t>(chunk) * rows_a_chunk;
      work(begin, std::min(rows, begin + rows_a_chunk), worker);
    },
    progress);
}

/// The values of an array that the frame has.
template <typename T>
T* array_of(const DumpFrame& frame, std::string_view name)
{
  const auto found = std::find_if(frame.arrays.begin(), frame.arrays.end(),
    [name](const DumpArray& array) { return array.info.name == name; });
  return static_cast<T*>(found->block.data());
}

/// Fills the arrays that need no more than the number of a grain, and finds the ranges if they are wanted.
void fill_arrays(
  DumpFrame& frame, const RowRange& rows, const PackingRequest& request, Progress& progress);
}
#endif
