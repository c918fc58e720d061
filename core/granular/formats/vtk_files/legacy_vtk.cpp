// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/legacy_vtk.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <cstring>

namespace granular
{
namespace
{
constexpr std::int64_t window_bytes = std::int64_t{ 1 } << 18; // more than the longest line
constexpr std::size_t longest_line = std::size_t{ 1 } << 16;

constexpr char to_capital(char c) noexcept
{
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string in_capitals(std::string_view word)
{
  std::string text(word);
  std::ranges::transform(text, text.begin(), to_capital);
  return text;
}
}

LegacyVtk::LegacyVtk(
  const ByteSource& source, const VtkPlace& place, std::int64_t end, Progress& progress)
  : source_(source)
  , progress_(progress)
  , begin_(place.offset)
  , end_(end == no_end && !source.compressed() ? source.stamp().size : end)
  , reported_(place.offset)
  // never full of a short file
  , window_(
      static_cast<std::size_t>(std::clamp(end_ - begin_, std::int64_t{ 0 }, window_bytes - 1) + 1))
  , window_offset_(place.offset)
  , line_(place.line)
{
}

VtkPlace LegacyVtk::place() const noexcept
{
  return { this->offset(), line_ };
}

Where LegacyVtk::where(const VtkPlace& place) const
{
  return { source_.path(), place.line, place.line > 0 ? -1 : place.offset };
}

void LegacyVtk::go_to(const VtkPlace& place) noexcept
{
  const std::int64_t ahead = place.offset - window_offset_;
  const bool is_here = ahead >= 0 && ahead <= static_cast<std::int64_t>(size_);
  at_ = is_here ? static_cast<std::size_t>(ahead) : 0;
  size_ = is_here ? size_ : 0;
  window_offset_ = is_here ? window_offset_ : place.offset;
  line_ = place.line;
  line_is_open_ = false;
  ended_ = false;
}

/// Brings more bytes into the window, behind those that are left. False at the end.
bool LegacyVtk::more()
{
  constexpr std::int64_t interval = std::int64_t{ 1 } << 20;
  std::memmove(window_.data(), window_.data() + at_, size_ - at_);
  window_offset_ += static_cast<std::int64_t>(at_);
  size_ -= at_;
  at_ = 0;
  const std::int64_t from = window_offset_ + static_cast<std::int64_t>(size_);
  if (from - reported_ >= interval)
  {
    reported_ = from;
    progress_.step(end_ == no_end
        ? source_.fraction(from)
        : static_cast<double>(from - begin_) / static_cast<double>(end_ - begin_));
  }
  const auto free = static_cast<std::int64_t>(window_.size() - size_);
  const std::int64_t wanted = std::clamp(end_ - from, std::int64_t{ 0 }, free);
  const std::size_t got =
    source_.read(from, window_.data() + size_, static_cast<std::size_t>(wanted));
  size_ += got;
  return got > 0;
}

/// Passes over bytes of the window, whose lines were counted.
void LegacyVtk::pass(std::size_t bytes) noexcept
{
  at_ += bytes;
}

/// Returns true if that many bytes come, which are in the window then.
bool LegacyVtk::have(std::size_t bytes)
{
  while (size_ - at_ < bytes && this->more())
  {
  }
  return size_ - at_ >= bytes;
}

void LegacyVtk::skip_blanks()
{
  do
  {
    for (; at_ < size_ && is_blank(window_.data()[at_]); ++at_)
    {
      const bool feed = window_.data()[at_] == '\n';
      line_is_open_ = line_is_open_ && !feed;
      line_ += feed && line_ > 0 ? 1 : 0;
    }
  } while (at_ == size_ && this->more());
}

/// The next line, without its line feed. What has none ends the file.
std::string_view LegacyVtk::take_line()
{
  std::size_t searched = 0;
  std::size_t feed = 0;
  while ((feed = this->text().find('\n', searched)) == std::string_view::npos)
  {
    searched = this->text().size();
    if (searched > longest_line)
    {
      throw LimitError(
        "expected a line of at most " + std::to_string(longest_line) + " bytes, got a longer one",
        this->where(this->place()));
    }
    if (!this->more())
    {
      this->fail_end("a whole line");
    }
  }
  line_place_ = this->place();
  std::string_view line = this->text().substr(0, feed);
  this->pass(feed + 1);
  line_ += line_ > 0 ? 1 : 0;
  if (line.ends_with('\r'))
  {
    line.remove_suffix(1);
  }
  return line;
}

void LegacyVtk::take_words()
{
  line_text_ = this->take_line();
  line_is_open_ = false;
  words_ = split_words(line_text_);
}

/// Lines of words, in which VTK writes blanks as %20.
void LegacyVtk::skip_lines(std::int64_t count)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::string_view line = this->take_line();
    if (line.starts_with(legacy_vtk_mark))
    {
      this->fail(
        "a line of text (" + std::to_string(i + 1) + " of " + std::to_string(count) + ")", line);
    }
  }
}

