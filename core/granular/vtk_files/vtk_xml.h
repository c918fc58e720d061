// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_vtk_xml_h
#define granular_vtk_files_vtk_xml_h

#include "granular/common/error.h"
#include "granular/vtk_files/vtk_values.h"
#include "granular/vtk_files/xml_tags.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
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

/// Reads the XML files of VTK element by element; the caller knows which arrays a dataset has. Values are decoded after
/// all elements were passed, because appended arrays come last. Handles both byte orders, headers of 32 and 64 bits,
/// and plain or zlib data. Counts in a file are claims: memory is allocated only after the bytes that it needs are
/// found.
///
/// All members throw FormatError with line or byte, and UnsupportedError for other compressors.
class VtkXml
{
public:
  /// Begins at the start of a text, which must outlive this object. path is used in errors.
  VtkXml(std::string_view text, std::string path);

  /// Moves to the next element; see XmlTags. Returns false at the end.
  bool next();
  const XmlTags& tags() const noexcept { return tags_; }

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

private:
  void read_file_tag();
  void read_appended();
  template <class T>
  void read_text(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const;
  template <class T>
  void read_binary(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const;
  std::string bytes_of_array(const VtkXmlArray& array, std::int64_t bytes) const;

  std::string_view text_;
  std::string path_;
  XmlTags tags_;
  bool big_endian_ = false;
  bool compressed_ = false;
  std::size_t header_bytes_ = 4; ///< of a number before binary values
  std::string_view appended_;    ///< what offsets count in
  bool appended_base64_ = true;
};
}
#endif
