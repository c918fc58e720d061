// SPDX-License-Identifier: BSD-3-Clause
#include "byte_source_packing.h"
#include "error_of.h"

#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#define ZLIB_CONST
#include <zlib.h>
#include <zstd.h>

namespace packing
{
using granular::ByteSource;
using granular::SeekPoints;

std::string rows(std::size_t bytes, unsigned seed)
{
  std::minstd_rand random(seed);
  std::string text;
  text.reserve(bytes + 64);
  for (int id = 1; text.size() < bytes; ++id)
  {
    text += std::to_string(id) + " 1";
    for (int column = 0; column < 4; ++column)
    {
      text += " 0." + std::to_string(random() % 1000000);
    }
    text += '\n';
  }
  text.resize(bytes);
  return text;
}

std::string gzip(std::string_view content, const GzipOptions& options)
{
  z_stream stream = {};
  EXPECT_EQ(deflateInit2(&stream, options.level, Z_DEFLATED, 31, 8, options.strategy), Z_OK);
  gz_header header = {};
  std::string extra = "extra field", name = "grains.dump", comment = "a comment";
  if (options.all_fields)
  {
    header.extra = reinterpret_cast<Bytef*>(extra.data());
    header.extra_len = static_cast<uInt>(extra.size());
    header.name = reinterpret_cast<Bytef*>(name.data());
    header.comment = reinterpret_cast<Bytef*>(comment.data());
    header.hcrc = 1;
    header.time = 1700000000;
    header.text = 1;
    EXPECT_EQ(deflateSetHeader(&stream, &header), Z_OK);
  }
  std::string packed(
    deflateBound(&stream, static_cast<uLong>(content.size())) + content.size() / 8 + 4096, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const std::size_t step = options.flush_every > 0 ? options.flush_every : content.size();
  for (std::size_t at = 0; at < content.size(); at += step)
  {
    stream.next_in = reinterpret_cast<const Bytef*>(content.data() + at);
    stream.avail_in = static_cast<uInt>(std::min(step, content.size() - at));
    EXPECT_EQ(deflate(&stream, options.flush_every > 0 ? Z_BLOCK : Z_NO_FLUSH), Z_OK);
  }
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  EXPECT_EQ(deflateEnd(&stream), Z_OK);
  return packed;
}

std::string zstd(std::string_view content, const ZstdOptions& options)
{
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, options.level);
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, options.check ? 1 : 0);
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, options.size ? 1 : 0);
  std::string packed(ZSTD_compressBound(content.size()), '\0');
  const std::size_t size =
    ZSTD_compress2(context, packed.data(), packed.size(), content.data(), content.size());
  ZSTD_freeCCtx(context);
  EXPECT_FALSE(ZSTD_isError(size));
  packed.resize(size);
  return packed;
}

std::string zstd_frames(std::string_view content, std::size_t frame_bytes)
{
  std::string packed;
  for (std::size_t at = 0; at < content.size(); at += frame_bytes)
  {
    packed += zstd(content.substr(at, frame_bytes), { 1 });
  }
  return packed;
}

std::string zstd_skippable(std::string_view bytes, char kind)
{
  std::string frame = std::string(1, kind) + "\x2a\x4d\x18";
  for (unsigned i = 0; i < 4; ++i)
  {
    frame += static_cast<char>(bytes.size() >> (8 * i) & 0xff);
  }
  return frame.append(bytes);
}

const granular::Inflation* inflation = nullptr;

std::unique_ptr<ByteSource> unpack(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<SeekPoints> points)
{
  char first = 0;
  if (inflation == nullptr || packed->read(0, &first, 1) == 0 || first != '\x1f')
  {
    return granular::unpack(std::move(packed), std::move(points));
  }
  const auto make = [](const ByteSource& source, std::shared_ptr<SeekPoints> found)
  { return granular::make_gzip_decoder(source, std::move(found), *inflation); };
  return granular::unpack_by(make, std::move(packed), std::move(points));
}

std::unique_ptr<ByteSource> open(
  std::string_view packed, std::shared_ptr<granular::SeekPoints> points, std::string name)
{
  return packing::unpack(granular::open_memory(packed, std::move(name)), std::move(points));
}

