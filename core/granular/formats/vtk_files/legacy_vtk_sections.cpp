// SPDX-License-Identifier: BSD-3-Clause
// Arrays and cells of legacy VTK files.
#include "granular/formats/vtk_files/legacy_vtk.h"

#include <algorithm>
#include <iterator>

namespace granular
{
namespace
{
struct TypeName
{
  std::string_view name;
  ValueType type;
};

// clang-format off
constexpr TypeName type_names[] = {
  { "bit", ValueType::Bit },
  { "char", ValueType::Int8 },
  { "signed_char", ValueType::Int8 },
  { "unsigned_char", ValueType::UInt8 },
  { "short", ValueType::Int16 },
  { "unsigned_short", ValueType::UInt16 },
  { "int", ValueType::Int32 },
  { "vtkidtype", ValueType::Int32 },
  { "vtktypeint32", ValueType::Int32 },
  { "unsigned_int", ValueType::UInt32 },
  { "long", ValueType::Int64 },
  { "vtktypeint64", ValueType::Int64 },
  { "unsigned_long", ValueType::UInt64 },
  { "vtktypeuint64", ValueType::UInt64 },
  { "float", ValueType::Float32 },
  { "double", ValueType::Float64 },
  { "string", ValueType::Text },
  { "utf8_string", ValueType::Text },
  { "variant", ValueType::Variant },
};

/// A line that begins one array: "KEYWORD name ..."; numbers are places of words, 0: there is none.
struct Attribute
{
  std::string_view keyword;
  std::int64_t components;     ///< where no word says
  std::size_t components_word;
  std::size_t type_word;       ///< none: bytes
  std::size_t tuples_word;     ///< none: as the section says
};

constexpr Attribute attributes[] = {
  { "SCALARS", 1, 3, 2, 0 },
  { "COLOR_SCALARS", 1, 2, 0, 0 },
  { "LOOKUP_TABLE", 4, 0, 0, 2 },
  { "VECTORS", 3, 0, 2, 0 },
  { "NORMALS", 3, 0, 2, 0 },
  { "TEXTURE_COORDINATES", 2, 2, 3, 0 },
  { "TENSORS", 9, 0, 2, 0 },
  { "TENSORS6", 6, 0, 2, 0 },
  { "GLOBAL_IDS", 1, 0, 2, 0 },
  { "PEDIGREE_IDS", 1, 0, 2, 0 },
  { "EDGE_FLAGS", 1, 0, 2, 0 },
};
// clang-format on

bool equal_but_capitals(std::string_view word, std::string_view small)
{
  return std::ranges::equal(word, small,
    [](char c, char s) { return c == s || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == s); });
}
}

ValueType LegacyVtk::type(std::size_t word) const
{
  const std::string_view name = word < words_.size() ? words_[word] : std::string_view();
  const auto* const found = std::find_if(std::begin(type_names), std::end(type_names),
    [name](const TypeName& known) { return equal_but_capitals(name, known.name); });
  if (found == std::end(type_names))
  {
    this->fail("a type of values as word " + std::to_string(word + 1), line_text_);
  }
  return found->type;
}

VtkArray LegacyVtk::values(std::int64_t components) const
{
  return { {}, this->type(2), components, this->count(1) };
}

bool LegacyVtk::take_arrays(std::int64_t tuples, const TakeArray& take)
{
  if (this->is("FIELD"))
  {
    this->take_fields(take);
    return true;
  }
  const auto* const found = std::find_if(std::begin(attributes), std::end(attributes),
    [this](const Attribute& known) { return this->is(known.keyword); });
  if (found == std::end(attributes))
  {
    return false;
  }
  if (words_.size() < 2)
  {
    this->fail("a name as word 2", line_text_);
  }
  VtkArray array;
  array.name = words_[1];
  array.type = found->type_word > 0 ? this->type(found->type_word) : ValueType::UInt8;
  const bool says = found->components_word > 0 && found->components_word < words_.size();
  array.components = says ? this->count(found->components_word) : found->components;
  array.tuples = found->tuples_word > 0 ? this->count(found->tuples_word) : tuples;
  if (this->is("SCALARS"))
  {
    this->need("LOOKUP_TABLE");
    if (!this->is("LOOKUP_TABLE"))
    {
      this->fail("LOOKUP_TABLE", line_text_);
    }
  }
  this->take_array(array, take);
  return true;
}

/// FIELD name arrays, and then for each "name components tuples type".
void LegacyVtk::take_fields(const TakeArray& take)
{
  const std::int64_t arrays = this->count(2);
  for (std::int64_t i = 0; i < arrays; ++i)
  {
    this->need(
      "an array of the field (" + std::to_string(i + 1) + " of " + std::to_string(arrays) + ")");
    if (this->is("NULL_ARRAY"))
    {
      continue; // all that VTK writes of it
    }
    VtkArray array;
    array.name = words_[0];
    array.components = this->count(1);
    array.tuples = this->count(2);
    array.type = this->type(3);
    this->take_array(array, take);
  }
}

