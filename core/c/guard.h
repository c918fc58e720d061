// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular.h run in a guard that turns exceptions into a status and the last error of the thread.
#ifndef granular_c_guard_h
#define granular_c_guard_h

#include "frame.h"
#include "granular.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"

#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace granular_c
{
/// Keeps the error of this thread, and returns its status.
granular_status keep_error(const granular::Error& error) noexcept;
granular_status keep_error(granular_status status, const char* text) noexcept;

/// Runs the body of a function. Nothing is thrown, but a thread may end in a function of the caller.
template <class Body>
granular_status guarded(Body&& body)
{
  try
  {
    body();
    return GRANULAR_OK;
  }
  catch (const granular::Error& error)
  {
    return keep_error(error);
  }
  catch (const granular::Cancelled&)
  {
    return keep_error(GRANULAR_CANCELLED, "cancelled");
  }
  catch (const std::bad_alloc&)
  {
    return keep_error(GRANULAR_NO_MEMORY, "out of memory");
  }
  catch (const std::exception& error)
  {
    return keep_error(GRANULAR_OTHER_ERROR, error.what());
  }
  catch (...)
  {
    granular::caught_exception();
    return keep_error(GRANULAR_OTHER_ERROR, "unknown error");
  }
}

template <class Pointer>
Pointer& needed(Pointer* pointer, const char* name)
{
  if (pointer == nullptr)
  {
    throw granular::ArgumentError(std::string("expected ") + name + ", got null");
  }
  return *pointer;
}

/// The caller's struct, which may be of an earlier version and shorter, over the defaults.
template <class Struct>
Struct taken(const Struct* given, void (*init)(Struct*))
{
  Struct made;
  init(&made);
  if (given != nullptr)
  {
    if (given->size < sizeof(std::size_t) || given->size > sizeof(Struct))
    {
      throw granular::ArgumentError("expected a struct of up to " + std::to_string(sizeof(Struct)) +
        " bytes that its init function has filled, got size " + std::to_string(given->size));
    }
    std::memcpy(&made, given, given->size);
  }
  return made;
}

inline std::vector<std::string> texts_of(const char* const* texts, std::size_t count)
{
  std::vector<std::string> made;
  for (std::size_t i = 0; i < count; ++i)
  {
    made.emplace_back(&needed((&needed(texts, "names"))[i], "a name"));
  }
  if (made.empty())
  {
    throw granular::ArgumentError("expected at least one name, got none");
  }
  return made;
}
}
#endif
