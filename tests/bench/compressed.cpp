// SPDX-License-Identifier: BSD-3-Clause
// Compressed dumps: reading them in order against zlib and Zstandard themselves, indexing them, and
// reading one frame in the middle.
#include "bench.h"
#include "dump_frame.h"
#include "dump_text.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

#define ZLIB_CONST
#include <zlib.h>
#include <zstd.h>

namespace bench
{
namespace
{
/// What the readers take from a file and what they give, each at a time.
constexpr std::size_t window = std::size_t{ 1 } << 18;

/// The text of a run: frames of the same number of rows, which come back every few frames, much
/// further away than a compressor looks.
class Text
{
public:
  Text(std::int64_t frame_count, std::int64_t rows_a_frame)
    : frames(frame_count)
    , frame_rows(rows_a_frame)
    , rows_(make_rows(Form::Custom, frame_rows * std::min(frame_count, most_parts)))
  {
    const char* const last = rows_.text.data() + rows_.text.size();
    for (const char* first = rows_.text.data(); first != last;)
    {
      const char* end = first;
      for (std::int64_t row = 0; row < frame_rows; ++row)
      {
        end = std::find(end, last, '\n') + 1;
      }
      parts_.emplace_back(first, static_cast<std::size_t>(end - first));
      first = end;
    }
    for (std::int64_t i = 0; i < frames; ++i)
    {
      bytes += static_cast<std::int64_t>(this->head(i).size() + this->part(i).size());
    }
  }

  std::string head(std::int64_t frame) const
  {
    return header(100 * frame, frame_rows, 0, 1, Print::Full, rows_);
  }
  std::string_view part(std::int64_t frame) const { return parts_[this->part_of(frame)]; }
  std::size_t part_of(std::int64_t frame) const
  {
    return static_cast<std::size_t>(frame) % parts_.size();
  }
  std::size_t parts() const { return parts_.size(); }

  /// What a frame must become.
  Output truth(std::int64_t frame) const
  {
    Output output(rows_, frame_rows);
    std::vector<granular::ColumnSink> sinks = output.sinks(0);
    if (!parse_slowly(this->part(frame).data(), sinks, frame_rows))
    {
      throw std::logic_error("the benchmark's own text is wrong");
    }
    return output;
  }

  std::int64_t frames;
  std::int64_t frame_rows;
  std::int64_t bytes = 0;

private:
  static constexpr std::int64_t most_parts = 20;