bool LegacyVtk::at_header()
{
  if (this->offset() == 0 && this->have(byte_order_mark.size()) &&
    this->text().starts_with(byte_order_mark))
  {
    this->pass(byte_order_mark.size());
  }
  this->skip_blanks();
  return this->have(legacy_vtk_mark.size()) && this->text().starts_with(legacy_vtk_mark);
}

bool LegacyVtk::find_header(const VtkPlace& from)
{
  this->go_to(from);
  for (;;)
  {
    const std::size_t found = this->text().find(legacy_vtk_mark);
    const bool is_found = found != std::string_view::npos;
    const std::size_t rest = std::min(this->text().size(), legacy_vtk_mark.size() - 1);
    const std::string_view passed =
      this->text().substr(0, is_found ? found : this->text().size() - rest);
    line_ += line_ > 0 ? std::ranges::count(passed, '\n') : 0;
    this->pass(passed.size());
    if (is_found)
    {
      return true;
    }
    if (!this->more())
    {
      return false;
    }
  }
}

VtkHeader LegacyVtk::read_header()
{
  VtkHeader header;
  binary_ = false;
  static_cast<void>(this->at_header());
  header.place = this->place();
  this->take_words();
  if (!line_text_.starts_with(legacy_vtk_mark))
  {
    this->fail("'" + std::string(legacy_vtk_mark) + "'", line_text_);
  }
  double version = 0;
  header.version = words_.size() > 4 ? words_[4] : std::string_view();
  const char* const digits = header.version.data();
  if (!parse_double(digits, digits + header.version.size(), version) ||
    !(version >= 1 && version < 6))
  {
    this->fail("a version from 1.0 to 5.1", line_text_);
  }
  header.title = this->take_line();
  if (header.title.starts_with(legacy_vtk_mark))
  {
    this->fail("a title", header.title);
  }
  this->need("ASCII or BINARY");
  binary_ = this->is("BINARY");
  if (!binary_ && !this->is("ASCII"))
  {
    this->fail("ASCII or BINARY", line_text_);
  }
  header.binary = binary_;
  line_ = binary_ ? 0 : line_;
  if (this->next())
  {
    if (!this->is("DATASET") || words_.size() != 2)
    {
      this->fail("DATASET", line_text_);
    }
    header.dataset = in_capitals(words_[1]);
  }
  return header;
}

bool LegacyVtk::next()
{
  for (;;)
  {
    static_cast<void>(this->at_header());
    if (this->text().empty() || this->text().front() == legacy_vtk_mark.front())
    {
      if (line_is_open_)
      {
        this->fail_missing("a line feed");
      }
      return false;
    }
    this->take_words();
    if (!this->is("METADATA") || words_.size() != 1)
    {
      return true;
    }
    this->skip_metadata();
  }
}

void LegacyVtk::need(const std::string& what)
{
  if (!this->next())
  {
    this->fail_missing(what);
  }
}

/// METADATA: names of the components of the values before, one a line, and INFORMATION, up to an empty line.
void LegacyVtk::skip_metadata()
{
  do
  {
    line_text_ = this->take_line();
    words_ = split_words(line_text_);
    if (line_text_.starts_with(legacy_vtk_mark))
    {
      this->fail("an empty line behind METADATA", line_text_);
    }
    if (!words_.empty() && this->is("COMPONENT_NAMES"))
    {
      this->skip_lines(components_);
    }
  } while (!words_.empty());
}

bool LegacyVtk::is(std::string_view keyword) const noexcept
{
  return !words_.empty() && std::ranges::equal(words_.front(), keyword, {}, to_capital, to_capital);
}

std::int64_t LegacyVtk::count(std::size_t word) const
{
  std::int64_t number = -1;
  const std::string_view text = word < words_.size() ? words_[word] : std::string_view();
  if (!parse_int64(text.data(), text.data() + text.size(), number) || number < 0)
  {
    this->fail("a number of at least 0 as word " + std::to_string(word + 1), line_text_);
  }
  return number;
}

void LegacyVtk::fail(const std::string& expected, std::string_view got) const
{
  throw FormatError("expected " + expected + ", got " + quoted(got), this->where(line_place_));
}

void LegacyVtk::fail_end(const std::string& expected, const std::string& cause)
{
  ended_ = true;
  throw FormatError(
    "expected " + expected + ", got the end of the file" + cause, this->where(this->place()));
}

void LegacyVtk::fail_missing(const std::string& expected, const std::string& cause)
{
  static_cast<void>(this->at_header());
  if (legacy_vtk_mark.starts_with(this->text())) // as far as it is there
  {
    this->fail_end(expected, cause);
  }
  throw FormatError(
    "expected " + expected + ", got another header" + cause, this->where(this->place()));
}
}
