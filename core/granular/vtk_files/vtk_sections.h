// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_vtk_sections_h
#define granular_vtk_files_vtk_sections_h

#include "granular/vtk_files/legacy_vtk.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

namespace granular
{
/// A section of a dataset of a legacy VTK file, and the member of a Reader that reads it.
template <class Reader>
struct VtkSection
{
  std::string_view dataset; ///< kind, as in VtkHeader
  const char* keyword;
  void (Reader::*read)();
  bool optional = false;
};

/// Reads the sections of a dataset, each of which may occur once.
template <class Reader>
class VtkSections
{
public:
  /// Stores the table of sections, at most 32.
  VtkSections(LegacyVtk& file, std::span<const VtkSection<Reader>> sections)
    : file_(file)
    , sections_(sections)
  {
  }

  /// Reads the section that the line begins. Returns false if the line begins no section of this dataset. Throws
  /// FormatError for a repeated section.
  bool read(std::string_view dataset, Reader& reader)
  {
    const auto section = std::find_if(sections_.begin(), sections_.end(),
      [&](const auto& each) { return each.dataset == dataset && file_.is(each.keyword); });
    if (section == sections_.end())
    {
      return false;
    }
    const auto bit = std::uint32_t{ 1 } << (section - sections_.begin());
    if ((seen_ & bit) != 0)
    {
      file_.fail("one section of the name", section->keyword);
    }
    seen_ |= bit;
    (reader.*section->read)();
    return true;
  }

  /// Throws FormatError if a section is missing at the end, or before the current line, which begins the data.
  void end(std::string_view dataset, bool at_end) const
  {
    for (std::size_t i = 0; i < sections_.size(); ++i)
    {
      const VtkSection<Reader>& section = sections_[i];
      if (section.dataset != dataset || section.optional || (seen_ >> i & 1) != 0)
      {
        continue;
      }
      at_end ? file_.fail_missing(section.keyword)
             : file_.fail(section.keyword, file_.words().front());
    }
  }

private:
  LegacyVtk& file_;
  std::span<const VtkSection<Reader>> sections_;
  std::uint32_t seen_ = 0; ///< a bit each
};
}
#endif
