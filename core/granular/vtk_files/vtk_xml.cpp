// SPDX-License-Identifier: BSD-3-Clause
#include "granular/vtk_files/vtk_xml.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <iterator>

namespace granular
{
namespace
{
/// A value that an attribute may have, and its meaning.
template <class T>
struct Choice
{
  std::string_view word;
  T value;
};

constexpr Choice<bool> byte_orders[] = { { "LittleEndian", false }, { "BigEndian", true } };
constexpr Choice<std::size_t> header_types[] = { { "UInt32", 4 }, { "UInt64", 8 } };
constexpr Choice<bool> encodings[] = { { "base64", true }, { "raw", false } };
constexpr Choice<VtkXmlArray::Form> forms[] = { { "ascii", VtkXmlArray::Form::Ascii },
  { "binary", VtkXmlArray::Form::Binary }, { "appended", VtkXmlArray::Form::Appended } };
constexpr Choice<ValueType> types[] = { { "Int8", ValueType::Int8 }, { "UInt8", ValueType::UInt8 },
  { "Int16", ValueType::Int16 }, { "UInt16", ValueType::UInt16 }, { "Int32", ValueType::Int32 },
  { "UInt32", ValueType::UInt32 }, { "Int64", ValueType::Int64 }, { "UInt64", ValueType::UInt64 },
  { "Float32", ValueType::Float32 }, { "Float64", ValueType::Float64 } };

/// Returns the meaning of an attribute of the element; the first choice where it is optional and not there.
template <class T, std::size_t N>
T choose(
  const XmlTags& tags, std::string_view attribute, bool optional, const Choice<T> (&choices)[N])
{
  const std::string_view word = tags.attribute(attribute);
  const auto* const found = std::find_if(std::begin(choices), std::end(choices),
    [&](const Choice<T>& choice) { return choice.word == word || (optional && word.empty()); });
  if (found == std::end(choices))
  {
    std::string all;
    for (const Choice<T>& choice : choices)
    {
      all.append(all.empty() ? "" : " or ").append(choice.word);
    }
    tags.fail("the " + std::string(attribute) + " " + all, quoted(word));
  }
  return found->value;
}
}

VtkXml::VtkXml(std::string_view text, std::string path)
  : text_(text)
  , path_(path)
  , tags_(text, std::move(path))
{
}

bool VtkXml::next()
{
  if (!tags_.next())
  {
    return false;
  }
  if (tags_.element() == "/VTKFile")
  {
    this->read_file_tag();
  }
  else if (tags_.element() == "/VTKFile/AppendedData")
  {
    this->read_appended();
  }
  return true;
}

void VtkXml::read_file_tag()
{
  big_endian_ = choose(tags_, "byte_order", true, byte_orders);
  header_bytes_ = choose(tags_, "header_type", true, header_types);
  const std::string_view compressor = tags_.attribute("compressor");
  compressed_ = !compressor.empty();
  if (compressed_ && compressor != "vtkZLibDataCompressor")
  {
    throw UnsupportedError(
      "expected values without compression or with vtkZLibDataCompressor, got " +
        quoted(compressor) + "; save the file with zlib or as ASCII",
      tags_.where(tags_.begin()));
  }
}

/// Whatever these bytes are, none of them are tags.
void VtkXml::read_appended()
{
  appended_base64_ = choose(tags_, "encoding", true, encodings);
  const std::size_t last = text_.rfind("</AppendedData");
  const std::size_t mark = text_.find('_', tags_.end());
  if (last == std::string_view::npos || mark == std::string_view::npos || mark >= last)
  {
    tags_.fail("'_' and bytes behind AppendedData, and its end", "none");
  }
  appended_ = text_.substr(mark + 1, last - mark - 1);
  tags_.go_to(last);
}

std::int64_t VtkXml::count(std::string_view attribute, std::int64_t otherwise) const
{
  const std::string_view text = tags_.attribute(attribute);
  std::int64_t number = otherwise;
  const bool good =
    text.empty() || (parse_int64(text.data(), text.data() + text.size(), number) && number >= 0);
  if (!good || number < 0)
  {
    tags_.fail("a number of at least 0 as " + std::string(attribute), quoted(text));
  }
  return number;
}

VtkXmlArray VtkXml::array() const
{
  VtkXmlArray array;
  array.name = tags_.attribute("Name");
  array.type = choose(tags_, "type", false, types);
  array.form = choose(tags_, "format", true, forms);
  array.components = this->count("NumberOfComponents", 1);
  if (array.form == VtkXmlArray::Form::Appended)
  {
    array.offset = this->count("offset");
  }
  array.text = tags_.text();
  array.begin = tags_.begin();
  return array;
}

Where VtkXml::where(const VtkXmlArray& array) const
{
  Where where = tags_.where(array.begin);
  where.column = array.name.substr(0, 40);
  return where;
}

Where VtkXml::where_of(const VtkXmlArray& array, std::int64_t number) const
{
  if (array.form != VtkXmlArray::Form::Ascii)
  {
    return this->where(array);
  }
  std::string_view rest = array.text;
  std::string_view word = take_word(rest);
  for (std::int64_t i = 0; i < number; ++i)
  {
    word = take_word(rest);
  }
  return tags_.where(static_cast<std::size_t>(word.data() - text_.data()));
}
}
