// SPDX-License-Identifier: BSD-3-Clause
// Small compressed files with much in them: refused by a limit that the error names, in little memory and no more time than the
// limit takes.
#include "../restart/restart_files.h"
#include "../support/byte_source_packing.h"
#include "../support/memory_file.h"
#include "../support/own_folder.h"

#include "granular/common/error.h"
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/formats/euler/euler_file.h"
#include "granular/formats/restart/restart_file.h"
#include "granular/frames/run_index.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using Bombs = OwnFolder;

constexpr std::int64_t mebibyte = std::int64_t{ 1 } << 20;
constexpr std::int64_t beyond = 270 * mebibyte; ///< of content that is not read whatever its file
constexpr std::int64_t within = 250 * mebibyte;
constexpr std::int64_t usual = 64 * mebibyte; ///< of memory
/// The content of a restart file is held in memory, up to the limit, and copied as it grows.
constexpr std::int64_t of_restart = 2 * beyond + usual;

/// A part of a file: a header and as many equal rows as each other part has.
struct Part
{
  std::string header;
  std::string row;
};
using Parts = std::vector<Part> (*)(std::int64_t rows);

constexpr std::int64_t together = 1 << 16; ///< rows of a piece

/// The pieces of equal rows that fill so much content.
std::int64_t pieces_of(const Parts& parts, std::int64_t bytes)
{
  std::int64_t bytes_of_row = 0;
  for (const Part& part : parts(0))
  {
    bytes_of_row += static_cast<std::int64_t>(part.row.size());
  }
  return bytes / (bytes_of_row * together) + 1;
}

/// So much content, packed in pieces of equal rows.
template <class Pack>
std::string bomb(const Parts& parts, std::int64_t bytes, const Pack& pack)
{
  const std::int64_t pieces = pieces_of(parts, bytes);
  std::string packed;
  for (const Part& part : parts(pieces * together))
  {
    packed += pack(part.header);
    std::string rows;
    for (std::int64_t i = 0; i < together; ++i)
    {
      rows += part.row;
    }
    const std::string piece = pack(rows);
    for (std::int64_t i = 0; i < pieces; ++i)
    {
      packed += piece;
    }
  }
  return packed;
}

std::vector<Part> particles(std::int64_t rows)
{
  return { { "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(rows) +
      "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z\n",
    "1 1 0 0 0\n" } };
}

std::vector<Part> cells(std::int64_t rows)
{
  const std::string count = std::to_string(rows);
  std::vector<Part> parts = {
    { "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET POLYDATA\nPOINTS " +
        count + " float\n",
      "0.5 0.5 0.5\n" },
    { "VERTICES " + count + " " + std::to_string(2 * rows) + "\n", "1 0\n" },
    { "POINT_DATA " + count + "\nVECTORS v_avg float\n", "1 2 3\n" },
  };
  for (const char* const name : { "volumefraction", "radius", "pressure" })
  {
    parts.push_back({ std::string("SCALARS ") + name + " float 1\nLOOKUP_TABLE default\n", "1\n" });
  }
  return parts;
}

/// A restart file without the particles, of one process.
std::string restart_base(std::int64_t rows)
{
  restart_builder::RestartBuilder file;
  file.atoms = rows;
  return file.base();
}

/// The count of doubles and the particles of a process.
std::vector<Part> process(std::int64_t rows)
{
  const restart_builder::Record record = ::particles(1, 1).front();
  const auto doubles = static_cast<std::int32_t>(rows * static_cast<std::int64_t>(record.size()));
  return { { std::string(reinterpret_cast<const char*>(&doubles), sizeof doubles),
    std::string(reinterpret_cast<const char*>(record.data()), 8 * record.size()) } };
}

std::vector<Part> restart(std::int64_t rows)
{
  std::vector<Part> parts = process(rows);
  parts.front().header.insert(0, restart_base(rows));
  return parts;
}

std::string zstd(const std::string& content)
{
  return packing::zstd(content);
}

/// The error of opening; empty: none.
std::string error_of_opening(const std::string& path, const granular::FileFormat& format)
{
  return error_of(
    [&]
    {
      granular::RunIndex run;
      granular::Notices notices;
      granular::Progress progress;
      run.update({ path }, { .format = &format }, notices, progress);
    });
}

/// Expects that a file, which is opened by `base`, is refused by its limit, in at most so much more memory.
void expect_limit(const std::string& path, std::size_t bytes, const std::string& base,
  const granular::FileFormat& format, std::int64_t most)
{
  const std::int64_t before = restart_peak();
  const std::string error = error_of_opening(base, format);
  EXPECT_LT(peak_bytes() - before, most);
  EXPECT_TRUE(error.starts_with(path + "@")) << error;
  EXPECT_NE(error.find("expected content of at most 200 times the " + std::to_string(bytes) +
              " bytes of the file, got more; if you trust the file, unpack it first"),
    error.npos)
    << error;
}
}

TEST_F(Bombs, AreRefused)
{
  const auto gzip = [](const std::string& text) { return packing::gzip(text); };
  struct Kind
  {
    const char* name;
    Parts parts;
    const granular::FileFormat& format;
    std::int64_t most = usual;
  };
  const Kind kinds[] = {
    { "particles", particles, granular::dump_format() },
    { "cells", cells, granular::euler_format() },
    { "restart", restart, granular::restart_format(), of_restart },
  };
  for (const Kind& kind : kinds)
  {
    SCOPED_TRACE(kind.name);
    const std::string bytes = bomb(kind.parts, beyond, zstd);
    const std::string path = this->write(kind.name, bytes);
    expect_limit(path, bytes.size(), path, kind.format, kind.most);
  }
  const std::string bytes = bomb(particles, beyond, gzip);
  const std::string path = this->write("a.dump.gz", bytes);
  expect_limit(path, bytes.size(), path, granular::dump_format(), usual);
}

// The particles of a restart are in files of the processes, which the base does not mention.
TEST_F(Bombs, FileOfAProcess)
{
  const std::int64_t rows = pieces_of(process, beyond) * together;
  const std::string base = this->write("a.base.restart", restart_base(rows));
  const std::string bytes = bomb(process, beyond, zstd);
  expect_limit(
    this->write("a.0.restart", bytes), bytes.size(), base, granular::restart_format(), of_restart);
}

TEST_F(Bombs, SmallContentIsReadWhateverItsFile)
{
  const std::string path = this->write("a.dump.zst", bomb(particles, within, zstd));
  EXPECT_EQ(error_of_opening(path, granular::dump_format()), "");
}

// Members and frames without content: a million of them end, and are no seek points.
TEST_F(Bombs, EmptyParts)
{
  for (const std::string& empty :
    { packing::gzip(""), packing::zstd(""), packing::zstd_skippable("") })
  {
    std::string packed = empty;
    while (packed.size() < (std::size_t{ 4 } << 20))
    {
      packed += empty;
    }
    const auto points = packing::spaced(1);
    const auto source = packing::open(packed, points);
    EXPECT_EQ(packing::read_all(*source), "");
    EXPECT_LE(points->bytes(), std::size_t{ 1 } << 20);
  }
}
