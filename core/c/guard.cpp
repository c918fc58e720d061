// SPDX-License-Identifier: BSD-3-Clause
#include "guard.h"

#include <utility>

namespace granular_c
{
namespace
{
/// The last error of a thread, which its strings are pointers into.
struct LastError
{
  std::string message, text, path, column;
  granular_error error = { GRANULAR_OK, "", "", "", 0, -1, "", 0 };

  granular_status set(granular_status status, std::string whole, const std::string& words,
    const granular::Where& where, int system_error = 0) noexcept
  try
  {
    message = std::move(whole);
    text = words;
    path = where.path;
    column = where.column;
    error = { status, message.c_str(), text.c_str(), path.c_str(), where.line, where.byte,
      column.c_str(), system_error };
    return status;
  }
  catch (const std::exception&)
  {
    error = { status, "out of memory", "out of memory", "", 0, -1, "", 0 };
    return status;
  }
};

thread_local LastError last_error;

template <class Known>
bool is(const granular::Error& error) noexcept
{
  return dynamic_cast<const Known*>(&error) != nullptr;
}

granular_status status_of(const granular::Error& error) noexcept
{
  return is<granular::IoError>(error)  ? GRANULAR_IO_ERROR
    : is<granular::FormatError>(error) ? GRANULAR_FORMAT_ERROR
    : is<granular::LimitError>(error)  ? GRANULAR_LIMIT_ERROR
    : is<granular::UnsupportedError>(error)
    ? GRANULAR_UNSUPPORTED
    : GRANULAR_BAD_ARGUMENT; // a choice, a format, a column or a frame
}
}

granular_status keep_error(const granular::Error& error) noexcept
{
  try
  {
    const auto* const refused = dynamic_cast<const granular::IoError*>(&error);
    return last_error.set(status_of(error), error.what(), error.text(), error.where(),
      refused == nullptr ? 0 : static_cast<int>(refused->code()));
  }
  catch (const std::bad_alloc&)
  {
    return keep_error(GRANULAR_NO_MEMORY, "out of memory");
  }
}

granular_status keep_error(granular_status status, const char* text) noexcept
{
  return last_error.set(status, text, text, {});
}
}

extern "C"
{
  const granular_error* granular_last_error(void)
  {
    return &granular_c::last_error.error;
  }

  const char* granular_version(void)
  {
    return GRANULAR_VERSION;
  }
}
