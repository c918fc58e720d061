// SPDX-License-Identifier: BSD-3-Clause
// bench_peak_memory FILE: reads the first frame of a dump as the reader does, into double points and
// all arrays, and prints two numbers: the bytes of the arrays, and the most memory that this
// process ever had [KiB].
#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"
#include "granular/frames/run_index.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

namespace
{
long peak_kib()
{
  std::ifstream status("/proc/self/status");
  std::string word;
  long kib = -1;
  while (status >> word)
  {
    if (word == "VmHWM:")
    {
      status >> kib;
    }
  }
  return kib;
}
}

int main(int argc, char** argv)
try
{
  if (argc != 2)
  {
    std::fputs("usage: bench_peak_memory FILE\n", stderr);
    return 1;
  }
  granular::RunIndex index;
  granular::Notices notices;
  granular::Progress progress;
  index.update({ argv[1] }, { .format = &granular::dump_format() }, notices, progress);
  const granular::DumpFrame frame = granular::read_dump(index.pieces(0), {}, notices, progress);
  std::size_t bytes = frame.points.bytes();
  for (const granular::DumpArray& array : frame.arrays)
  {
    bytes += array.block.bytes();
  }
  std::printf("%zu %ld\n", bytes, peak_kib());
  return notices.empty() ? 0 : 1;
}
catch (const std::exception& error)
{
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
