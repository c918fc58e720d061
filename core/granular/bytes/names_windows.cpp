// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/names_windows.h"

#include "granular/bytes/find_files.h"
#include "granular/bytes/system_calls.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include <windows.h>

namespace granular
{
std::string with_slashes(const std::string& name)
{
  std::string plain = name;
  std::ranges::replace(plain, '\\', '/');
  return plain;
}

namespace os
{
namespace
{
/// The text in UTF-16; empty: it is not UTF-8.
std::wstring wide(const std::string& text)
{
  const int size = static_cast<int>(text.size());
  std::wstring wide(text.size(), L'\0'); // never longer
  wide.resize(static_cast<std::size_t>(
    ::MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text.data(), size, wide.data(), size)));
  return wide;
}

/// The name with all its folders, and with backslashes; empty: there is no such name.
std::wstring full_name(const std::string& name)
{
  const std::wstring given = wide(name);
  if (given.empty() || given.find(L'\0') != given.npos)
  {
    return {};
  }
  std::wstring full(::GetFullPathNameW(given.c_str(), 0, nullptr, nullptr), L'\0');
  full.resize(
    ::GetFullPathNameW(given.c_str(), static_cast<DWORD>(full.size()), full.data(), nullptr));
  return full;
}

/// Calls see(name) for what there is of a pattern in the last part of a path. Returns -1 if the folder cannot be listed.
template <class See>
int find_names(const std::string& pattern, const See& see)
{
  WIN32_FIND_DATAW found;
  const HANDLE search = ::FindFirstFileW(system_name(pattern).c_str(), &found);
  if (search == INVALID_HANDLE_VALUE)
  {
    return fail();
  }
  do
  {
    see(narrow(found.cFileName));
  } while (::FindNextFileW(search, &found));
  ::FindClose(search);
  return 0;
}
}

int fail() noexcept
{
  const std::error_code code(static_cast<int>(::GetLastError()), std::system_category());
  const std::error_condition condition = code.default_error_condition();
  errno = condition.category() == std::generic_category() ? condition.value() : EIO;
  errno = code.value() == ERROR_SHARING_VIOLATION ? EACCES : errno;
  return -1;
}

std::string narrow(std::wstring_view text)
{
  const int size = static_cast<int>(text.size());
  std::string narrow(3 * text.size(), '\0'); // never longer
  narrow.resize(static_cast<std::size_t>(::WideCharToMultiByte(CP_UTF8, 0, text.data(), size,
    narrow.data(), static_cast<int>(narrow.size()), nullptr, nullptr)));
  std::ranges::replace(narrow, '\\', '/');
  return narrow;
}

std::wstring system_name(const std::string& name) noexcept
try
{
  constexpr std::size_t longest = 240; // a folder's
  const std::wstring full = full_name(name);
  return full.size() < longest || full.starts_with(L"\\\\?\\") ? full
    : full.starts_with(L"\\\\")                                ? L"\\\\?\\UNC" + full.substr(1)
                                                               : L"\\\\?\\" + full;
}
catch (const std::bad_alloc&)
{
  return {};
}

void remove_all(const std::string& folder, const std::string& begin) noexcept
try
{
  find_names(folder + "/" + begin + "*",
    [&](const std::string& name)
    {
      std::error_code ignored;
      std::filesystem::remove_all(system_name(folder + "/" + name), ignored);
    });
}
catch (const std::bad_alloc&)
{
  // small files stay
}

int list(const std::string& folder)
{
  return find_names(folder + "/*", [](const std::string&) {});
}

std::vector<std::string> glob(const std::string& pattern)
{
  std::vector<std::string> found{ "" };
  for (std::size_t begin = 0; begin < pattern.size();)
  {
    const std::size_t slash = std::min(pattern.find('/', begin), pattern.size() - 1);
    const std::string part = pattern.substr(begin, slash + 1 - begin);
    begin = slash + 1;
    const bool is_plain = part.find_first_of("*?[") == part.npos;
    const std::string end = part.ends_with('/') ? "/" : "";
    std::string fitting; // as of has_numbers, where % is what * is to a shell
    for (const char c : part.substr(0, part.size() - end.size()))
    {
      fitting += c == '*' ? "%" : c == '%' ? "[%]" : std::string(1, c);
    }
    std::vector<std::string> next;
    for (const std::string& folder : found)
    {
      if (is_plain)
      {
        next.push_back(folder + part);
        continue;
      }
      find_names(folder + "*",
        [&](const std::string& name)
        {
          if ((name[0] != '.' || part[0] == '.') && has_numbers(name, fitting))
          {
            next.push_back(folder + name + end);
          }
        });
    }
    found = std::move(next);
  }
  return found;
}

std::string absolute(const std::string& name)
{
  return narrow(full_name(name));
}

}
}
