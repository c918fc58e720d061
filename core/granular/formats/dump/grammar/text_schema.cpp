// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/atom_fit.h"
#include "granular/formats/dump/grammar/text_dump.h"

#include <algorithm>

namespace granular
{
namespace
{
/// Columns of old dumps of LAMMPS that do not name them: dump atom, scaled, with or without images.
std::vector<std::string> unnamed_columns(std::size_t words, const Where& where)
{
  if (words != 0 && words != 5 && words != 8)
  {
    throw FormatError(
      "expected 5 or 8 words in a row of a dump that does not name its columns, got " +
        std::to_string(words),
      where);
  }
  return name_columns(words == 8 ? 8 : 5, {}, { .scaled = true }).names;
}
}

std::vector<std::string> numbered_columns(std::size_t count)
{
  std::vector<std::string> names;
  while (names.size() < count)
  {
    names.push_back("column" + std::to_string(names.size() + 1));
  }
  return names;
}

ColumnSchema make_schema(std::vector<std::string> names,
  const std::vector<std::string_view>& first_row, const std::string& counted, const Where& where)
{
  if (names.empty())
  {
    names = counted == "ATOMS" ? unnamed_columns(first_row.size(), where)
                               : numbered_columns(first_row.size());
  }
  ColumnSchema schema(names, known_columns(), where);
  std::vector<ColumnSchema::TypeChange> texts;
  for (std::size_t i = 0; i < std::min(names.size(), first_row.size()); ++i)
  {
    if (schema.columns()[i].may_be_words && !is_number(first_row[i]))
    {
      texts.push_back({ static_cast<int>(i), ValueType::Text });
    }
  }
  schema.set_types(texts);
  return schema;
}

bool makes_schema(const std::vector<std::string>& names,
  const std::vector<std::string_view>& first_row, const ColumnSchema& schema)
{
  const std::vector<ColumnInfo>& columns = schema.columns();
  for (std::size_t i = 0; i < columns.size() && names.size() == columns.size(); ++i)
  {
    const bool text = i < first_row.size() && !is_number(first_row[i]);
    if (columns[i].name != names[i] ||
      (columns[i].may_be_words && text != (columns[i].type == ValueType::Text)))
    {
      return false;
    }
  }
  return names.size() == columns.size() && (!names.empty() || first_row.empty());
}

bool take_first_row(TextScanner& scanner, std::int64_t rows, std::vector<std::string_view>& words)
{
  std::string_view line;
  words.clear();
  while (rows > 0 && words.empty() && scanner.next(line))
  {
    append_words(line, words);
  }
  return !words.empty();
}

bool makes_columns(const TextHeader& header, TextScanner& scanner, const ColumnSchema& schema)
{
  const std::vector<std::string>& names = header.column_names();
  std::vector<std::string_view> first_row;
  take_first_row(scanner, header.header().rows, first_row);
  if (makes_schema(names, first_row, schema))
  {
    return true;
  }
  try
  {
    // names that no header gives
    return make_schema(names, first_row, header.header().counted, {}) == schema;
  }
  catch (const FormatError&)
  {
    return false;
  }
}
}
