// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_vtk_files_legacy_vtk_h
#define granular_formats_vtk_files_legacy_vtk_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/formats/vtk_files/vtk_values.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The beginning of the first line of a legacy VTK file.
inline constexpr std::string_view legacy_vtk_mark = "# vtk DataFile";

/// A position in a file. Lines are not counted in binary files.
struct VtkPlace
{
  std::int64_t offset = 0;
  std::int64_t line = 1; ///< 0: not known
};

/// The lines before the sections of a dataset.
struct VtkHeader
{
  VtkPlace place;      ///< of the first of them
  std::string version; ///< "4.2"
  std::string title;
  bool binary = false;
  std::string dataset; ///< kind, in capitals; empty: another header or the end comes instead
};

/// Cells of a dataset: in the form of VTK before 9 (the number of points, then the points, for each cell) or with offsets.
struct VtkCells
{
  std::int64_t size = 0;
  std::vector<std::int64_t> offsets;      ///< size + 1: where the points of each cell begin
  std::vector<std::int64_t> connectivity; ///< numbers of points
  VtkArray values;                        ///< in the file: connectivity and, if counted, counts
  VtkPlace place;                         ///< of the first of values
  bool counted = false;                   ///< each cell begins with the number of its points
};

/// Reads legacy VTK files (1.0 to 5.1, ASCII and BINARY) section by section; the caller knows the sections of a dataset.
/// Sections begin with a line of words; keywords may be in small letters. Numbers of a text may spread over lines in any way.
/// Counts are claims: memory is allocated only for bytes that are there.
///
/// All members throw FormatError and LimitError with the line, or the byte in binary files, the errors of reading, and
/// Cancelled.
class LegacyVtk
{
public:
  static constexpr std::int64_t no_end = std::numeric_limits<std::int64_t>::max();

  /// Begins at a position, the start of a header or a section. Bytes from `end` on do not exist; no_end: their number is
  /// unknown.
  LegacyVtk(const ByteSource& source, const VtkPlace& place, std::int64_t end, Progress& progress);

  /// Returns the position of the next byte.
  VtkPlace place() const noexcept;
  Where where(const VtkPlace& place) const;
  void go_to(const VtkPlace& place) noexcept;

  /// Skips blanks. Returns true if a header is next.
  bool at_header();

  /// Returns true if no byte is left.
  bool at_end() { return !this->have(1); }

  /// Goes to the next header after a position, in any line. Returns false if there is none before the end.
  bool find_header(const VtkPlace& from);

  VtkHeader read_header();

  /// Goes to the next line with words; METADATA is skipped. Returns false if there is none: at the end, which may be an
  /// unfinished line of another header, or at a header. Throws if a section lacks its last line feed.
  bool next();

  /// Goes to the next line, or throws if there is none; `what` was expected, for the message.
  void need(const std::string& what);

  /// Returns the words of that line; valid until the next one.
  const std::vector<std::string_view>& words() const noexcept { return words_; }
  const VtkPlace& line_place() const noexcept { return line_place_; }

  /// Returns true if the first word is the keyword, in small letters or capitals.
  bool is(std::string_view keyword) const noexcept;

  /// Returns a word as a count, 0 or more, or as a type.
  std::int64_t count(std::size_t word) const;
  ValueType type(std::size_t word) const;

  /// Returns the values behind a line "KEYWORD tuples type".
  VtkArray values(std::int64_t components) const;

  /// Reads the next values: doubles, or integers as std::int64_t.
  template <class T>
  void read(const VtkArray& array, std::vector<T>& numbers);
  void skip(const VtkArray& array);

  /// Reads the next values, or skips them.
  template <class T>
  void take(const VtkArray& array, bool keep, std::vector<T>& numbers)
  {
    keep ? this->read(array, numbers) : this->skip(array);
  }

  using TakeArray = std::function<bool(const VtkArray&)>;

  /// Takes the arrays of point, cell or field data that the line begins: one array, or the arrays of a FIELD. Calls `take`
  /// before the values of each array; it returns true if it has read them. Returns false if the line begins no array.
  bool take_arrays(std::int64_t tuples, const TakeArray& take);

  /// Returns the cells that the line ("CELLS size values", or VERTICES, LINES, ...) begins; keep: with their points.
  VtkCells cells(bool keep);

  /// Returns the position of a value that was read or skipped, for messages.
  Where where_of(const VtkPlace& first, const VtkArray& array, std::int64_t number);
  Where where_of(const VtkCells& cells, std::int64_t cell);

  /// Returns true if the file ended where more was expected: the file may still be growing.
  bool ended() const noexcept { return ended_; }

  /// Throws "expected ..., got ..." for the line of next().
  [[noreturn]] void fail(const std::string& expected, std::string_view got) const;

  /// Throws that something is missing because the end or another header comes first; `cause` may explain it.
  [[noreturn]] void fail_missing(const std::string& expected, const std::string& cause = "");

private:
  std::int64_t offset() const noexcept { return window_offset_ + static_cast<std::int64_t>(at_); }
  std::string_view text() const noexcept { return { window_.data() + at_, size_ - at_ }; }
  bool more();
  bool have(std::size_t bytes);
  void pass(std::size_t bytes) noexcept;
  void skip_blanks();
  std::string_view take_line();
  void take_words();
  void skip_lines(std::int64_t count);
  void skip_metadata();
  std::string_view whole_words(std::int64_t done, std::int64_t count);
  [[noreturn]] void fail_end(const std::string& expected, const std::string& cause = "");
  [[noreturn]] void fail_count(std::int64_t done, std::int64_t count);
  [[noreturn]] void fail_number(std::int64_t done, std::int64_t count, const char* kind);
  void check_claim(const VtkArray& array);
  template <class T>
  void read_text(T* numbers, std::int64_t first, std::int64_t last, std::int64_t count);
  template <class T>
  void read_binary(
    ValueType type, T* numbers, std::int64_t first, std::int64_t last, std::int64_t count);
  void skip_text(std::int64_t count);
  const char* skip_words(
    const char* at, const char* last, const char* end, std::int64_t& done, std::int64_t count);
  void skip_bytes(std::int64_t bytes, std::int64_t count);
  void skip_strings(std::int64_t count);
  void take_fields(const TakeArray& take);
  void take_array(const VtkArray& array, const TakeArray& take);
  void split_cells(VtkCells& cells);
  void check_offsets(const VtkCells& cells, const VtkPlace& place) const;

  const ByteSource& source_;
  Progress& progress_;
  std::int64_t begin_;
  std::int64_t end_;
  std::int64_t reported_;
  PaddedBuffer window_;
  std::size_t at_ = 0;   ///< next byte in window_
  std::size_t size_ = 0; ///< bytes in window_
  std::int64_t window_offset_;
  std::int64_t line_;
  bool binary_ = false;
  bool line_is_open_ = false; ///< numbers were read, the line feed behind them was not
  bool ended_ = false;
  std::int64_t components_ = 1; ///< of the values that were read last
  std::string line_text_;
  std::vector<std::string_view> words_;
  VtkPlace line_place_;
};
}
#endif
