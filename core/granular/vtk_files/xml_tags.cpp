// SPDX-License-Identifier: BSD-3-Clause
#include "granular/vtk_files/xml_tags.h"

#include "granular/common/words.h"

#include <algorithm>

namespace granular
{
namespace
{
constexpr bool is_name(char c) noexcept
{
  return !is_blank(c) && std::string_view("<>/=\"'?!").find(c) == std::string_view::npos;
}
}

XmlTags::XmlTags(std::string_view text, std::string path)
  : text_(text)
  , path_(std::move(path))
  , end_(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0)
{
}

bool XmlTags::next()
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
bool XmlTags::find_tag()
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
void XmlTags::pass(std::string_view mark)
{
  const std::size_t found = text_.find(mark, begin_);
  if (found == std::string_view::npos)
  {
    this->fail("'" + std::string(mark) + "'", "the end of the file");
  }
  end_ = found + mark.size();
}

void XmlTags::end_element(std::string_view name)
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

std::string_view XmlTags::take_name()
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

void XmlTags::take_attributes()
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

void XmlTags::skip_blanks() noexcept
{
  while (end_ < text_.size() && is_blank(text_[end_]))
  {
    ++end_;
  }
}

bool XmlTags::take(char c) noexcept
{
  const bool is = end_ < text_.size() && text_[end_] == c;
  end_ += is ? 1 : 0;
  return is;
}

std::string_view XmlTags::attribute(std::string_view name) const noexcept
{
  const auto found = std::find_if(attributes_.begin(), attributes_.end(),
    [&](const auto& attribute) { return attribute.first == name; });
  return found == attributes_.end() ? std::string_view() : found->second;
}

std::string_view XmlTags::text() const noexcept
{
  return ended_ ? std::string_view() : text_.substr(end_, text_.find('<', end_) - end_);
}

Where XmlTags::where(std::size_t byte) const
{
  const std::string_view before = text_.substr(0, byte);
  return { path_, 1 + std::count(before.begin(), before.end(), '\n') };
}

void XmlTags::fail(const std::string& expected, const std::string& got) const
{
  throw FormatError("expected " + expected + ", got " + got, this->where(begin_));
}
}
