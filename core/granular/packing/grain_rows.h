// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_grain_rows_h
#define granular_packing_grain_rows_h

#include "granular/parallel/executor.h"
#include "granular/particles/dump_frame.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace granular
{
/// Rows of particles from first to last - 1; a particle's id is its row + 1.
struct RowRange
{
  std::int64_t first = 0;
  std::int64_t last = 0;

  std::int64_t count() const noexcept { return last - first; }
};

/// Rows of particles, and the frame that receives them.
struct GrainRows : RowRange
{
  double* points = nullptr; ///< three a row
  double* radius = nullptr;
  std::int32_t* type = nullptr;
};

constexpr std::int64_t rows_a_chunk = 8192;

inline std::size_t chunks_of_rows(std::int64_t rows) noexcept
{
  return static_cast<std::size_t>((rows + rows_a_chunk - 1) / rows_a_chunk);
}

/// Calls work(begin, end, worker) for chunks of the rows.
template <class Work>
void for_row_chunks(std::int64_t rows, int threads, Progress& progress, const Work& work)
{
  Executor(threads).parallel_for(
    chunks_of_rows(rows),
    [&](std::size_t chunk, std::size_t worker)
    {
      const std::int64_t begin = static_cast<std::int64_t>(chunk) * rows_a_chunk;
      work(begin, std::min(rows, begin + rows_a_chunk), worker);
    },
    progress);
}

/// Returns the values of an array of the frame.
template <typename T>
T* array_of(const DumpFrame& frame, std::string_view name)
{
  const auto found = std::ranges::find(
    frame.arrays, name, [](const DumpArray& array) { return std::string_view(array.info.name); });
  return static_cast<T*>(found->block.data());
}
}
#endif
