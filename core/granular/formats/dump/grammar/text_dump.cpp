// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_dump.h"

#include "granular/common/hash.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

namespace granular
{
namespace
{
/// A file that is younger may still be written to: its last row may not be whole.
constexpr std::int64_t settled_after = 60; // seconds

/// Returns the seconds since a file was written to.
std::int64_t age_of(const FileStamp& stamp)
{
  using std::chrono::duration_cast, std::chrono::nanoseconds, std::chrono::seconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return duration_cast<seconds>(now - nanoseconds(stamp.modified)).count();
}

std::string age_text(std::int64_t seconds)
{
  constexpr std::pair<std::int64_t, const char*> units[] = { { 86400, " d" }, { 3600, " h" },
    { 60, " min" }, { 1, " s" } };
  const auto* const unit = std::ranges::find_if(
    units, [seconds](const auto& one) { return seconds >= one.first || one.first == 1; });
  return std::to_string(seconds / unit->first) + unit->second + " ago";
}

/// Finds the frames of a text, one after the other.
class Indexer
{
public:
  Indexer(const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead,
    RowsOf rows_of)
    : source_(source)
    , index_(index)
    , progress_(progress)
    , scanner_(source, index.resume_offset, index.resume_line, window, ahead)
    , reader_(scanner_, index.units, rows_of)
  {
    if (index.frames.empty() && !tell_rows(first_bytes_of(source)))
    {
      reader_.expect_no_comments();
    }
  }

  void run()
  {
    while (this->next_frame())
    {
    }
    if (index_.frames.empty() && others_)
    {
      index_.defect = others_;
    }
  }

private:
  /// False at the end of the text.
  bool next_frame()
  {
    reader_.restart(index_.units);
    std::optional<Notice> why;
    try
    {
      return this->read_frame();
    }
    catch (const OtherRows& error)
    {
      this->pass_over(error);
    }
    catch (const FormatError& error)
    {
      why = Notice(error.where(), error.text());
    }
    catch (const LimitError& error)
    {
      why = Notice(error.where(), error.text());
    }
    const bool more = this->go_to_next_frame();
    const bool is_frame = more || reader_.opened() || !index_.frames.empty();
    if (why)
    {
      this->leave_out(why->where, why->text, is_frame ? "frame" : "file");
    }
    return more;
  }

  bool read_frame()
  {
    if (!reader_.read())
    {
      if (reader_.opened())
      {
        set_defect(index_,
          { { source_.path(), reader_.line() },
            "expected a complete frame, got the end of the file in its header" });
      }
      return false;
    }
    const FrameHeader& header = reader_.header();
    if (reader_.others())
    {
      this->pass_over(*reader_.others());
    }
    if (reader_.flat())
    {
      this->note_once({ scanner_.where(), "the box has no bounds along z: it goes from -0.5 to 0.5",
        "flat box" });
    }
    rows_offset_ = scanner_.offset();
    rows_line_ = scanner_.line();
    index_.units = header.units;
    FrameEntry entry;
    entry.timestep = header.timestep;
    entry.rows = header.rows;
    entry.offset = reader_.offset();
    entry.line = reader_.line();
    entry.time = header.time.value_or(FrameEntry::no_time);
    entry.kind = this->kind();
    entry.shape = hash_shape(header, *entry.kind);
    std::int64_t rows = scanner_.skip_to_item(progress_);
    entry.end = scanner_.offset();
    std::string_view next;
    const bool at_end = !this->peek(next);
    if (this->find_glued_header(entry, rows) && rows != entry.rows)
    {
      this->leave_out({ source_.path(), entry.line },
        "expected " + std::to_string(entry.rows) +
          " rows, got the header of another frame within a row");
      return true;
    }
    this->pass_comments(entry, rows);
    return this->finish_frame(entry, rows, at_end);
  }

  /// Keeps the frame if it has the rows that its header promises.
  bool finish_frame(FrameEntry& entry, std::int64_t rows, bool at_end)
  {
    if (rows == entry.rows)
    {
      index_.resume_offset = scanner_.offset();
      index_.resume_line = scanner_.line();
      index_.frames.push_back(std::move(entry));
      return true;
    }
    const Where where{ source_.path(), entry.line };
    const std::string why =
      "expected " + std::to_string(entry.rows) + " rows, got " + std::to_string(rows);
    if (at_end && rows < entry.rows)
    {
      return this->finish_last(entry, rows, where, why);
    }
    this->leave_out(where, why);
    return true;
  }

