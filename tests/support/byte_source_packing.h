// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_byte_source_packing_h
#define granular_tests_support_byte_source_packing_h

#include "granular/bytes/byte_source_unpack.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

/// What is packed by the libraries themselves, and what is done with it.
namespace packing
{
/// Lines as a dump has them; the same for the same seed.
std::string rows(std::size_t bytes, unsigned seed = 1);

struct GzipOptions
{
  int level = 6;
  int strategy = 0;            ///< Z_DEFAULT_STRATEGY
  bool all_fields = false;     ///< of the header: extra, name, comment and CRC
  std::size_t flush_every = 0; ///< bytes of content after which a block of deflate ends; 0: never
};

/// One member.
std::string gzip(std::string_view content, const GzipOptions& options = {});

struct ZstdOptions
{
  int level = 3;
  bool check = true;
  bool size = true; ///< of the content, in the header
};

/// One frame.
std::string zstd(std::string_view content, const ZstdOptions& options = {});

/// As zstd itself does with `zstd -B`: many frames.
std::string zstd_frames(std::string_view content, std::size_t frame_bytes);

/// A frame to be passed over.
std::string zstd_skippable(std::string_view bytes, char kind = '\x50');

/// Seek points that far apart.
std::shared_ptr<granular::SeekPoints> spaced(std::int64_t spacing);

/// That a packed file is known as one, whole, and has that content, however it is read.
void expect_content(const std::string& packed, const std::string& content);

/// The library that unpacks gzip in what follows; null: the one that users have.
extern const granular::Inflation* inflation;

std::unique_ptr<granular::ByteSource> unpack(std::unique_ptr<granular::ByteSource> packed,
  std::shared_ptr<granular::SeekPoints> points = nullptr);

std::unique_ptr<granular::ByteSource> open(std::string_view packed,
  std::shared_ptr<granular::SeekPoints> points = nullptr, std::string name = "packed");

/// From an offset to the end, in pieces.
std::string read_all(
  const granular::ByteSource& source, std::size_t piece = 1 << 18, std::int64_t offset = 0);

/// The text of the error that reading all of it throws; empty: none.
std::string error_of(std::string_view packed);

/// Bytes in memory that count how many of them were read, may become more, and may fail.
struct Medium
{
  std::string bytes;
  std::int64_t read = 0;
  bool broken = false; ///< reading throws IoError
};
std::unique_ptr<granular::ByteSource> open_medium(Medium& medium);

/// What became of files that are not as they were written.
struct Outcomes
{
  int exact = 0;     ///< the content
  int refused = 0;   ///< FormatError or LimitError
  int unchecked = 0; ///< a part of the content or not, but with a word
  int plain = 0;     ///< no longer taken for a compressed file
  int silent = 0;    ///< something else without a word
};

/// Reads all of a packed file, and counts what came of it.
void judge(std::string_view packed, std::string_view content, Outcomes& outcomes);

/// Every byte set to other values, one at a time.
Outcomes damage(const std::string& packed, std::string_view content);

/// Cuts a file at every length. complete says of which lengths nothing is to be said.
void expect_prefixes(const std::string& packed, std::string_view content,
  const std::function<bool(std::size_t)>& complete);

/// Expects that a damaged file ends with the same FormatError wherever it is read from. Returns the byte of the last.
std::int64_t expect_same_error(const std::string& packed);

/// Expects ever more of the content of a file that grows, is opened anew and has kept its seek points.
void expect_growth_between_sources(
  const std::string& packed, const std::string& content, const std::string& cut_text);

/// Expects the content of a file that grows byte by byte while it is open.
void expect_growth_while_open(const std::string& packed, const std::string& content);

/// Expects that random reads find seek points, and that a later source finds its way by them and finds no others. medium has
/// six MiB of content, and the spacing is 2^17. Returns the points.
std::shared_ptr<granular::SeekPoints> expect_points_to_serve(
  Medium& medium, const std::string& content, unsigned seed);

/// Reads of random places and lengths, compared with the content. near: most of them go on from
/// where the last one ended, or a bit before.
void expect_random_reads(
  const granular::ByteSource& source, std::string_view content, int reads, unsigned seed);
}
#endif