std::string read_all(const ByteSource& source, std::size_t piece, std::int64_t offset)
{
  std::string text;
  std::vector<char> buffer(piece);
  for (std::size_t got = piece; got == piece;)
  {
    got = source.read(offset + static_cast<std::int64_t>(text.size()), buffer.data(), piece);
    text.append(buffer.data(), got);
  }
  return text;
}

std::string error_of(std::string_view packed)
{
  return ::error_of([&] { read_all(*open(packed)); });
}

namespace
{
class MediumSource final : public ByteSource
{
public:
  explicit MediumSource(Medium& medium)
    : medium_(medium)
  {
  }

  const std::string& path() const override { return path_; }

  granular::FileStamp stamp() const override
  {
    granular::FileStamp stamp;
    stamp.size = static_cast<std::int64_t>(medium_.bytes.size());
    return stamp;
  }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    if (medium_.broken)
    {
      throw granular::IoError("cannot read: Input/output error", { path_ }, std::errc::io_error);
    }
    const std::size_t got = granular::open_memory(medium_.bytes)->read(offset, buffer, bytes);
    medium_.read += static_cast<std::int64_t>(got);
    return got;
  }

private:
  Medium& medium_;
  std::string path_ = "medium";
};
}

std::unique_ptr<ByteSource> open_medium(Medium& medium)
{
  return std::make_unique<MediumSource>(medium);
}

void judge(std::string_view packed, std::string_view content, Outcomes& outcomes)
{
  const auto source = open(packed);
  if (!source->compressed())
  {
    ++outcomes.plain;
    return;
  }
  try
  {
    const std::string text = read_all(*source);
    int& outcome = !source->unchecked().empty() ? outcomes.unchecked
      : text == content                         ? outcomes.exact
                                                : outcomes.silent;
    ++outcome;
  }
  catch (const granular::Error& error)
  {
    EXPECT_TRUE(dynamic_cast<const granular::FormatError*>(&error) != nullptr ||
      dynamic_cast<const granular::LimitError*>(&error) != nullptr);
    EXPECT_GE(error.where().byte, 0) << error.what();
    EXPECT_LE(error.where().byte, static_cast<std::int64_t>(packed.size())) << error.what();
    ++outcomes.refused;
    char byte = 0;
    EXPECT_THROW(source->read(0, &byte, 1), granular::Error) << "once damaged, for ever";
  }
}

Outcomes damage(const std::string& packed, std::string_view content)
{
  Outcomes outcomes;
  for (std::size_t at = 0; at < packed.size(); ++at)
  {
    const auto was = static_cast<unsigned char>(packed[at]);
    for (const int value : { was ^ 1, was ^ 0x80, was + 1, 0, 255 })
    {
      std::string other = packed;
      other[at] = static_cast<char>(value);
      if (other != packed)
      {
        judge(other, content, outcomes);
      }
    }
  }
  return outcomes;
}

void expect_prefixes(const std::string& packed, std::string_view content,
  const std::function<bool(std::size_t)>& complete)
{
  // of a single byte nobody can tell
  for (std::size_t length = 2; length <= packed.size(); ++length)
  {
    const auto source = open(std::string_view(packed).substr(0, length));
    ASSERT_TRUE(source->compressed()) << length;
    const std::string text = read_all(*source);
    EXPECT_EQ(text, content.substr(0, text.size())) << length;
    EXPECT_EQ(source->unchecked().empty(), complete(length)) << length;
    EXPECT_TRUE(length < packed.size() || text == content);
  }
}

std::int64_t expect_same_error(const std::string& packed)
{
  const auto source = open(packed);
  std::vector<char> buffer(1 << 20);
  EXPECT_EQ(source->read(0, buffer.data(), 1000), 1000u);
  std::string first;
  std::int64_t byte = -1;
  for (const std::int64_t offset : { 2 << 20, 0, 3 << 20, 1 << 20, 1 << 30 })
  {
    try
    {
      read_all(*source, buffer.size(), offset); // to the checksum, where it may be seen first
      ADD_FAILURE() << offset;
    }
    catch (const granular::FormatError& error)
    {
      first = first.empty() ? error.what() : first;
      EXPECT_EQ(error.what(), first);
      byte = error.where().byte;
    }
  }
  return byte;
}

