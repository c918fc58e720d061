// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_record_plan_h
#define granular_formats_restart_record_plan_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/formats/restart/bond_record.h"
#include "granular/formats/restart/restart_layout.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
inline bool has_position_of(std::span<const double> part, std::span<const double> record) noexcept
{
  return std::memcmp(
           part.data() + RecordSlots::x, record.data() + RecordSlots::x, 3 * sizeof(double)) == 0;
}

/// Returns the type of a particle from either representation; 0 if invalid.
inline std::int64_t type_of(std::span<const double> part) noexcept
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const double type = part[RecordSlots::type];
  const auto bits = std::bit_cast<std::int64_t>(type);
  const std::int64_t value =
    type >= 1 && type <= static_cast<double>(most) ? static_cast<std::int64_t>(type) : bits;
  return value >= 1 && value <= most ? value : 0;
}

/// Returns true if the data of an atom style may begin there.
inline bool begins_part(std::span<const double> record, std::size_t at) noexcept
{
  if (at > record.size() || record.size() - at < RecordSlots::common)
  {
    return false;
  }
  const auto part = record.subspan(at);
  return length_of(part[0], RecordSlots::common, part.size()) > 0 &&
    has_position_of(part, record) && type_of(part) > 0 && type_of(part) == type_of(record);
}

/// Calls take(part, begin, length) for the data of each fix. Returns false if the record has fewer fixes.
template <class Take>
bool walk_fixes(std::span<const double> record, std::size_t at, std::size_t fixes, const Take& take)
{
  for (std::size_t fix = 0; fix < fixes; ++fix)
  {
    const std::size_t length =
      at < record.size() ? length_of(record[at], 1, record.size() - at) : 0;
    if (length == 0)
    {
      return false;
    }
    take(fix, at, length);
    at += length;
  }
  return at == record.size();
}

/// The part of an atom style in a particle's record: the common values (RecordSlots), values, and lists.
struct StyleLayout
{
  static constexpr std::size_t most_lists = 4;

  std::string_view name;
  std::string_view
    columns; ///< of the values behind the common ones, as in known_columns; mol is a whole number
  std::size_t values = 0; ///< doubles up to the first list, or to the end
  std::array<std::uint8_t, most_lists>
    lists = {}; ///< doubles an entry; each list begins with the number of its entries; 0: there is none
  bool bonds = false;   ///< the first list: type and partner
  bool history = false; ///< behind that of the bonds: see look_at_bonds

  bool has_lists() const noexcept { return lists[0] > 0; }
};

/// Returns a style, or null.
const StyleLayout* find_style(std::string_view name) noexcept;

/// The source of a column in a record.
struct RecordColumn
{
  enum class Kind : std::uint8_t
  {
    Double, ///< of the part of a style
    Whole,  ///< the same, a whole number
    Id,
    Type,
    Mask,
    Image, ///< slot: the axis
    OfAFix ///< part: the fix
  };

  std::string name;
  Kind kind = Kind::Double;
  std::size_t part = 0;
  std::size_t slot = 0;
};

/// The positions of all parts in the records of a file. A record is a part for each style, one after the other, each with its
/// own length except the first, and a part for each fix. Source: pack_restart of AtomVecHybrid and the fixes of LIGGGHTS.
class RecordPlan
{
public:
  static constexpr std::int64_t most_history = 1024; ///< values of a bond
  static constexpr std::int64_t most_values = 1024;  ///< of a fix

  /// Looks at the styles and the first records, until it is known whether bonds have history. Throws FormatError, IoError,
  /// Cancelled.
  RecordPlan(
    const ByteSource& source, const RestartLayout& layout, Notices& notices, Progress& progress);

  const std::vector<RecordColumn>& columns() const noexcept { return columns_; }
  std::size_t styles() const noexcept { return parts_.size(); }
  std::size_t fixes() const noexcept { return fix_lengths_.size(); } ///< 0 if none has columns
  bool has_bonds() const noexcept { return bonds_ < parts_.size(); }
  std::int64_t history_values() const noexcept { return history_values_; }
  const RecordColumn* molecule() const noexcept; ///< the column of whole numbers, if there is one
  int image_bits() const noexcept { return image_bits_; }

  /// Finds the parts of a record: where each begins, styles first, then fixes, null if these are wrong; and its bonds. Throws
  /// FormatError with the reason.
  void find_parts(
    std::span<const double> record, std::span<const double*> parts, BondBlock& bonds) const;

private:
  struct Part
  {
    const StyleLayout* style = nullptr; ///< null: unknown
    std::string name;
    bool searched = false; ///< the first one, of which the end is where the next begins
    std::int64_t most_bonds = 0;
  };

  void name_styles(const RestartLayout& layout, const Where& where, Notices& notices);
  void give_up(std::size_t part, const std::string& why, const Where& where, Notices& notices);
  void look_at(std::span<const double> record, const Where& where, Notices& notices);
  void look_at_end(std::span<const double> record, const Where& where, Notices& notices);
  bool fits(std::span<const double> record, std::size_t end) const;
  bool needs_history() const noexcept;
  void look_at_history(std::span<const double> record);
  void find_fixes(const RestartLayout& layout, std::span<const double> record, const Where& where,
    Notices& notices);
  void add_columns(const RestartLayout& layout);

  static std::size_t find_next(std::span<const double> record) noexcept;
  static std::size_t search_next(std::span<const double> record);
  std::size_t length_of_part(
    std::span<const double> record, std::size_t at, std::size_t part) const;
  std::size_t measure_style(
    std::span<const double> block, std::size_t part, bool may_have_more, BondBlock& bonds) const;
  std::size_t end_of_first(std::span<const double> record, BondBlock& bonds) const;
  std::size_t end_of_part(
    std::span<const double> record, std::size_t at, std::size_t part, BondBlock& bonds) const;
  std::size_t find_styles(
    std::span<const double> record, std::span<const double*> parts, BondBlock& bonds) const;

  std::vector<Part> parts_;
  std::vector<RecordColumn> columns_;
  std::vector<std::size_t> fix_lengths_; ///< in the record; 0: any. Empty: none has columns
  std::vector<std::size_t> fix_order_;   ///< whose the parts of a record are
  std::size_t known_fixes_ = 0;
  bool end_known_ = false; ///< of a style alone it was looked whether only fixes are behind it
  bool has_fixes_ = false;
  std::size_t bonds_ = 0; ///< the part that has them
  std::int64_t history_values_ = -1;
  int image_bits_ = 10;
};
}
#endif
