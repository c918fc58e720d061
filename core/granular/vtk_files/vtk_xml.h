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
  /// How the values stand there.
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

/// Reads the XML files of VTK element by element: the caller knows which arrays a dataset has. Values are decoded
/// when all elements were passed: those of appended arrays come last. Either byte order, headers of 32 and 64 bits,
/// plain or with zlib. Counts are claims: nothing is allocated before the bytes that they need are there.
///
/// All members throw FormatError with line or byte, and UnsupportedError (another compressor).
class VtkXml
{
public:
  /// The text must outlive this; path is for errors.
  VtkXml(std::string_view text, std::string path);

  /// The next element; see XmlTags. False at the end.
  bool next();
  const XmlTags& tags() const noexcept { return tags_; }

  /// An attribute of the element that is a number of at least 0; one that is not there is the other one.
  std::int64_t count(std::string_view attribute, std::int64_t otherwise) const;

  /// The same; throws if it is not there.
  std::int64_t count(std::string_view attribute) const { return this->count(attribute, -1); }

  /// The element, a DataArray.
  VtkXmlArray array() const;

  /// The values of an array, which must be so many: doubles, or whole ones as std::int64_t.
  template <class T>
  void read(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const;

  /// The place of a value of an array, for messages.
  Where where_of(const VtkXmlArray& array, std::int64_t number) const;

  /// The place of an array, with its name.
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