void expect_growth_between_sources(
  const std::string& packed, const std::string& content, const std::string& cut_text)
{
  const auto points = spaced(1 << 17);
  std::size_t last = 0;
  for (const std::size_t part : { 3u, 5u, 6u, 8u })
  {
    const auto source = open(std::string_view(packed).substr(0, packed.size() * part / 8), points);
    const std::string text = read_all(*source, 1 << 16);
    EXPECT_TRUE(text == content.substr(0, text.size()));
    EXPECT_GT(text.size(), last);
    EXPECT_EQ(source->unchecked(), part < 8 ? cut_text : "");
    last = text.size();
  }
  EXPECT_EQ(last, content.size());
}

void expect_growth_while_open(const std::string& packed, const std::string& content)
{
  Medium medium{ packed.substr(0, 3) };
  const auto source = packing::unpack(open_medium(medium));
  std::string text;
  for (std::size_t size = 4; size <= packed.size(); ++size)
  {
    medium.bytes = packed.substr(0, size);
    text += read_all(*source, 100, static_cast<std::int64_t>(text.size()));
  }
  EXPECT_EQ(text, content);
  EXPECT_EQ(source->unchecked(), "");
}

std::shared_ptr<SeekPoints> expect_points_to_serve(
  Medium& medium, const std::string& content, unsigned seed)
{
  const auto points = spaced(1 << 17);
  expect_random_reads(*packing::unpack(open_medium(medium), points), content, 600, seed);
  const std::size_t found = points->points.size();

  // Another source goes to the end at once, and finds no points that were not there.
  medium.read = 0;
  const auto again = packing::unpack(open_medium(medium), points);
  EXPECT_TRUE(read_all(*again, 1000, (6 << 20) - 5000) == content.substr((6 << 20) - 5000));
  EXPECT_EQ(again->unchecked(), "");
  EXPECT_LT(medium.read, 600000);
  EXPECT_GT(medium.bytes.size(), 2000000u);
  expect_random_reads(*again, content, 150, seed + 1);
  EXPECT_EQ(points->points.size(), found);
  return points;
}

void expect_random_reads(
  const ByteSource& source, std::string_view content, int reads, unsigned seed)
{
  std::minstd_rand random(seed);
  const auto below = [&](std::size_t limit)
  { return (std::size_t{ random() } << 16 ^ random()) % limit; };
  std::string buffer;
  std::size_t offset = 0;
  for (int i = 0; i < reads; ++i)
  {
    const std::size_t choice = below(8);
    const std::size_t back = below(50000);
    offset = choice < 2 ? below(content.size() + 10)
      : choice < 5      ? offset - std::min(offset, back)
                        : offset + (choice < 7 ? 0 : back);
    buffer.assign(below(choice == 0 ? 300000 : 3000), '\0');
    const std::size_t got =
      source.read(static_cast<std::int64_t>(offset), buffer.data(), buffer.size());
    const std::string_view expected =
      content.substr(std::min(offset, content.size()), buffer.size());
    ASSERT_EQ(got, expected.size()) << "read " << i << " at " << offset;
    ASSERT_TRUE(buffer.compare(0, got, expected) == 0) << "read " << i << " at " << offset;
    offset += got;
  }
}

std::shared_ptr<granular::SeekPoints> spaced(std::int64_t spacing)
{
  auto points = std::make_shared<granular::SeekPoints>();
  points->spacing = spacing;
  return points;
}

void expect_content(const std::string& packed, const std::string& content)
{
  const auto source = open(packed);
  EXPECT_TRUE(source->compressed());
  EXPECT_FALSE(source->concurrent());
  EXPECT_TRUE(read_all(*source) == content);
  EXPECT_EQ(source->unchecked(), "");
  EXPECT_TRUE(read_all(*open(packed), 1000) == content);
}
}
