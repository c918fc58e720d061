// SPDX-License-Identifier: BSD-3-Clause
// Rows of text dumps as the programs print them, always the same, and memory for their values.
#ifndef tests_bench_dump_text_h
#define tests_bench_dump_text_h

#include "granular/bytes/byte_source.h"
#include "granular/text/row_text.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bench
{
using granular::ValueType;

/// Numbers that look random and are the same everywhere (splitmix64, S. Vigna).
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : state_(seed)
  {
  }

  std::uint64_t bits() noexcept
  {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// In [0, 1).
  double unit() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double lo, double hi) noexcept { return lo + (hi - lo) * unit(); }

  /// About normal: a sum of uniform ones.
  double bell() noexcept { return unit() + unit() + unit() + unit() - 2; }

private:
  std::uint64_t state_;
};

/// How a double is printed.
enum class Print
{
  General, ///< %g, the default of both programs
  Full,    ///< %.16e, LAMMPS' boxes and `dump_modify format float`
  Fixed    ///< %.6f
};

/// The bytes that printf makes in the C locale.
void append(std::string& text, double value, Print print);
void append(std::string& text, std::int64_t value);

/// An array that columns become: neighbouring columns, row-major.
struct Array
{
  ValueType kind;
  std::size_t components;

  std::size_t bytes_a_row() const;
};

/// A form of row.
enum class Form
{
  Atom,         ///< id type xs ys zs ix iy iz; %g
  Custom,       ///< id type x y z vx vy vz fx fy fz radius; %g
  CustomFull,   ///< the same; %.16e
  CustomFixed,  ///< the same; %.6f
  CustomAtRest, ///< the same; %g; half of the grains do not move: zeros
  Integers,     ///< 12 columns of integers of one to ten digits
  Tiny,         ///< custom; %g; values of 1e-40 to 1e-5
  Extreme       ///< custom; %g; values of 1e-300 to 1e300
};

struct Rows
{
  std::string columns;       ///< as after ITEM: ATOMS
  std::vector<Array> arrays; ///< what they become
  std::int64_t count = 0;
  std::string text;

  std::uint32_t words() const;
};

Rows make_rows(Form form, std::int64_t count);

/// Text in a buffer that the decoder may read beyond.
granular::PaddedBuffer padded(const std::string& text);

/// A part of a text that holds whole rows.
struct Slice
{
  const char* first;
  const char* last;
  std::int64_t row; ///< number of its first row
  std::int64_t rows;
};

/// Cuts a text of whole lines into pieces of about bytes each.
std::vector<Slice> cut(const char* first, const char* last, std::size_t bytes);

/// A frame: header and rows. print is that of the box.
std::string header(
  std::int64_t timestep, std::int64_t rows, double lo, double hi, Print print, const Rows& form);

/// Memory of the arrays, written to once, so that it is really there.
class Output
{
public:
  Output(const Rows& form, std::int64_t rows);

  /// Where a row of an array goes.
  struct Place
  {
    Array array;
    char* data;
  };

  /// The arrays from a row on.
  std::vector<Place> places(std::int64_t row);

  /// Sinks for all columns from a row on.
  std::vector<granular::ColumnSink> sinks(std::int64_t row);

  /// Makes all values something that no text holds.
  void spoil();

  bool operator==(const Output& other) const { return memory_ == other.memory_; }

  std::size_t arrays() const { return arrays_.size(); }
  const char* array(std::size_t index) const { return memory_[index].data(); }
  std::size_t bytes_a_row(std::size_t index) const { return arrays_[index].bytes_a_row(); }

private:
  std::vector<Array> arrays_;
  std::vector<std::vector<char>> memory_;
};

/// The yardstick: one pass over the text with std::from_chars and no thought of anything else.
/// Rows of words separated by blanks and line feeds; every word must be a number.
/// Gives the end of the last row, or null where a word is none.
const char* parse_plainly(
  const char* first, const char* last, std::span<Output::Place> places, std::int64_t rows);

/// The truth: the same with strtod and strtoll.
bool parse_slowly(const char* first, std::span<granular::ColumnSink> sinks, std::int64_t rows);

/// The rows of a text in memory, again and again into memory that has been touched: what has to be done
/// at least.
class TextInMemory
{
public:
  explicit TextInMemory(const Rows& rows, std::int64_t repeats = 1);

  bool decode(); ///< with decode_rows
  bool parse();  ///< with the yardstick; false where not all rows are good, as above

private:
  granular::PaddedBuffer text_;
  Output output_;
  std::uint32_t words_;
  std::int64_t count_;
};

/// A file that is gone when this is.
class TemporaryFile
{
public:
  /// In the folder of the benchmark, under a name of its own.
  explicit TemporaryFile(const char* extension = ".dump");
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  void append(std::string_view text);

  const std::string& path() const noexcept { return path_; }

private:
  std::string path_;
};

/// A file of one frame: the rows, repeated until there are count.
void write_frame(TemporaryFile& file, const Rows& rows, std::int64_t count);
}
#endif
