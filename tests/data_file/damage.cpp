// SPDX-License-Identifier: BSD-3-Clause
// Data files that were cut anywhere, that claim anything, and with any of their bytes changed: the right rows, or an error that
// says where, in bounded memory.
#include "data_run.h"

#include "../support/memory_file.h"

#include "granular/bytes/compression.h"

namespace
{
const std::string good =
  "a chain, timestep = 7\n\n3 atoms\n2 bonds\n\n0 9 xlo xhi\n\nVelocities\n\n"
  "3 1 2 3\n2 0 0 0\n1 4 5 6\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 1 # two\n3 1 1 0 0 "
  "2\n\nBonds\n\n1 1 1 2\n2 1 2 3\n\nAngles\n\n1 1 1 2 3\n";

/// What is read, or the error.
std::string result_of(const std::string& text)
{
  const std::string path = write_data(text);
  try
  {
    const granular::Tables frame = DataRun(path).read();
    const auto rows = static_cast<std::size_t>(frame.rows.rows);
    EXPECT_EQ(points_of(frame.rows).size(), 3 * rows);
    for (const granular::TableArray& array : frame.rows.arrays)
    {
      EXPECT_EQ(
        array.block.bytes(), rows * array.info.columns.size() * granular::size_of(array.info.type));
    }
    EXPECT_EQ(frame.bonds.lines.count, frame.bonds.rows);
    std::string values;
    for (const double value : array_of(frame.rows, "v"))
    {
      values += std::to_string(value) + " ";
    }
    return std::to_string(rows) + " particles, " + std::to_string(frame.bonds.rows) + " bonds, v " +
      values;
  }
  catch (const granular::Error& error)
  {
    EXPECT_EQ(error.where().path, path) << error.what();
    return "error";
  }
}
}

TEST(DataDamage, CutAnywhere)
{
  const std::string whole = result_of(good);
  EXPECT_EQ(whole.substr(0, 22), "3 particles, 2 bonds, ");
  const std::size_t complete = good.find("\n\nAngles"); // what comes then is passed over
  for (std::size_t bytes = 0; bytes < good.size(); ++bytes)
  {
    EXPECT_EQ(result_of(good.substr(0, bytes)), bytes >= complete ? whole : "error") << bytes;
  }
}

TEST(DataDamage, AnyByteChanged)
{
  const std::int64_t before = restart_peak();
  change_each_byte(good, [](const std::string& text) { result_of(text); });
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 64 } << 20);
}

// A count is a claim: there is no memory for rows that are not there.
TEST(DataDamage, ClaimsOfAnySize)
{
  const std::int64_t before = restart_peak();
  for (const char* const counted : { "3 atoms", "2 bonds" })
  {
    for (const char* const claim :
      { "10000000000000", "9223372036854775807", "9223372036854775808", "1000000000", "-1" })
    {
      std::string bad = good;
      bad.replace(good.find(counted), 1, claim);
      EXPECT_EQ(result_of(bad), "error") << claim;
      EXPECT_EQ(result_of(granular::compress(bad, granular::Compression::Gzip)), "error") << claim;
    }
  }
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 64 } << 20);
}

// Compressed files with any of their bytes changed: never other rows in silence.
TEST(DataDamage, CompressedFiles)
{
  const std::string whole = result_of(good);
  const std::string packed = granular::compress(good, granular::Compression::Gzip);
  EXPECT_EQ(result_of(packed), whole);
  int refused = 0;
  for (std::size_t at = 10; at < packed.size(); ++at)
  {
    std::string bytes = packed;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    const std::string found = result_of(bytes);
    refused += found == "error" ? 1 : 0;
    EXPECT_TRUE(found == "error" || found == whole) << at;
  }
  EXPECT_GT(refused, static_cast<int>(packed.size()) / 2);
}
