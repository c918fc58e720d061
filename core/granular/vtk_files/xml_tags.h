// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_xml_tags_h
#define granular_vtk_files_xml_tags_h

#include "granular/common/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
/// Finds the tags of an XML text that begin elements, one after the other, and holds those that end them against
/// them. Passes over declarations and comments. Entities are left as they are; <!DOCTYPE and CDATA are no tags.
class XmlTags
{
public:
  /// The text must outlive this; path is for errors.
  XmlTags(std::string_view text, std::string path);

  /// The next tag <name ...> or <name .../>. False at the end of the text, where all elements must have ended. Throws
  /// FormatError with the line.
  bool next();

  /// Where it is: the names of the elements around it and its own, each behind a '/'.
  const std::string& element() const noexcept { return element_; }

  /// The value of an attribute; empty: it has none.
  std::string_view attribute(std::string_view name) const noexcept;

  /// The text behind it, up to the next tag.
  std::string_view text() const noexcept;

  std::size_t begin() const noexcept { return begin_; } ///< the byte of its '<'
  std::size_t end() const noexcept { return end_; }     ///< behind its '>'

  /// Goes on at a byte, which is behind end().
  void go_to(std::size_t byte) noexcept { end_ = byte; }

  /// The line of a byte of the text.
  Where where(std::size_t byte) const;

  [[noreturn]] void fail(const std::string& expected, const std::string& got) const;

private:
  bool find_tag();
  void pass(std::string_view mark);
  void end_element(std::string_view name);
  std::string_view take_name();
  void take_attributes();
  void skip_blanks() noexcept;
  bool take(char c) noexcept;

  std::string_view text_;
  std::string path_;
  std::string element_;
  std::vector<std::pair<std::string_view, std::string_view>> attributes_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool ended_ = true; ///< the element of the tag has ended with it
};
}
#endif
