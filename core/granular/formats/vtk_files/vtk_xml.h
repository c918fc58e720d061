// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_vtk_files_vtk_xml_h
#define granular_formats_vtk_files_vtk_xml_h

#include "granular/common/error.h"
#include "granular/formats/vtk_files/vtk_values.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
/// Returns the number of characters of base64 (RFC 4648, padded) for this many bytes.
constexpr std::size_t base64_chars(std::size_t bytes) noexcept
{
  return bytes / 3 * 4 + (bytes % 3 != 0 ? 4 : 0);
}

/// Decodes this many bytes from the beginning of text; at most base64_chars(bytes) characters are read. Returns nothing
/// if the text is too short or is not base64.
std::optional<std::string> decode_base64(std::string_view text, std::size_t bytes);

/// A DataArray of a VTK XML file. It refers to the text of the file.
struct VtkXmlArray
{
  /// The encoding of the values.
  enum class Form : std::uint8_t
  {
    Ascii,
    Binary,  ///< base64
    Appended ///< behind AppendedData, all arrays together
  };

  std::string_view name;
  ValueType type = ValueType::Float64;
  Form form = Form::Ascii;
  std::int64_t components = 1;
  std::int64_t offset = 0; ///< of appended values
  std::string_view text;   ///< all others
  std::size_t begin = 0;   ///< the byte of its tag
};

/// Reads the XML files of VTK element by element; the caller knows which arrays a dataset has. Finds the start tags in order,
/// and matches the end tags with them. Skips declarations and comments. Entities are left as they are; <!DOCTYPE and CDATA are
/// not tags. Values are decoded after all elements were passed, because appended arrays come last. Handles both byte orders,
/// headers of 32 and 64 bits, and plain or zlib data. Counts in a file are claims: memory is allocated only after the bytes
/// that it needs are found.
///
/// All members throw FormatError with line or byte, and UnsupportedError for other compressors.
class VtkXml
{
public:
  /// Begins at the start of a text, which must outlive this object. path is used in errors.
  VtkXml(std::string_view text, std::string path);

  /// Moves to the next tag <name ...> or <name .../>. Returns false at the end of the text, where all elements must
  /// have ended.
  bool next();

  /// Returns the path of the element: the names of the elements around it and its own, each behind a '/'.
  const std::string& element() const noexcept { return element_; }

  /// Returns the value of an attribute; empty if it is missing.
  std::string_view attribute(std::string_view name) const noexcept;

  /// Returns an attribute of the element that is an integer of at least 0, or `otherwise` if it is missing.
  std::int64_t count(std::string_view attribute, std::int64_t otherwise) const;

  /// Returns an attribute; throws if it is missing.
  std::int64_t count(std::string_view attribute) const { return this->count(attribute, -1); }

  /// Returns the current element, which must be a DataArray.
  VtkXmlArray array() const;

  /// Returns this many values of an array, as doubles or std::int64_t.
  template <class T>
  void read(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const;

  /// Returns the place of a value of an array, for messages.
  Where where_of(const VtkXmlArray& array, std::int64_t number) const;

  /// Returns the place of an array, with its name.
  Where where(const VtkXmlArray& array) const;

  std::size_t begin() const noexcept { return begin_; } ///< the byte of the tag's '<'

  /// Returns the line of a byte of the text.
  Where where(std::size_t byte) const;

  /// Throws with the line of the tag.
  [[noreturn]] void fail(const std::string& expected, const std::string& got) const;

private:
  bool next_tag();
  bool find_tag();
  void pass(std::string_view mark);
  void end_element(std::string_view name);
  std::string_view take_name();
  void take_attributes();
  void skip_blanks() noexcept;
  bool take(char c) noexcept;
  void read_file_tag();
  void read_appended();
  template <class T>
  void read_text(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const;
  template <class T>
  void read_binary(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const;
  std::string bytes_of_array(const VtkXmlArray& array, std::int64_t bytes) const;

  std::string_view text_;
  std::string path_;
  std::string element_;
  std::vector<std::pair<std::string_view, std::string_view>> attributes_;
  std::size_t begin_ = 0; ///< of the tag
  std::size_t end_ = 0;   ///< behind its '>'
  bool ended_ = true;     ///< the element of the tag has ended with it
  bool big_endian_ = false;
  bool compressed_ = false;
  std::size_t header_bytes_ = 4; ///< of a number before binary values
  std::string_view appended_;    ///< what offsets count in
  bool appended_base64_ = true;
};
}
#endif
