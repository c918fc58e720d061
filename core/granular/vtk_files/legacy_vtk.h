// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_legacy_vtk_h
#define granular_vtk_files_legacy_vtk_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/vtk_files/vtk_values.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What the first line of a legacy VTK file begins with.
inline constexpr std::string_view legacy_vtk_mark = "# vtk DataFile";

/// A place in a file. Lines are not counted in binary files.
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

/// Cells of a dataset: those of VTK before 9 (the number of points, then these, for each) or with offsets.
struct VtkCells
{
  std::int64_t size = 0;
  std::vector<std::int64_t> offsets;      ///< size + 1: where the points of each cell begin
  std::vector<std::int64_t> connectivity; ///< numbers of points
  VtkArray values;      ///< what stands in the file: connectivity and, if counted, counts
  VtkPlace place;       ///< of the first of values
  bool counted = false; ///< each cell begins with the number of its points
};

/// Reads legacy VTK files (1.0 to 5.1, ASCII and BINARY) section by section: the caller knows which sections a dataset
/// has. Sections begin with a line of words; keywords are the same in small letters. Numbers of a text may
/// spread over lines in any way. Counts are claims: nothing is allocated before the bytes that they need are
/// there.
///
/// All members throw FormatError and LimitError that name the line, of binary files the byte, what reading throws,
/// and Cancelled.
class LegacyVtk
{
public:
  static constexpr std::int64_t no_end = std::numeric_limits<std::int64_t>::max();

  /// Begins at a place, the start of a header or a section. Bytes from end on are not there; no_end: nobody
  /// knows how many there are.
  LegacyVtk(const ByteSource& source, const VtkPlace& place, std::int64_t end, Progress& progress);

  /// Where the next byte is.
  VtkPlace place() const noexcept;
  Where where(const VtkPlace& place) const;
  void go_to(const VtkPlace& place) noexcept;

  /// Passes over blanks. Whether a header is next.
  bool at_header();

  /// Whether no byte is left.
  bool at_end() { return !this->have(1); }

  /// Goes to the next header from a place on, in whatever line. False: at the end, there is none.
  bool find_header(const VtkPlace& from);

  VtkHeader read_header();

  /// Goes to the next line with words; METADATA is passed over. False where there is none: at the end, which may be
  /// an unfinished line of another header, or a header. A section without its last line feed throws.
  bool next();

  /// The same; throws if there is none. what: was expected, for the message.
  void need(const std::string& what);

  /// The words of that line, until the next one.
  const std::vector<std::string_view>& words() const noexcept { return words_; }
  const VtkPlace& line_place() const noexcept { return line_place_; }

  /// Whether the first word is that, in small letters or capitals.
  bool is(std::string_view keyword) const noexcept;

  /// A word as a count, 0 or more, or as a type.
  std::int64_t count(std::size_t word) const;
  ValueType type(std::size_t word) const;

  /// The values behind a line "KEYWORD tuples type".
  VtkArray values(std::int64_t components) const;

  /// The values that come next: doubles, or whole ones as std::int64_t.
  template <class T>
  void read(const VtkArray& array, std::vector<T>& numbers);
  void skip(const VtkArray& array);

  /// Reads them, or passes over them.
  template <class T>
  void take(const VtkArray& array, bool keep, std::vector<T>& numbers)
  {
    keep ? this->read(array, numbers) : this->skip(array);
  }

  using TakeArray = std::function<bool(const VtkArray&)>;

  /// Arrays of point, cell or field data that the line begins: one, or those of a FIELD. take is called before the
  /// values of each, and returns true if it has read them. False: the line begins none.
  bool take_arrays(std::int64_t tuples, const TakeArray& take);

  /// The cells that the line ("CELLS size values", or VERTICES, LINES, ...) begins; keep: with their points.
  VtkCells cells(bool keep);

  /// Places of values that were read or passed over, for messages.
  Where where_of(const VtkPlace& first, const VtkArray& array, std::int64_t number);
  Where where_of(const VtkCells& cells, std::int64_t cell);

  /// Whether the file ended where more had to come: it may still be growing.
  bool ended() const noexcept { return ended_; }

  /// Throws: "expected ..., got ..." of the line that next() gave.
  [[noreturn]] void fail(const std::string& expected, std::string_view got) const;

  /// Throws: what had to come does not, because the end or another header does; cause: why that may be.
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
