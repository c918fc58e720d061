// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_text_header_h
#define granular_formats_dump_grammar_text_header_h

#include "granular/frames/frame.h"
#include "granular/text/text_scanner.h"

#include <cstdint>
#include <optional>
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

/// Returns the place in a line that is no start of a frame where the header of one begins; 0: there is none. A run that was
/// killed within a line and then went on appending leaves "0.16ITEM: TIMESTEP".
std::size_t find_glued_header(std::string_view line);

/// Returns true if a word is a number.
bool is_number(std::string_view word) noexcept;

/// Returns true if a word behind BOX BOUNDS is no boundary: a number, or a name of tilts, which have a place of their own.
bool is_misplaced(std::string_view word) noexcept;

/// The digits of %g, with which LIGGGHTS prints bounds.
inline constexpr int fewest_digits = 6;

/// Returns how far a number of six digits may be off because %g printed it: half a unit of the last one. Returns 0 for others,
/// and for whole ones that end in 0.
double rounding_of(std::string_view word, double value) noexcept;

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

/// Rows of other things than a reader is for, which some files have beside its own.
class OtherRows : public FormatError
{
  using FormatError::FormatError;
};

/// Returns true if a line between sections says nothing: a blank one, or a comment, which begins with '#'.
bool says_nothing(std::string_view line) noexcept;

/// Reads the header of one frame of a text dump, in any dialect: sections in any order up to ITEM: ATOMS or its
/// equivalent. Unknown sections are skipped, and so are rows of other things.
class TextHeader
{
public:
  TextHeader(TextScanner& scanner, const std::string& units, RowsOf rows_of)
    : scanner_(scanner)
    , rows_of_(rows_of)
  {
    this->restart(units);
  }

  /// Lets lines that begin with '#' be no comments: in a file that is no dump.
  void expect_no_comments() noexcept { has_comments_ = false; }

  /// Prepares for the header of another frame.
  void restart(const std::string& units);

  /// Reads up to and including the line ITEM: ATOMS. Returns false at the end of the text. Throws FormatError; OtherRows for a frame
  /// without rows of these, and between frames.
  bool read();

  FrameHeader& header() noexcept { return header_; }
  const FrameHeader& header() const noexcept { return header_; }
  const std::vector<std::string>& column_names() const noexcept { return column_names_; }
  std::int64_t offset() const noexcept { return offset_; } ///< of the frame's first line
  std::int64_t line() const noexcept { return line_; }
  bool opened() const noexcept { return opened_; }
  const std::optional<OtherRows>& others() const noexcept { return others_; } ///< in this frame
  bool flat() const noexcept { return flat_; } ///< the box has no bounds along z

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
  std::optional<OtherRows> others_;
  bool opened_ = false;
  bool has_timestep_ = false;
  bool has_rows_ = false;
  bool has_box_ = false;
  bool has_columns_ = false;
  bool flat_ = false;
  bool has_comments_ = true;
};
}
#endif
