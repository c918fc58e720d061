// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/text_dump.h"

#include "granular/base/number.h"
#include "granular/dump/text_header.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace granular
{
namespace
{
/// Columns of old dumps of LAMMPS that do not name them: dump atom, scaled, with or without images.
std::vector<std::string> unnamed_columns(std::size_t words, const Where& where)
{
  constexpr const char* names[] = { "id", "type", "xs", "ys", "zs", "ix", "iy", "iz" };
  if (words != 0 && words != 5 && words != 8)
  {
    throw FormatError(
      "expected 5 or 8 words in a row of a dump that does not name its columns, got " +
        std::to_string(words),
      where);
  }
  return { names, names + (words == 8 ? 8 : 5) };
}

/// The schema of a frame, from its names and its first row: a column that the table does not know
/// holds texts if the first one is no number.
ColumnSchema make_schema(
  std::vector<std::string> names, std::string_view first_row, const Where& where)
{
  const std::vector<std::string_view> words = split_words(first_row);
  if (names.empty())
  {
    names = unnamed_columns(words.size(), where);
  }
  ColumnSchema schema(names);
  for (std::size_t i = 0; i < std::min(names.size(), words.size()); ++i)
  {
    double number = 0;
    if (!schema.columns()[i].known &&
      !parse_double(words[i].data(), words[i].data() + words[i].size(), number))
    {
      schema.set_type(static_cast<int>(i), ValueType::Text);
    }
  }
  return schema;
}

/// FNV-1a of the bytes [first, last), going on from hash.
std::uint64_t hash_bytes(
  const ByteSource& source, std::int64_t first, std::int64_t last, std::uint64_t hash)
{
  std::array<char, 4096> part;
  while (first < last)
  {
    const std::size_t got = source.read(
      first, part.data(), std::min(part.size(), static_cast<std::size_t>(last - first)));
    for (const char byte : std::span(part.data(), got))
    {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    }
    first = got > 0 ? first + static_cast<std::int64_t>(got) : last;
  }
  return hash;
}

/// Of the header and of the last of the rows: tells a run that was started over.
std::uint64_t hash_frame(const ByteSource& source, const FrameEntry& entry)
{
  constexpr std::int64_t tail = 256;
  const std::uint64_t header =
    hash_bytes(source, entry.offset, entry.rows_offset, 0xcbf29ce484222325);
  return hash_bytes(source, std::max(entry.rows_offset, entry.end - tail), entry.end, header);
}

/// Finds the frames of a text, one after the other.
class Indexer
{
public:
  Indexer(const ByteSource& source, TextIndex& index, Progress& progress)
    : source_(source)
    , index_(index)
    , progress_(progress)
    , scanner_(source, index.resume_offset, index.resume_line)
    , total_(source.stamp().size)
  {
  }

  void run()
  {
    while (this->next_frame())
    {
    }
  }

private:
  bool next_frame();
  bool read_frame(TextHeader& reader);
  bool finish_frame(FrameEntry& entry, std::int64_t rows, bool at_end);
  std::shared_ptr<const ColumnSchema> schema(const TextHeader& reader, const FrameHeader& header);
  void leave_out(const Where& where, const std::string& why);
  void set_defect(const Notice& defect);
  bool go_to_next_frame();
  bool peek(std::string_view& line);
  bool find_glued_header(FrameEntry& entry, std::int64_t& rows);

  const ByteSource& source_;
  TextIndex& index_;
  Progress& progress_;
  TextScanner scanner_;
  std::int64_t total_;
};

/// False at the end of the text.
bool Indexer::next_frame()
{
  TextHeader reader(scanner_, index_.units);
  try
  {
    return this->read_frame(reader);
  }
  catch (const FormatError& error)
  {
    this->leave_out(error.where(), error.text());
  }
  catch (const LimitError& error)
  {
    this->leave_out(error.where(), error.text());
  }
  return this->go_to_next_frame();
}

bool Indexer::read_frame(TextHeader& reader)
{
  if (!reader.read())
  {
    if (reader.opened())
    {
      this->set_defect({ { source_.path(), reader.line() },
        "expected a complete frame, got the end of the file in its header" });
    }
    return false;
  }
  FrameEntry entry;
  entry.header = std::move(reader.header());
  entry.offset = reader.offset();
  entry.line = reader.line();
  entry.rows_offset = scanner_.offset();
  entry.rows_line = scanner_.line();
  index_.units = entry.header.units;
  entry.schema = this->schema(reader, entry.header);
  std::int64_t rows = scanner_.skip_to_item(progress_, total_);
  entry.end = scanner_.offset();
  std::string_view next;
  const bool at_end = !this->peek(next);
  if (this->find_glued_header(entry, rows) && rows != entry.header.rows)
  {
    this->leave_out({ source_.path(), entry.line },
      "expected " + std::to_string(entry.header.rows) +
        " rows, got the header of another frame within a row");
    return true;
  }
  return this->finish_frame(entry, rows, at_end);
}

/// Keeps the frame if it has the rows that its header promises.
bool Indexer::finish_frame(FrameEntry& entry, std::int64_t rows, bool at_end)
{
  if (rows == entry.header.rows)
  {
    index_.resume_offset = scanner_.offset();
    index_.resume_line = scanner_.line();
    entry.hash = hash_frame(source_, entry);
    index_.frames.push_back(std::move(entry));
    return true;
  }
  const Where where{ source_.path(), entry.line };
  std::string why =
    "expected " + std::to_string(entry.header.rows) + " rows, got " + std::to_string(rows);
  if (at_end && rows < entry.header.rows)
  {
    why += scanner_.offset() < total_ ? ", and a last line without its line feed" : "";
    this->set_defect({ where, why });
    return false;
  }
  this->leave_out(where, why);
  return true;
}

std::shared_ptr<const ColumnSchema> Indexer::schema(
  const TextHeader& reader, const FrameHeader& header)
{
  const Where where = scanner_.where();
  std::string_view first_row;
  bool found = header.rows > 0;
  while (found && split_words(first_row).empty())
  {
    found = scanner_.next(first_row);
  }
  ColumnSchema schema = make_schema(reader.column_names(), found ? first_row : "", where);
  if (found)
  {
    scanner_.put_back();
  }
  for (const FrameEntry& frame : index_.frames)
  {
    if (*frame.schema == schema)
    {
      return frame.schema;
    }
  }
  return std::make_shared<const ColumnSchema>(std::move(schema));
}

void Indexer::leave_out(const Where& where, const std::string& why)
{
  this->set_defect({ where, why });
  index_.notices.push_back({ where, why + "; the frame is left out" });
}

/// What is wrong first is what is said if there is no frame at all.
void Indexer::set_defect(const Notice& defect)
{
  index_.defect = index_.defect ? index_.defect : defect;
}

bool Indexer::go_to_next_frame()
{
  std::string_view line;
  for (;;)
  {
    scanner_.skip_to_item(progress_, total_);
    if (!this->peek(line))
    {
      return false;
    }
    if (opens_frame(item_words(line)))
    {
      return true;
    }
    scanner_.next(line);
  }
}

/// The line that comes next, and stays. False at the end of the text, and where what comes is not
/// even a line: a file system that lost power leaves zeros.
bool Indexer::peek(std::string_view& line)
{
  try
  {
    if (!scanner_.next(line))
    {
      return false;
    }
  }
  catch (const LimitError&)
  {
    return false;
  }
  scanner_.put_back();
  return true;
}

/// A run that was killed within a row and then went on appending leaves "0.16ITEM: TIMESTEP".
/// Looks for that in the few lines before the scanner, goes there, and ends the frame before it:
/// rows becomes the number of its rows.
bool Indexer::find_glued_header(FrameEntry& entry, std::int64_t& rows)
{
  constexpr std::int64_t reach = 512; // two sections of a header, and more
  const std::int64_t to = scanner_.offset();
  const std::int64_t start = std::max(entry.rows_offset, to - reach);
  std::string tail(static_cast<std::size_t>(to - start), ' ');
  tail.resize(source_.read(start, tail.data(), tail.size()));
  for (const std::string_view opening : { "ITEM: UNITS", "ITEM: TIME", "ITEM: TIMESTEP" })
  {
    const std::size_t found = tail.find(opening);
    if (found != tail.npos)
    {
      const auto lines =
        std::count(tail.begin() + static_cast<std::ptrdiff_t>(found), tail.end(), '\n');
      const std::size_t feed = tail.rfind('\n', found);
      entry.end = start + static_cast<std::int64_t>(feed == tail.npos ? 0 : feed + 1);
      rows -= lines;
      scanner_.go_to(start + static_cast<std::int64_t>(found), scanner_.line() - lines);
      return true;
    }
  }
  return false;
}
}

bool is_text_dump(std::string_view first_bytes)
{
  constexpr int longest_header = 64; // lines
  bool opened = false;
  if (first_bytes.starts_with(byte_order_mark))
  {
    first_bytes.remove_prefix(byte_order_mark.size());
  }
  for (int line = 0; line < longest_header && !first_bytes.empty(); ++line)
  {
    const std::size_t feed = first_bytes.find('\n');
    const std::string_view text = first_bytes.substr(0, feed);
    const std::vector<std::string_view> words = item_words(text);
    if (!opened && !split_words(text).empty())
    {
      if (!opens_frame(words))
      {
        return false;
      }
      opened = true;
    }
    if (feed != first_bytes.npos && begins_with(words, "NUMBER OF"))
    {
      return begins_with(words, "NUMBER OF ATOMS");
    }
    first_bytes.remove_prefix(feed == first_bytes.npos ? first_bytes.size() : feed + 1);
  }
  return opened;
}

void index_text_dump(const ByteSource& source, TextIndex& index, Progress& progress)
{
  Indexer(source, index, progress).run();
}

void check_unchanged(const ByteSource& source, const FrameEntry& entry)
{
  const std::int64_t size = source.stamp().size;
  if (size < entry.end)
  {
    throw IoError("the file was shortened since it was indexed: expected at least " +
        std::to_string(entry.end) + " bytes, got " + std::to_string(size) + "; reload the files",
      { source.path() });
  }
  if (hash_frame(source, entry) != entry.hash)
  {
    throw IoError("the file changed since it was indexed: expected the frame of timestep " +
        std::to_string(entry.header.timestep) + "; reload the files",
      { source.path(), entry.line });
  }
}
}
