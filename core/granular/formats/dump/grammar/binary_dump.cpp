// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/binary_dump.h"

#include "granular/formats/dump/grammar/atom_fit.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace granular
{
namespace
{
/// The end of the frame; nothing if the source ends before it. Throws FormatError if the chunks do
/// not add up.
std::optional<std::int64_t> find_end(
  const ByteSource& source, const BinaryHeader& header, bool swapped, Progress& progress)
{
  BinaryCursor cursor(source, header.chunks_offset, swapped);
  constexpr std::int64_t step = std::int64_t{ 1 } << 24;
  std::int64_t values = 0;
  std::int64_t end = header.chunks_offset;
  for (std::int32_t chunk = 0; chunk < header.chunks; ++chunk)
  {
    const Where where{ source.path(), 0, cursor.offset() };
    const auto n = cursor.take<std::int32_t>();
    if (cursor.ended())
    {
      return std::nullopt;
    }
    values += n;
    if (n < 0 || n % header.size_one != 0 || values > header.values())
    {
      throw FormatError("expected the number of values in a chunk, a multiple of " +
          std::to_string(header.size_one) + " and " + std::to_string(header.values()) +
          " in all, got " + std::to_string(n),
        where);
    }
    // compressed data are decompressed on the way: not all in one go
    for (end = cursor.offset(); source.compressed() && end + step < cursor.offset() + 8LL * n;
         end += step)
    {
      char byte = 0;
      source.read(end, &byte, 1);
      progress.step(source.fraction(end));
    }
    end = cursor.offset() + 8LL * n;
    cursor.go_to(end);
  }
  if (values != header.values())
  {
    throw FormatError("expected " + std::to_string(header.values()) + " values, got " +
        std::to_string(values) + " in " + std::to_string(header.chunks) + " chunks",
      { source.path(), 0, header.chunks_offset });
  }
  char last = 0;
  return source.read(end - 1, &last, 1) == 1 ? std::optional(end) : std::nullopt;
}

/// Measures of the fit of a layout to the first frame.
struct Fit
{
  enum Grade
  {
    Impossible,
    Cut,   ///< the source ends within the frame
    Alone, ///< what follows is no header
    Whole
  };

  Grade grade = Impossible;
  bool has_header = false; ///< a whole one
  int faults = 0;          ///< of the header
  std::optional<FormatError> error;
};

Fit try_layout(const ByteSource& source, const BinaryLayout& layout, Progress& progress)
{
  const HeaderCheck check = check_binary_header(source, layout);
  Fit fit = { Fit::Impossible, check.header.has_value(), check.faults, check.error };
  if (check.error && !check.header)
  {
    return fit;
  }
  try
  {
    const auto end =
      check.header ? find_end(source, *check.header, layout.swapped, progress) : std::nullopt;
    fit.grade = end ? Fit::Alone : Fit::Cut;
    if (end)
    {
      read_binary_header(source, *end, layout);
      fit.grade = Fit::Whole;
    }
    if (check.error)
    {
      // a box may be none because the simulation failed: then all else must fit
      fit.grade = fit.grade == Fit::Whole ? Fit::Alone : Fit::Impossible;
    }
  }
  catch (const FormatError& error)
  {
    fit.grade = check.error ? Fit::Impossible : fit.grade;
    fit.error = check.error ? check.error : error;
  }
  return fit;
}

/// The layout that fits best, of several the likeliest. Throws what is wrong with the one that has the
/// fewest faults, if none does.
int find_layout(const ByteSource& source, Progress& progress)
{
  std::vector<Fit> fits;
  for (const BinaryLayout& layout : binary_layouts())
  {
    fits.push_back(try_layout(source, layout, progress));
    if (fits.back().grade == Fit::Whole)
    {
      break;
    }
  }
  const auto best = std::ranges::max_element(
    fits, {}, [](const Fit& fit) { return std::pair(fit.grade, -fit.faults); });
  if (best->grade == Fit::Impossible)
  {
    const bool magic = binary_layouts()[static_cast<std::size_t>(best - fits.begin())].magic;
    throw FormatError(
      best->error->text() + (magic ? "" : "; no known layout of a binary dump fits"),
      best->error->where());
  }
  return static_cast<int>(best - fits.begin());
}

/// The first header from offset on, of a whole frame of as many columns that has rows.
std::optional<BinaryHeader> find_rows(
  const ByteSource& source, std::int64_t offset, const BinaryLayout& layout)
{
  Progress progress;
  try
  {
    std::int32_t size_one = 0;
    while (const auto header = read_binary_header(source, offset, layout))
    {
      const auto end = find_end(source, *header, layout.swapped, progress);
      size_one = size_one == 0 ? header->size_one : size_one;
      if (!end || header->size_one != size_one || header->frame.rows > 0)
      {
        return end && header->size_one == size_one ? header : std::nullopt;
      }
      offset = *end;
    }
  }
  catch (const FormatError&)
  {
    // not a row to show
  }
  return std::nullopt;
}

/// Finds the frames of a binary file, one after the other.
class Indexer
{
public:
  Indexer(const ByteSource& source, FileIndex& index, Progress& progress)
    : source_(source)
    , index_(index)
    , progress_(progress)
  {
  }

  void run()
  {
    try
    {
      // a text there was before does not count
      const int known = index_.frames.empty() ? FrameKind::text : index_.frames.back().kind->layout;
      layout_ = known == FrameKind::text ? find_layout(source_, progress_) : known;
      for (int frame = 0; this->next_frame(); ++frame)
      {
        constexpr int report = 256;
        if (frame % report == 0)
        {
          progress_.step(source_.fraction(index_.resume_offset));
        }
      }
    }
    catch (const FormatError& error)
    {
      if (source_.compressed())
      {
        throw; // it may be the compressed data that are damaged: then nothing of them can be trusted
      }
      set_defect(index_, { error.where(), error.text() });
      if (!index_.frames.empty())
      {
        index_.notices.push_back(
          { error.where(), error.text() + "; the frame and all that follow are left out" });
      }
    }
  }

private:
  /// False at the end of the file, and where a frame is not complete.
  bool next_frame()
  {
    const BinaryLayout& layout = binary_layouts()[static_cast<std::size_t>(layout_)];
    const auto header = read_binary_header(source_, index_.resume_offset, layout);
    const auto end = header ? find_end(source_, *header, layout.swapped, progress_) : std::nullopt;
    if (!end)
    {
      char byte = 0;
      if (source_.read(index_.resume_offset, &byte, 1) > 0)
      {
        set_defect(index_,
          { { source_.path(), 0, index_.resume_offset },
            "expected a complete frame, got the end of the file in it" });
      }
      return false;
    }
    if (!header->frame.units.empty())
    {
      index_.units = header->frame.units;
    }
    FrameEntry entry;
    entry.timestep = header->frame.timestep;
    entry.rows = header->frame.rows;
    entry.offset = index_.resume_offset;
    entry.end = *end;
    entry.time = header->frame.time.value_or(FrameEntry::no_time);
    entry.kind = this->kind(*header);
    entry.shape = hash_shape(header->frame, *entry.kind);
    index_.frames.push_back(std::move(entry));
    index_.resume_offset = *end;
    return true;
  }

  std::shared_ptr<const FrameKind> kind(const BinaryHeader& header)
  {
    const bool unnamed = header.columns.empty();
    const AtomFit fit = unnamed && index_.column_names.empty()
      ? fit_atom(source_, header, binary_layouts()[static_cast<std::size_t>(layout_)])
      : AtomFit{};
    const bool same = kind_ && kind_->units == index_.units && columns_ == header.columns &&
      fit_ == fit && kind_->schema.columns().size() == static_cast<std::size_t>(header.size_one);
    if (!same)
    {
      index_.unnamed = index_.unnamed || unnamed;
      const UnnamedColumns columns = unnamed
        ? name_columns(static_cast<std::size_t>(header.size_one), index_.column_names, fit)
        : UnnamedColumns{ header.columns };
      ColumnSchema schema = this->schema(columns.names, header);
      kind_ = index_.kinds->share(
        { std::move(schema), index_.units, layout_, columns.named, columns.guessed });
      columns_ = header.columns;
      fit_ = fit;
    }
    return kind_;
  }

  ColumnSchema schema(const std::vector<std::string>& names, const BinaryHeader& header)
  {
    if (names.size() != static_cast<std::size_t>(header.size_one))
    {
      const bool of_user = header.columns.empty();
      throw FormatError("expected " + std::to_string(header.size_one) +
          (of_user ? " names in ColumnNames, got " : " column names, got ") +
          std::to_string(names.size()) +
          (of_user ? describe_first_row(source_, index_.resume_offset,
                       binary_layouts()[static_cast<std::size_t>(layout_)])
                   : ""),
        { source_.path(), 0, header.size_one_offset });
    }
    return binary_schema(names);
  }

  const ByteSource& source_;
  FileIndex& index_;
  Progress& progress_;
  int layout_ = 0;
  std::shared_ptr<const FrameKind> kind_; ///< of the frame before: most have the same
  std::vector<std::string> columns_;      ///< as its header names them
  AtomFit fit_;                           ///< if it does not, nor does the user
};
}

bool holds_binary(std::string_view first_bytes) noexcept
{
  constexpr std::size_t enough = 64;
  return std::ranges::any_of(
    first_bytes.substr(0, enough), [](char c) { return static_cast<unsigned char>(c) < '\b'; });
}

bool is_binary_dump(std::string_view first_bytes)
{
  if (!holds_binary(first_bytes))
  {
    return false;
  }
  const std::unique_ptr<ByteSource> source = open_memory(first_bytes);
  Progress progress;
  return std::ranges::any_of(binary_layouts(),
    [&](const BinaryLayout& layout)
    {
      const Fit fit = try_layout(*source, layout, progress);
      // a header with texts may be long, but the magic word is enough
      constexpr std::size_t word = 24;
      return fit.grade != Fit::Impossible && fit.faults == 0 &&
        (fit.has_header || (layout.magic && first_bytes.size() >= word));
    });
}

std::string describe_first_row(
  const ByteSource& source, std::int64_t offset, const BinaryLayout& layout)
{
  constexpr std::int32_t most = 16;
  const std::optional<BinaryHeader> header = find_rows(source, offset, layout);
  if (!header)
  {
    return {};
  }
  BinaryCursor cursor(source, header->chunks_offset, layout.swapped);
  while (cursor.take<std::int32_t>() == 0 && !cursor.ended())
  {
  }
  if (cursor.ended())
  {
    return {}; // the file has changed meanwhile
  }
  std::string text;
  for (std::int32_t i = 0; i < std::min(most, header->size_one); ++i)
  {
    char number[32];
    const auto end = std::to_chars(number, number + sizeof number, cursor.take<double>()).ptr;
    text += (i > 0 ? " " : "; its first row is ") + std::string(number, end);
  }
  return text + (header->size_one <= most ? "" : " ...");
}

void index_binary_dump(const ByteSource& source, FileIndex& index, Progress& progress)
{
  Indexer(source, index, progress).run();
}
}