  Rows rows_;
  std::vector<std::string_view> parts_; ///< of the rows, one a frame
};

/// One member of gzip, level 6. A part is compressed once, after a full flush, and its bytes are
/// used again: a full flush is an empty block of deflate before which nothing is looked up.
class GzipWriter
{
public:
  explicit GzipWriter(TemporaryFile& file)
    : file_(file)
  {
    if (deflateInit2(&stream_, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    {
      throw std::bad_alloc();
    }
    file_.append(std::string_view("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10));
  }
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;
  ~GzipWriter() { deflateEnd(&stream_); }

  struct Packed
  {
    std::string bytes;
    uLong check;
    std::size_t size; ///< of the content
  };

  Packed pack(std::string_view text)
  {
    std::string bytes(deflateBound(&stream_, text.size()) + 64, '\0');
    stream_.next_in = reinterpret_cast<const Bytef*>(text.data());
    stream_.avail_in = static_cast<uInt>(text.size());
    stream_.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream_.avail_out = static_cast<uInt>(bytes.size());
    deflate(&stream_, Z_FULL_FLUSH);
    bytes.resize(bytes.size() - stream_.avail_out);
    return { bytes, crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()),
      text.size() };
  }

  void append(const Packed& packed)
  {
    file_.append(packed.bytes);
    check_ = crc32_combine(check_, packed.check, static_cast<z_off_t>(packed.size));
    size_ += packed.size;
  }

  void finish()
  {
    std::string end = "\x03"; // an empty block, the last one
    end += '\0';
    for (const std::size_t field : { static_cast<std::size_t>(check_), size_ })
    {
      for (int shift = 0; shift < 32; shift += 8)
      {
        end += static_cast<char>(field >> shift & 0xff);
      }
    }
    file_.append(end);
  }

private:
  TemporaryFile& file_;
  z_stream stream_ = {};
  uLong check_ = 0;
  std::size_t size_ = 0;
};

void write_gzip(TemporaryFile& file, const Text& text)
{
  GzipWriter writer(file);
  std::vector<GzipWriter::Packed> parts;
  for (std::int64_t i = 0; i < text.frames; ++i)
  {
    writer.append(writer.pack(text.head(i)));
    if (parts.size() < text.parts())
    {
      parts.push_back(writer.pack(text.part(i)));
    }
    writer.append(parts[text.part_of(i)]);
  }
  writer.finish();
}

/// One frame of Zstandard, level 3, as the program zstd writes it.
void write_zstd(TemporaryFile& file, const Text& text)
{
  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context(
    ZSTD_createCCtx(), ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string bytes;
  const auto pack = [&](std::string_view piece, ZSTD_EndDirective end)
  {
    ZSTD_inBuffer input = { piece.data(), piece.size(), 0 };
    for (std::size_t left = 1; left > 0 && (input.pos < input.size || end == ZSTD_e_end);)
    {
      char out[1 << 17];
      ZSTD_outBuffer output = { out, sizeof out, 0 };
      left = ZSTD_compressStream2(context.get(), &output, &input, end);
      bytes.append(out, output.pos);
    }
  };
  for (std::int64_t i = 0; i < text.frames; ++i)
  {
    pack(text.head(i), ZSTD_e_continue);
    pack(text.part(i), ZSTD_e_continue);
  }
  pack({}, ZSTD_e_end);
  file.append(bytes);
}

void write_plain(TemporaryFile& file, const Text& text)
{
  for (std::int64_t i = 0; i < text.frames; ++i)
  {
    file.append(text.head(i));
    file.append(text.part(i));
  }
}

/// Content, in order.
class Stream
{
public:
  virtual ~Stream() = default;

  /// The next bytes: fewer than asked for only at the end.
  virtual std::size_t next(char* out, std::size_t bytes) = 0;
};

class OurStream final : public Stream
{
public:
  explicit OurStream(const std::string& path)
    : source_(granular::unpack(granular::open_file(path)))
  {
  }

  std::size_t next(char* out, std::size_t bytes) override
  {
    const std::size_t got = source_->read(offset_, out, bytes);
    offset_ += static_cast<std::int64_t>(got);
    return got;
  }

private:
  std::unique_ptr<granular::ByteSource> source_;
  std::int64_t offset_ = 0;
};

/// A file, a window at a time.
class Input
{
public:
  explicit Input(const std::string& path)
    : source_(granular::open_file(path))
    , buffer_(new char[window])
  {
  }

  std::string_view next()
  {
    const std::size_t got = source_->read(offset_, buffer_.get(), window);
    offset_ += static_cast<std::int64_t>(got);
    return { buffer_.get(), got };
  }

private:
  std::unique_ptr<granular::ByteSource> source_;
  std::unique_ptr<char[]> buffer_;
  std::int64_t offset_ = 0;
};

/// The yardstick: zlib reads the header, inflates and checks the CRC.
class ZlibStream final : public Stream
{
public:
  explicit ZlibStream(const std::string& path)
    : input_(path)
  {
    if (inflateInit2(&stream_, 16 + MAX_WBITS) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ~ZlibStream() override { inflateEnd(&stream_); }

  std::size_t next(char* out, std::size_t bytes) override
  {
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(bytes);
    int status = Z_OK;
    while (stream_.avail_out > 0 && status == Z_OK)
    {
      if (stream_.avail_in == 0)
      {
        const std::string_view packed = input_.next();
        stream_.next_in = reinterpret_cast<const Bytef*>(packed.data());
        stream_.avail_in = static_cast<uInt>(packed.size());
      }
      status = inflate(&stream_, Z_NO_FLUSH);
    }
    return bytes - stream_.avail_out;
  }

private:
  Input input_;
  z_stream stream_ = {};
};

/// The yardstick: Zstandard alone, which checks its own sums.
class ZstdStream final : public Stream
{
public:
  explicit ZstdStream(const std::string& path)
    : input_(path)
    , stream_(ZSTD_createDStream(), ZSTD_freeDStream)
  {
  }

  std::size_t next(char* out, std::size_t bytes) override
  {
    ZSTD_outBuffer output = { out, bytes, 0 };
    for (bool more = true; more && output.pos < output.size;)
    {
      if (packed_.pos == packed_.size)
      {
        const std::string_view packed = input_.next();
        packed_ = { packed.data(), packed.size(), 0 };
      }
      more = ZSTD_decompressStream(stream_.get(), &output, &packed_) != 0 &&
        (packed_.size > 0 || output.pos == output.size);
    }
    return output.pos;
  }

private:
  Input input_;
  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream_;
  ZSTD_inBuffer packed_ = { nullptr, 0, 0 };
};

using OpenStream = std::function<std::unique_ptr<Stream>()>;

template <typename T>
OpenStream opener(const TemporaryFile& file)
{
  return [&file] { return std::make_unique<T>(file.path()); };
}

/// Reads on where it stopped, and from the start again after the end.
class Reading
{
public:
  explicit Reading(OpenStream open)
    : open_(std::move(open))
    , buffer_(window)
  {
  }

  /// Whether there were as many bytes; with last, the end must come behind them.
  bool read(std::int64_t bytes, bool last)
  {
    if (!stream_)
    {
      stream_ = open_();
    }
    for (std::int64_t got = 1; got > 0 && bytes > 0; bytes -= got)
    {
      const auto wanted = std::min(static_cast<std::int64_t>(window), bytes);
      got =
        static_cast<std::int64_t>(stream_->next(buffer_.data(), static_cast<std::size_t>(wanted)));
    }
    bool right = bytes == 0;
    if (last)
    {
      right = stream_->next(buffer_.data(), 1) == 0 && right;
      stream_.reset();
    }
    return right;
  }

private:
  OpenStream open_;
  std::unique_ptr<Stream> stream_;
  std::vector<char> buffer_;
};

/// Whether a stream gives the text.
bool gives(Stream& stream, const Text& text)
{
  std::string buffer;
  for (std::int64_t i = 0; i < text.frames; ++i)
  {
    const std::string head = text.head(i);
    for (const std::string_view piece : { std::string_view(head), text.part(i) })
    {
      buffer.resize(piece.size());
      if (stream.next(buffer.data(), buffer.size()) != piece.size() || buffer != piece)
      {
        return false;
      }
    }
  }
  return stream.next(buffer.data(), 1) == 0;
}

/// In order. A round is a part of the file, so that both contenders have it in turns soon.
void measure_reading(benchmark::State& state, const Text& text, const OpenStream& library,
  const OpenStream& ours, std::int64_t round_bytes)
{
  if (!gives(*library(), text) || !gives(*ours(), text))
  {
    fail(state, "the bytes differ from those that were compressed");
    return;
  }
  Reading library_reading(library);
  Reading our_reading(ours);
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
  const auto last = [&] { return offset + bytes == text.bytes; };
  Rounds rounds;
  rounds.add("library", [&] { return library_reading.read(bytes, last()); });
  rounds.add("ours", [&] { return our_reading.read(bytes, last()); });
  for (auto _ : state)
  {
    bytes = std::min(round_bytes, text.bytes - offset);
    if (!rounds.run(static_cast<double>(bytes)))
    {
      fail(state, "there are more or fewer bytes than were compressed");
      return;
    }
    offset = last() ? 0 : offset + bytes;
    state.SetIterationTime(rounds.of("ours").back() * static_cast<double>(bytes));
  }
  tell(state, "library", 1e-6 / median(rounds.of("library")), "MB/s");
  tell(state, "ours", 1e-6 / median(rounds.of("ours")), "MB/s");
  tell(state, "time against library", median_ratio(rounds.of("ours"), rounds.of("library")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("ours"), rounds.of("library")), "1");
}

/// Whether the index has every frame where it is in the text.
bool lists(const granular::RunIndex& index, const Text& text)
{
  bool right = static_cast<std::int64_t>(index.size()) == text.frames;
  std::int64_t end = 0;
  for (std::int64_t i = 0; right && i < text.frames; ++i)
  {
    const granular::FrameEntry& frame = index.first_piece(static_cast<std::size_t>(i)).entry;
    right = frame.timestep == 100 * i && frame.rows == text.frame_rows && frame.offset == end;
    end += static_cast<std::int64_t>(text.head(i).size() + text.part(i).size());
    right = right && frame.end == end;
  }
  return right;
}

void measure_index(benchmark::State& state, const Text& text, const OpenStream& library,
  const TemporaryFile& packed, const TemporaryFile& plain)
{
  granular::RunIndex of_packed;
  granular::RunIndex of_plain;
  Reading reading(library);
  Rounds rounds;
  rounds.add("library", [&] { return reading.read(text.bytes, true); });
  rounds.add("index",
    [&]
    {
      of_packed = index_of({ packed.path() });
      return true;
    });
  rounds.add("plain",
    [&]
    {
      of_plain = index_of({ plain.path() });
      return true;
    });
  for (auto _ : state)
  {
    const bool right = rounds.run(static_cast<double>(text.bytes));
    if (!right || !lists(of_packed, text) || !lists(of_plain, text))
    {
      fail(state, "the index does not hold the frames of the file");
      return;
    }
    state.SetIterationTime(rounds.of("index").back() * static_cast<double>(text.bytes));
  }
  tell(state, "library", 1e-6 / median(rounds.of("library")), "MB/s");
  tell(state, "ours", 1e-6 / median(rounds.of("index")), "MB/s");
  tell(state, "time against library", median_ratio(rounds.of("index"), rounds.of("library")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("index"), rounds.of("library")), "1");
  tell(state, "time against plain text", median_ratio(rounds.of("index"), rounds.of("plain")), "1");
  const auto& points = of_packed.files().front().points;
  tell(state, "seek points", points ? static_cast<double>(points->points.size()) : 0, "count");
  tell(state, "seek points",
    points ? static_cast<double>(points->bytes()) / static_cast<double>(1 << 20) : 0, "MiB");
}

/// The frame in the middle, from a file that has just been opened.
void measure_frame(benchmark::State& state, const Text& text, const TemporaryFile& packed,
  const TemporaryFile& plain)
{
  const std::int64_t middle = text.frames / 2;
  const auto number = static_cast<std::size_t>(middle);
  const Output truth = text.truth(middle);
  const granular::RunIndex of_packed = index_of({ packed.path() });
  const granular::RunIndex of_plain = index_of({ plain.path() });
  const granular::FrameEntry& entry = of_packed.first_piece(number).entry;
  granular::DumpFrame frames[3];
  Rounds rounds;
  const auto add = [&](const char* name, auto read, granular::DumpFrame& frame)
  {
    rounds.add(name,
      [read, &frame]
      {
        frame = read();
        return true;
      });
  };
  add(
    "indexed", [&] { return read_frame(of_packed, number); }, frames[0]);
  add(
    "from the start",
    [&] { return read_frame(*granular::unpack(granular::open_file(packed.path())), entry); },
    frames[1]);
  add(
    "plain", [&] { return read_frame(of_plain, number); }, frames[2]);
  for (auto _ : state)
  {
    rounds.run(1);
    if (!std::all_of(std::begin(frames), std::end(frames),
          [&](const granular::DumpFrame& frame) { return holds(frame, truth, text.frame_rows); }))
    {
      fail(state, "values differ from strtod's");
      return;
    }
    state.SetIterationTime(rounds.of("indexed").back());
  }
  for (const char* const name : { "indexed", "from the start", "plain" })
  {
    tell(state, name, 1e3 * median(rounds.of(name)), "ms");
  }
  tell(state, "time against the start",
    median_ratio(rounds.of("indexed"), rounds.of("from the start")), "1");
}

/// The files, made when the first benchmark runs and shared by all.
struct Files
{
  explicit Files(const Size& size)
    : text(size.pick(190, 3), size.pick(10'000, 500))
  {
    write_gzip(gzip, text);
    write_zstd(zstd, text);
    write_plain(plain, text);
  }

  Text text;
  TemporaryFile gzip;
  TemporaryFile zstd;
  TemporaryFile plain;
};
}

void add_benchmarks(const Size& size)
{
  const auto files = std::make_shared<Files>(size);
  struct Case
  {
    const char* name;
    const TemporaryFile& file;
    OpenStream library;
    std::int64_t rounds;
  };
  const Case cases[] = {
    { "gzip", files->gzip, opener<ZlibStream>(files->gzip), size.pick(20, 1) },
    { "zstd", files->zstd, opener<ZstdStream>(files->zstd), size.pick(20, 1) },
  };
  const std::int64_t round_bytes = size.full ? std::int64_t{ 1 } << 24 : files->text.bytes;
  for (const Case& each : cases)
  {
    const std::string name = std::string("compressed/") + each.name;
    add(name + ", in order", each.rounds,
      [files, each, round_bytes](benchmark::State& state) {
        measure_reading(
          state, files->text, each.library, opener<OurStream>(each.file), round_bytes);
      });
    add(name + ", index", size.pick(5, 1),
      [files, each](benchmark::State& state)
      { measure_index(state, files->text, each.library, each.file, files->plain); });
    add(name + ", frame in the middle", size.pick(7, 1),
      [files, each](benchmark::State& state)
      { measure_frame(state, files->text, each.file, files->plain); });
  }
}
}