void LegacyVtk::take_array(const VtkArray& array, const TakeArray& take)
{
  if (!take || !take(array))
  {
    this->skip(array);
  }
}

/// Binary strings: their length in one, two, four or eight bytes, which the first two bits tell, and their bytes.
void LegacyVtk::skip_strings(std::int64_t count)
{
  constexpr std::size_t lengths[] = { 8, 4, 2, 1 };
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (!this->have(1))
    {
      this->fail_count(i, count);
    }
    const std::size_t bytes = lengths[static_cast<unsigned char>(this->text().front()) >> 6];
    if (!this->have(bytes))
    {
      this->fail_count(i, count);
    }
    std::int64_t length = static_cast<unsigned char>(this->text().front()) & 0x3f;
    for (std::size_t at = 1; at < bytes; ++at)
    {
      length = length << 8 | static_cast<unsigned char>(this->text()[at]);
    }
    this->pass(bytes);
    this->skip_bytes(std::min(length, no_end - this->offset()), count);
  }
}

VtkCells LegacyVtk::cells(bool keep)
{
  VtkCells cells;
  const std::int64_t first = this->count(1);
  const std::int64_t second = this->count(2);
  if (!binary_)
  {
    this->skip_blanks();
  }
  constexpr std::string_view offsets = "OFFSETS";
  const bool has_offsets = this->have(offsets.size()) &&
    equal_but_capitals(this->text().substr(0, offsets.size()), "offsets");
  cells.size = has_offsets ? std::max(std::int64_t{ 1 }, first) - 1 : first;
  cells.values = { {}, ValueType::Int32, 1, second };
  if (has_offsets)
  {
    this->need("OFFSETS");
    const VtkArray values = { {}, this->type(1), 1, first };
    const VtkPlace place = this->place();
    this->take(values, keep, cells.offsets);
    this->need("CONNECTIVITY");
    if (!this->is("CONNECTIVITY"))
    {
      this->fail("CONNECTIVITY", line_text_);
    }
    cells.values.type = this->type(1);
    if (keep)
    {
      this->check_offsets(cells, place);
    }
  }
  cells.place = this->place();
  this->take(cells.values, keep, cells.connectivity);
  if (keep && !has_offsets)
  {
    this->split_cells(cells);
  }
  cells.counted = !has_offsets;
  return cells;
}

void LegacyVtk::check_offsets(const VtkCells& cells, const VtkPlace& place) const
{
  const std::vector<std::int64_t>& offsets = cells.offsets;
  const bool good = offsets.empty() ? cells.values.tuples == 0
                                    : offsets.front() == 0 &&
      offsets.back() == cells.values.tuples && std::ranges::is_sorted(offsets);
  if (!good)
  {
    throw FormatError("expected OFFSETS that rise from 0 to " +
        std::to_string(cells.values.tuples) + ", got others",
      this->where(place));
  }
}

/// Takes the counts out of what stands in the file.
void LegacyVtk::split_cells(VtkCells& cells)
{
  std::vector<std::int64_t>& values = cells.connectivity;
  const auto size = static_cast<std::int64_t>(values.size());
  std::int64_t from = 0;
  std::int64_t to = 0;
  cells.offsets.push_back(0);
  while (from < size)
  {
    const std::int64_t points = values[static_cast<std::size_t>(from)];
    if (points < 0 || points > size - from - 1)
    {
      throw FormatError("expected a number of points, of which there are at most " +
          std::to_string(size - from - 1) + ", got " + std::to_string(points),
        this->where_of(cells.place, cells.values, from));
    }
    ++from;
    for (const std::int64_t end = from + points; from < end; ++from, ++to)
    {
      values[static_cast<std::size_t>(to)] = values[static_cast<std::size_t>(from)];
    }
    cells.offsets.push_back(to);
  }
  values.resize(static_cast<std::size_t>(to));
  const auto found = static_cast<std::int64_t>(cells.offsets.size()) - 1;
  if (found != cells.size)
  {
    throw FormatError("expected " + std::to_string(cells.size) + " cells in " +
        std::to_string(size) + " numbers, got " + std::to_string(found),
      this->where(cells.place));
  }
}

Where LegacyVtk::where_of(const VtkPlace& first, const VtkArray& array, std::int64_t number)
{
  this->go_to(first);
  this->skip({ {}, array.type, 1, number });
  if (!binary_)
  {
    this->skip_blanks();
  }
  return this->where(this->place());
}

Where LegacyVtk::where_of(const VtkCells& cells, std::int64_t cell)
{
  const std::int64_t before = cells.offsets[static_cast<std::size_t>(cell)];
  return this->where_of(cells.place, cells.values, before + (cells.counted ? cell : 0));
}
}
