// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/vtk_xml.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <iterator>

namespace granular
{
namespace
{
constexpr bool is_name(char c) noexcept
{
  return !is_blank(c) && std::string_view("<>/=\"'?!").find(c) == std::string_view::npos;
}

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
  const VtkXml& file, std::string_view attribute, bool optional, const Choice<T> (&choices)[N])
{
  const std::string_view word = file.attribute(attribute);
  const auto* const found = std::find_if(std::begin(choices), std::end(choices),
    [&](const Choice<T>& choice) { return choice.word == word || (optional && word.empty()); });
  if (found == std::end(choices))
  {
    file.fail("the " + std::string(attribute) + " " + join_words(choices, " or ", &Choice<T>::word),
      quoted(word));
  }
  return found->value;
}
}

VtkXml::VtkXml(std::string_view text, std::string path)
  : text_(text)
  , path_(std::move(path))
  , end_(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0)
{
}

bool VtkXml::next_tag()
{
  if (ended_ && !element_.empty())
  {
    element_.erase(element_.rfind('/'));
  }
  ended_ = false;
  while (this->find_tag())
  {
    const bool ends = this->take('/');
    const std::string_view name = this->take_name();
    if (!ends)
    {
      this->take_attributes();
      element_.append("/").append(name);
      ended_ = this->take('/');
    }
    else
    {
      this->skip_blanks();
    }
    if (!this->take('>'))
    {
      this->fail("'>' at the end of a tag", quoted(text_.substr(begin_)));
    }
    if (!ends)
    {
      return true;
    }
    this->end_element(name);
  }
  if (!element_.empty())
  {
    begin_ = text_.size();
    this->fail("</" + element_.substr(element_.rfind('/') + 1) + ">", "the end of the file");
  }
  ended_ = true;
  return false;
}

/// Goes behind the '<' of the next tag. False: there is none.
bool VtkXml::find_tag()
{
  for (;;)
  {
    begin_ = std::min(text_.find('<', end_), text_.size());
    end_ = begin_;
    const std::string_view rest = text_.substr(begin_);
    if (rest.starts_with("<?"))
    {
      this->pass("?>");
    }
    else if (rest.starts_with("<!--"))
    {
      this->pass("-->");
    }
    else
    {
      return this->take('<');
    }
  }
}

/// Goes behind a mark.
void VtkXml::pass(std::string_view mark)
{
  const std::size_t found = text_.find(mark, begin_);
  if (found == std::string_view::npos)
  {
    this->fail("'" + std::string(mark) + "'", "the end of the file");
  }
  end_ = found + mark.size();
}

void VtkXml::end_element(std::string_view name)
{
  const std::size_t last = element_.rfind('/');
  if (last == std::string::npos || element_.compare(last + 1, std::string::npos, name) != 0)
  {
    const bool none = last == std::string::npos;
    this->fail(none ? "no more tags" : "</" + element_.substr(last + 1) + ">",
      quoted(text_.substr(begin_, end_ - begin_)));
  }
  element_.erase(last);
}

std::string_view VtkXml::take_name()
{
  const std::size_t first = end_;
  while (end_ < text_.size() && is_name(text_[end_]))
  {
    ++end_;
  }
  if (end_ == first)
  {
    this->fail("a name in a tag", quoted(text_.substr(begin_)));
  }
  return text_.substr(first, end_ - first);
}

void VtkXml::take_attributes()
{
  attributes_.clear();
  for (this->skip_blanks(); end_ < text_.size() && is_name(text_[end_]); this->skip_blanks())
  {
    const std::string_view name = this->take_name();
    this->skip_blanks();
    const bool equal = this->take('=');
    this->skip_blanks();
    const char quote = end_ < text_.size() ? text_[end_] : '\0';
    const std::size_t last =
      quote == '"' || quote == '\'' ? text_.find(quote, end_ + 1) : std::string_view::npos;
    if (!equal || last == std::string_view::npos)
    {
      this->fail("a value in quotes of '" + std::string(name.substr(0, 40)) + "'",
        quoted(text_.substr(begin_)));
    }
    attributes_.emplace_back(name, text_.substr(end_ + 1, last - end_ - 1));
    end_ = last + 1;
  }
}

void VtkXml::skip_blanks() noexcept
{
  while (end_ < text_.size() && is_blank(text_[end_]))
  {
    ++end_;
  }
}

bool VtkXml::take(char c) noexcept
{
  const bool is = end_ < text_.size() && text_[end_] == c;
  end_ += is ? 1 : 0;
  return is;
}

std::string_view VtkXml::attribute(std::string_view name) const noexcept
{
  const auto found = std::find_if(attributes_.begin(), attributes_.end(),
    [&](const auto& attribute) { return attribute.first == name; });
  return found == attributes_.end() ? std::string_view() : found->second;
}

Where VtkXml::where(std::size_t byte) const
{
  const std::string_view before = text_.substr(0, byte);
  return { path_, 1 + std::count(before.begin(), before.end(), '\n') };
}

void VtkXml::fail(const std::string& expected, const std::string& got) const
{
  throw FormatError("expected " + expected + ", got " + got, this->where(begin_));
}

bool VtkXml::next()
{
  if (!this->next_tag())
  {
    return false;
  }
  if (element_ == "/VTKFile")
  {
    this->read_file_tag();
  }
  else if (element_ == "/VTKFile/AppendedData")
  {
    this->read_appended();
  }
  return true;
}

void VtkXml::read_file_tag()
{
  big_endian_ = choose(*this, "byte_order", true, byte_orders);
  header_bytes_ = choose(*this, "header_type", true, header_types);
  const std::string_view compressor = this->attribute("compressor");
  compressed_ = !compressor.empty();
  if (compressed_ && compressor != "vtkZLibDataCompressor")
  {
    throw UnsupportedError(
      "expected values without compression or with vtkZLibDataCompressor, got " +
        quoted(compressor) + "; save the file with zlib or as ASCII",
      this->where(begin_));
  }
}

/// Whatever these bytes are, none of them are tags.
void VtkXml::read_appended()
{
  appended_base64_ = choose(*this, "encoding", true, encodings);
  const std::size_t last = text_.rfind("</AppendedData");
  const std::size_t mark = text_.find('_', end_);
  if (last == std::string_view::npos || mark == std::string_view::npos || mark >= last)
  {
    this->fail("'_' and bytes behind AppendedData, and its end", "none");
  }
  appended_ = text_.substr(mark + 1, last - mark - 1);
  end_ = last;
}

std::int64_t VtkXml::count(std::string_view attribute, std::int64_t otherwise) const
{
  const std::string_view text = this->attribute(attribute);
  std::int64_t number = otherwise;
  const bool good =
    text.empty() || (parse_int64(text.data(), text.data() + text.size(), number) && number >= 0);
  if (!good || number < 0)
  {
    this->fail("a number of at least 0 as " + std::string(attribute), quoted(text));
  }
  return number;
}

VtkXmlArray VtkXml::array() const
{
  VtkXmlArray array;
  array.name = this->attribute("Name");
  array.type = choose(*this, "type", false, types);
  array.form = choose(*this, "format", true, forms);
  array.components = this->count("NumberOfComponents", 1);
  if (array.form == VtkXmlArray::Form::Appended)
  {
    array.offset = this->count("offset");
  }
  array.text = ended_ ? std::string_view() : text_.substr(end_, text_.find('<', end_) - end_);
  array.begin = begin_;
  return array;
}

Where VtkXml::where(const VtkXmlArray& array) const
{
  Where where = this->where(array.begin);
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
  return this->where(static_cast<std::size_t>(word.data() - text_.data()));
}
}
