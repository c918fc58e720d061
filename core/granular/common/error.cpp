// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/error.h"

#include "granular/common/shown_path.h"

#include <utility>

namespace granular
{
namespace
{
std::string message(const std::string& text, const Where& where)
{
  const std::string place = to_string(where);
  return place.empty() ? shown_path(text) : place + ": " + shown_path(text);
}
}

std::string to_string(const Where& where)
{
  std::string text = shown_path(where.path);
  if (where.line > 0)
  {
    text += ":" + std::to_string(where.line);
  }
  else if (where.byte >= 0)
  {
    text += "@" + std::to_string(where.byte);
  }
  if (!where.column.empty())
  {
    text += text.empty() ? "" : ": ";
    text += "column '" + shown_path(where.column) + "'";
  }
  return text;
}

Error::Error(const std::string& text, Where where)
  : std::runtime_error(message(text, where))
  , text_(shown_path(text))
  , where_(std::move(where))
{
}

IoError::IoError(const std::string& text, Where where, std::errc code)
  : Error(text, std::move(where))
  , code_(code)
{
}

std::string to_string(const Notice& notice)
{
  return message(notice.text, notice.where);
}
}
