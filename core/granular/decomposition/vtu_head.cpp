// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/vtu_head.h"

#include "granular/common/error.h"
#include "granular/common/words.h"
#include "granular/decomposition/voxels.h"
#include "granular/numbers/number.h"
#include "granular/vtk_files/vtk_xml.h"

#include <limits>

namespace granular
{
namespace
{
/// An attribute that is a number; 0 where it is none.
std::int64_t count(const XmlTags& tags, std::string_view attribute) noexcept
{
  const std::string_view text = tags.attribute(attribute);
  std::int64_t number = 0;
  return parse_int64(text.data(), text.data() + text.size(), number) && number > 0 ? number : 0;
}

bool begins_with_tag(std::string_view text) noexcept
{
  text.remove_prefix(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  return take_word(text).starts_with('<');
}

void look_at_piece(const XmlTags& tags, VtuHead& head) noexcept
{
  constexpr std::int64_t points_a_cell = corners_of_voxel;
  const std::int64_t cells = count(tags, "NumberOfCells");
  const std::int64_t points = count(tags, "NumberOfPoints");
  const std::int64_t left = std::numeric_limits<std::int64_t>::max() - head.cells;
  head.cells += cells <= left ? cells : 0;
  head.fits = head.fits && (points > 0) == (cells > 0) && points / points_a_cell <= cells &&
    (points / points_a_cell < cells || points % points_a_cell == 0);
}

void look_at_array(const XmlTags& tags, VtuHead& head) noexcept
{
  const std::string_view name = tags.attribute("Name");
  head.has_particles = head.has_particles || name == "nlocal";
  head.has_ranks = head.has_ranks || name == "proc" || name == "procID";
}

void look_at_tags(std::string_view text, VtuHead& head)
{
  XmlTags tags(text, {});
  if (!begins_with_tag(text) || !tags.next() || tags.element() != "/VTKFile" ||
    tags.attribute("type") != "UnstructuredGrid")
  {
    return;
  }
  head.unstructured = true;
  while (tags.next() && tags.element() != "/VTKFile/AppendedData")
  {
    if (tags.element() == "/VTKFile/UnstructuredGrid/Piece")
    {
      look_at_piece(tags, head);
    }
    else if (tags.element() == "/VTKFile/UnstructuredGrid/Piece/CellData/DataArray")
    {
      look_at_array(tags, head);
    }
  }
}
}

VtuHead look_at(std::string_view text)
{
  VtuHead head;
  try
  {
    look_at_tags(text, head);
  }
  catch (const Error&)
  {
    return head; // what was found before the end of the text, or what is wrong there
  }
  return head;
}
}