  /// Keeps a frame at the end of the text that lacks no more than a line feed, if nobody is writing it. False.
  bool finish_last(FrameEntry& entry, std::int64_t rows, const Where& where, std::string why)
  {
    std::string rest(std::size_t{ 1 } << 16, ' '); // what follows the last line feed
    rest.resize(source_.read(scanner_.offset(), rest.data(), rest.size()));
    const FileStamp stamp = source_.stamp();
    const std::int64_t age = age_of(stamp);
    const bool packed = source_.compressed();
    const bool whole = rows + 1 == entry.rows && rest.find('\0') == rest.npos &&
      split_words(rest).size() == entry.kind->schema.columns().size();
    if (whole &&
      (packed ? source_.unchecked().empty() : stamp.modified > 0 && age >= settled_after))
    {
      if (!packed)
      {
        index_.notices.push_back({ { source_.path(), scanner_.line() },
          "the last row has no line feed; it counts, because the file was written to " +
            age_text(age) });
      }
      entry.end = scanner_.offset() + static_cast<std::int64_t>(rest.size());
      index_.resume_offset = entry.offset; // the row may grow
      index_.resume_line = entry.line;
      index_.frames.push_back(std::move(entry));
      return false;
    }
    why += rest.empty() ? "" : ", and a last line without its line feed";
    why += whole && !packed && stamp.modified > 0
      ? " in a file that was written to " + age_text(age)
      : "";
    set_defect(index_, { where, why });
    return false;
  }

  /// Lines that begin with '#' are no rows. Those behind the last row end the frame; one among the rows is an error.
  void pass_comments(FrameEntry& entry, std::int64_t& rows)
  {
    if (rows <= entry.rows)
    {
      return;
    }
    const std::int64_t end = entry.end;
    TextScanner scanner(source_, rows_offset_, rows_line_, window);
    std::optional<FormatError> comment;
    for (std::string_view line; scanner.offset() < end && scanner.next(line);)
    {
      if (comment && !says_nothing(line))
      {
        throw *comment;
      }
      if (says_nothing(line) && has_words(line))
      {
        entry.end = comment ? entry.end : scanner.last_offset();
        comment.emplace("expected a row, got " + quoted(line), scanner.where());
        --rows;
      }
    }
  }

  const std::shared_ptr<const FrameKind>& kind()
  {
    const std::int64_t line_of_names = scanner_.last_line();
    const bool found = take_first_row(scanner_, reader_.header().rows, first_row_);
    const std::vector<std::string>& names = reader_.column_names();
    const std::string& units = reader_.header().units;
    if (!kind_)
    {
      kind_ = index_.kinds->last(); // another file is mostly of the same
    }
    if (!kind_ || kind_->layout != FrameKind::text || kind_->units != units ||
      !makes_schema(names, first_row_, kind_->schema))
    {
      kind_ = index_.kinds->share({ make_schema(names, first_row_, reader_.header().counted,
                                      { source_.path(), line_of_names }),
        units });
    }
    if (found)
    {
      scanner_.put_back();
    }
    return kind_;
  }

  void leave_out(const Where& where, const std::string& why, const char* what = "frame")
  {
    set_defect(index_, { where, why });
    index_.notices.push_back({ where, why + "; the " + what + " is left out" });
  }

  /// Adds a notice unless the file has one of its topic.
  void note_once(Notice notice)
  {
    if (std::ranges::find(index_.notices, notice.topic, &Notice::topic) == index_.notices.end())
    {
      index_.notices.push_back(std::move(notice));
    }
  }

  /// Says that there are rows of other things. A file of these alone has an error.
  void pass_over(const OtherRows& others)
  {
    others_ = others_ ? others_ : Notice(others.where(), others.text());
    const std::string_view text = others.text();
    this->note_once({ others.where(),
      "the rows behind " + std::string(text.substr(text.find(", got ") + 6)) +
        " are passed over in the whole file: they are not of the kind that is read",
      "other rows" });
  }

  bool go_to_next_frame()
  {
    std::string_view line;
    for (;;)
    {
      scanner_.skip_to_item(progress_);
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
  bool peek(std::string_view& line)
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
  bool find_glued_header(FrameEntry& entry, std::int64_t& rows)
  {
    constexpr std::int64_t reach = 512; // two sections of a header, and more
    const std::int64_t to = scanner_.offset();
    const std::int64_t start = std::max(rows_offset_, to - reach);
    std::string buffer;
    const std::string_view tail = scanner_.before(static_cast<std::size_t>(to - start), buffer);
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

  static constexpr std::size_t window = std::size_t{ 1 } << 18;

  const ByteSource& source_;
  FileIndex& index_;
  Progress& progress_;
  TextScanner scanner_;
  TextHeader reader_;                       ///< of the frame at hand
  std::vector<std::string_view> first_row_; ///< its words
  std::shared_ptr<const FrameKind> kind_;   ///< of the frame before: most have the same
  std::int64_t rows_offset_ = 0;            ///< of the frame at hand
  std::int64_t rows_line_ = 0;
  std::optional<Notice> others_; ///< the first rows of other things
};

}

void index_text_dump(const ByteSource& source, FileIndex& index, Progress& progress,
  const ScanAhead& ahead, RowsOf rows_of)
{
  Indexer(source, index, progress, ahead, rows_of).run();
}

std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry)
{
  constexpr std::int64_t most_bytes = std::int64_t{ 1 } << 18;
  std::string bytes(static_cast<std::size_t>(std::min(entry.end - entry.offset, most_bytes)), ' ');
  bytes.resize(open_indexed(file)->read(entry.offset, bytes.data(), bytes.size()));
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return { std::bit_cast<std::int64_t>(hash.value()) };
}
}
