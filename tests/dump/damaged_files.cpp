// SPDX-License-Identifier: BSD-3-Clause
// Compressed dumps with any of their bytes changed: an error that names the file and the byte, or what
// was there before, or a word that it could not be checked; never other numbers in silence.
#include "../support/byte_source_packing.h"
#include "../support/resident_memory.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
std::string first_frame()
{
  const std::string text = data_file("good/ortho_scaled.dump");
  return text.substr(0, text.find("ITEM: TIMESTEP", 1));
}

struct Counts
{
  int errors = 0;
  int bytes_named = 0; ///< by the errors; the others are about lines, or the whole file
  int same = 0;
  int said = 0; ///< not checked: the end of the data is gone
};

/// Opens and reads the file with each byte changed in two ways.
Counts damage_all(const std::string& name, const std::string& packed, const std::string& text)
{
  const Folder folder;
  const std::string good = folder.write("good", text);
  Series whole;
  whole.update({ good });
  const std::vector<double> points = whole.read(0).points();
  const std::int64_t before = peak_bytes();
  Counts counts;
  for (std::size_t at = 0; at < packed.size(); ++at)
  {
    for (const int flip : { 0x01, 0xff })
    {
      std::string bytes = packed;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      const std::string path = folder.write(name, bytes);
      Series run;
      const std::string error = error_of([&] { run.update({ path }); });
      if (!error.empty())
      {
        EXPECT_TRUE(error.starts_with(path)) << error;
        EXPECT_EQ(run.index.size(), 0u);
        ++counts.errors;
        counts.bytes_named += error.starts_with(path + "@") ? 1 : 0;
      }
      else if (run.said.find("unchecked") != std::string::npos)
      {
        ++counts.said;
      }
      else
      {
        EXPECT_EQ(run.read(0).points(), points) << "byte " << at;
        ++counts.same;
      }
    }
  }
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 64 } << 20);
  return counts;
}
}

TEST(DamagedFiles, Gzip)
{
  const std::string text = first_frame();
  const std::string packed = packing::gzip(text);
  const Counts counts = damage_all("a.dump.gz", packed, text);
  // most of the file is data under the CRC; time, system and how hard it was compressed are not
  EXPECT_GT(counts.errors, counts.same + counts.said);
  EXPECT_LT(counts.same, 20);
  EXPECT_GT(10 * counts.bytes_named, 9 * counts.errors);
}

TEST(DamagedFiles, Zstandard)
{
  const std::string text = first_frame();
  const Counts counts = damage_all("a.dump.zst", packing::zstd(text), text);
  EXPECT_GT(counts.errors, counts.same + counts.said);
  EXPECT_LT(counts.same, 20);
  EXPECT_GT(10 * counts.bytes_named, 9 * counts.errors);
}
