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
/// Finds the start tags of an XML text in order, and matches the end tags with them. Skips declarations and comments.
/// Entities are left as they are; <!DOCTYPE and CDATA are not tags.
class XmlTags
{
public:
  /// Begins at the start of a text, which must outlive this object. path is used in errors.
  XmlTags(std::string_view text, std::string path);

  /// Moves to the next tag <name ...> or <name .../>. Returns false at the end of the text, where all elements must
  /// have ended. Throws FormatError with the line.
  bool next();

  /// Returns the path of the element: the names of the elements around it and its own, each followed by '/'.
  const std::string& element() const noexcept { return element_; }

  /// Returns the value of an attribute; empty if it is missing.
  std::string_view attribute(std::string_view name) const noexcept;

  /// Returns the text between the tag and the next one.
  std::string_view text() const noexcept;

  std::size_t begin() const noexcept { return begin_; } ///< the byte of its '<'
  std::size_t end() const noexcept { return end_; }     ///< behind its '>'

  /// Continues at a byte, which must be after end().
  void go_to(std::size_t byte) noexcept { end_ = byte; }

  /// Returns the line of a byte of the text.
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
