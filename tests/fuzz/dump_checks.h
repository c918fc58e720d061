// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets of dumps share: frames are read with several requests, and must be what they
// say.
#ifndef granular_tests_fuzz_dump_checks_h
#define granular_tests_fuzz_dump_checks_h

#include "granular/dump/dump_reader.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace granular
{
inline void require(bool good, const char* what)
{
  if (!good)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

inline void check_frame(const DumpFrame& frame, const FrameEntry& entry, const DumpRequest& request)
{
  const auto rows = static_cast<std::size_t>(frame.rows);
  const bool filtered = request.stride > 1 || request.region[0] <= request.region[1];
  require(frame.rows == entry.rows || (filtered && frame.rows < entry.rows), "rows");
  require(frame.points.bytes() == 3 * rows * (request.single_precision ? 4 : 8), "points");
  for (const DumpArray& array : frame.arrays)
  {
    if (array.info.type == ValueType::Text)
    {
      const auto* const indices = static_cast<const std::int32_t*>(array.block.data());
      for (std::size_t row = 0; row < rows; ++row)
      {
        require(indices[row] >= 0, "index of a word");
        require(static_cast<std::size_t>(indices[row]) < array.words.size(), "index of a word");
      }
    }
    else
    {
      require(array.block.bytes() == rows * array.info.columns.size() * size_of(array.info.type),
        "array");
    }
  }
}

inline void read_frame(
  const ByteSource& source, const FrameEntry& entry, const DumpRequest& request)
{
  Notices notices;
  Progress progress;
  try
  {
    check_frame(read_dump(source, entry, request, notices, progress), entry, request);
  }
  catch (const Error&)
  {
    // what it says is for a reader to judge
  }
}

inline std::vector<DumpRequest> requests()
{
  std::vector<DumpRequest> all(4);
  all[1].wanted = [](const ArrayInfo&) { return true; };
  all[1].coordinates = Coordinates::Scaled;
  all[1].stride = 3;
  all[1].sort_by_id = true;
  all[2].coordinates = Coordinates::Unwrapped;
  all[2].single_precision = true;
  all[2].region = { -0.5, 0.5, 1, -1, 1, -1 };
  all[2].point_origin = { 1, 2, 3 };
  all[3].wanted = [](const ArrayInfo&) { return false; };
  all[3].sort_by_id = true;
  return all;
}
}
#endif
