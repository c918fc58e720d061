// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_text_header_h
#define granular_formats_dump_grammar_text_header_h

#include "granular/frames/frame.h"
#include "granular/text/text_scanner.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Returns the words after "ITEM:" of a line; none for other lines.
std::vector<std::string_view> item_words(std::string_view line);

/// Returns true if words begin with the blank-separated words of name. alone: and there are no other words.
bool begins_with(
  std::span<const std::string_view> words, std::string_view name, bool alone = false) noexcept;

/// Returns true if a section of that name may be the first of a frame: TIMESTEP, or UNITS and TIME, which LAMMPS prints
/// before it.
bool opens_frame(std::span<const std::string_view> words) noexcept;

/// Returns the digits of a number before an exponent, from the first that is not 0.
int digits_of(std::string_view word) noexcept;

/// The things that rows stand for: ITEM: NUMBER OF ATOMS, or ENTRIES or any words of the user.
enum class RowsOf : std::uint8_t
{
  Particles,
  Others, ///< of dump local; there need be no box
  Cells,  ///< of a grid, whose ITEM: GRID SIZE counts them
  Any
};

/// Reads the header of one frame of a text dump, in any dialect: sections in any order up to ITEM: ATOMS or its
/// equivalent. Unknown sections are skipped.
class TextHeader
{
public:
  TextHeader(TextScanner& scanner, const std::string& units, RowsOf rows_of)
    : scanner_(scanner)
    , rows_of_(rows_of)
  {
    this->restart(units);
  }

  /// Prepares for the header of another frame.
  void restart(const std::string& units);

  /// Reads up to and including the line ITEM: ATOMS. Returns false at the end of the text. Throws FormatError.
  bool read();

  FrameHeader& header() noexcept { return header_; }
  const FrameHeader& header() const noexcept { return header_; }
  const std::vector<std::string>& column_names() const noexcept { return column_names_; }
  std::int64_t offset() const noexcept { return offset_; } ///< of the frame's first line
  std::int64_t line() const noexcept { return line_; }
  bool opened() const noexcept { return opened_; }

private:
  struct Section
  {
    std::string_view name; ///< words after ITEM:, as far as they are fixed
    bool alone;            ///< no other words may follow: with some it is an unknown section
    void (TextHeader::*parse)();
  };

  /// The spelling of numbers on a line.
  struct Spelling
  {
    std::size_t shortest = std::string_view::npos; ///< of all words so far
    int digits = 0;                                ///< at most, of all words so far
    std::array<double, 4> rounding = {};           ///< of each number
  };

  static const Section sections[];

  void read_section(std::string_view line);
  std::string_view next();
  void look_for_next_frame();
  std::string_view value_line();
  void parse_timestep();
  void parse_time();
  void parse_units();
  void parse_label();
  void parse_rows();
  void parse_grid();
  void parse_box();
  void parse_columns();
  void skip_section();
  std::array<double, 4> read_numbers(std::size_t count, Spelling* spelling = nullptr);
  std::int64_t integer(std::string_view word, const std::string& what) const;
  void require(bool seen, const char* section) const;
  std::string columns_section() const;
  [[noreturn]] void fail(const std::string& expected, std::string_view got) const;

  TextScanner& scanner_;
  RowsOf rows_of_;
  FrameHeader header_;
  std::vector<std::string> column_names_;
  std::string section_;                 ///< the line ITEM: of the section at hand
  std::vector<std::string_view> words_; ///< of it
  std::int64_t offset_ = 0;
  std::int64_t line_ = 0;
  std::int64_t next_offset_ = 0; ///< of the first section that may be another frame's
  std::int64_t next_line_ = 0;
  bool opened_ = false;
  bool has_timestep_ = false;
  bool has_rows_ = false;
  bool has_box_ = false;
  bool has_columns_ = false;
};
}
#endif
