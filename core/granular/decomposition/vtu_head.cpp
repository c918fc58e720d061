// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/vtu_head.h"

#include "granular/base/number.h"
#include "granular/base/words.h"

#include <limits>

namespace granular
{
namespace
{
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Takes the next tag of that name off a text: its inside behind the name. False: there is none, or its end is missing.
bool take_tag(std::string_view& text, std::string_view name, std::string_view& inside) noexcept
{
  for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1))
  {
    const std::string_view rest = text.substr(at + 1);
    const bool same = rest.starts_with(name) && rest.size() > name.size() &&
      (is_blank(rest[name.size()]) || rest[name.size()] == '>' || rest[name.size()] == '/');
    if (same)
    {
      const std::size_t end = rest.find('>');
      inside = rest.substr(name.size(), end == rest.npos ? 0 : end - name.size());
      text = end == rest.npos ? std::string_view() : rest.substr(end + 1);
      return end != rest.npos;
    }
  }
  return false;
}

/// The value of an attribute of a tag; empty: it has none.
std::string_view attribute(std::string_view inside, std::string_view name) noexcept
{
  for (std::size_t at = inside.find(name); at != inside.npos; at = inside.find(name, at + 1))
  {
    std::string_view rest = inside.substr(at + name.size());
    if (at > 0 && is_blank(inside[at - 1]) && rest.size() > 2 && rest[0] == '=' &&
      (rest[1] == '"' || rest[1] == '\''))
    {
      const char quote = rest[1];
      rest.remove_prefix(2);
      const std::size_t end = rest.find(quote);
      return end == rest.npos ? std::string_view() : rest.substr(0, end);
    }
  }
  return {};
}
}

bool is_unstructured(std::string_view head) noexcept
{
  if (head.starts_with(byte_order_mark))
  {
    head.remove_prefix(byte_order_mark.size());
  }
  while (!head.empty() && is_blank(head.front()))
  {
    head.remove_prefix(1);
  }
  const bool is_xml = head.starts_with("<?xml") || head.starts_with("<VTKFile");
  std::string_view inside;
  return is_xml && take_tag(head, "VTKFile", inside) &&
    attribute(inside, "type") == "UnstructuredGrid";
}

std::int64_t cells_in(std::string_view head) noexcept
{
  std::int64_t sum = 0;
  std::string_view inside;
  while (take_tag(head, "Piece", inside))
  {
    const std::string_view text = attribute(inside, "NumberOfCells");
    std::int64_t cells = 0;
    const bool good = parse_int64(text.data(), text.data() + text.size(), cells) && cells >= 0 &&
      cells <= std::numeric_limits<std::int64_t>::max() - sum;
    sum += good ? cells : 0;
  }
  return sum;
}

bool has_cell_array(std::string_view head, std::string_view name) noexcept
{
  std::string_view inside;
  if (!take_tag(head, "CellData", inside))
  {
    return false;
  }
  std::string_view data = head.substr(0, head.find("</CellData>"));
  while (take_tag(data, "DataArray", inside))
  {
    if (attribute(inside, "Name") == name)
    {
      return true;
    }
  }
  return false;
}
}
