// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/find_files.h"

#include "granular/bytes/system_calls.h"

#include <algorithm>
#include <set>
#include <system_error>

namespace granular
{
namespace
{
bool is_digit(char c) noexcept
{
  return c >= '0' && c <= '9';
}

std::size_t skip_digits(std::string_view text, std::size_t at) noexcept
{
  while (at < text.size() && is_digit(text[at]))
  {
    ++at;
  }
  return at;
}

/// Compares numbers by value, and words as they are; a word comes before a number.
bool is_before(std::string_view a, std::string_view b) noexcept
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (!is_digit(a[i]) || !is_digit(b[j]))
    {
      if (a[i] != b[j])
      {
        return is_digit(a[i]) == is_digit(b[j]) ? a[i] < b[j] : is_digit(b[j]);
      }
      ++i;
      ++j;
      continue;
    }
    const std::size_t end_a = skip_digits(a, i);
    const std::size_t end_b = skip_digits(b, j);
    std::string_view first = a.substr(i, end_a - i);
    std::string_view second = b.substr(j, end_b - j);
    first.remove_prefix(std::min(first.find_first_not_of('0'), first.size()));
    second.remove_prefix(std::min(second.find_first_not_of('0'), second.size()));
    if (first != second)
    {
      return first.size() != second.size() ? first.size() < second.size() : first < second;
    }
    i = end_a;
    j = end_b;
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

/// The length of the set `[...]` at the start of a pattern; 0 if it is none.
std::size_t set_length(std::string_view pattern) noexcept
{
  if (pattern.empty() || pattern[0] != '[')
  {
    return 0;
  }
  const std::size_t negation = pattern.size() > 1 && pattern[1] == '!' ? 1 : 0;
  // a bracket that comes first is a member of the set
  const std::size_t end = pattern.find(']', 2 + negation);
  return end == std::string_view::npos ? 0 : end + 1;
}

bool is_in_set(std::string_view set, char c) noexcept
{
  set = set.substr(1, set.size() - 2);
  const bool negated = set[0] == '!';
  set.remove_prefix(negated ? 1 : 0);
  bool found = false;
  for (std::size_t i = 0; i < set.size(); ++i)
  {
    const bool range = i + 2 < set.size() && set[i + 1] == '-';
    found = found || (range ? set[i] <= c && c <= set[i + 2] : set[i] == c);
    i += range ? 2 : 0;
  }
  return found != negated;
}

/// Returns true if a path is one of this kind, perhaps behind links.
bool is_kind(const std::string& path, os::Kind kind) noexcept
{
  os::Status status;
  return os::status_of(path, status, true) == 0 && status.kind == kind;
}

/// Other files that lie beside those of a run.
bool is_beside(std::string_view name) noexcept
{
  return name.find("boundingBox") != std::string_view::npos;
}

std::string last_part(const std::string& path)
{
  return path.substr(path.rfind('/') + 1);
}

/// The folders that a pattern begins with, as far as they are there under these names, with a slash at the end.
std::string_view folders_of(std::string_view pattern)
{
  while (!pattern.empty() &&
    !(pattern.ends_with('/') && is_kind(std::string(pattern), os::Kind::Folder)))
  {
    pattern.remove_suffix(1);
  }
  return pattern;
}

/// Returns true if a name holds a sign that stands for something else, behind the folders that are there.
bool is_pattern(std::string_view name)
{
  name.remove_prefix(folders_of(name).size());
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    if (name[i] == '*' || name[i] == '?' || name[i] == '%' || set_length(name.substr(i)) > 0)
    {
      return true;
    }
  }
  return false;
}

/// The pattern of the shell that a pattern means. Signs in names of folders that there are stand for themselves.
std::string shell_pattern(const std::string& pattern)
{
  const std::string_view folders = folders_of(pattern);
  std::string shell;
  for (const char c : folders)
  {
    const bool is_sign = c == '*' || c == '?' || c == '[';
    shell += is_sign ? std::string{ '[', c, ']' } : std::string(1, c);
  }
  std::string rest = pattern.substr(folders.size());
  std::ranges::replace(rest, '%', '*');
  return shell + rest;
}

[[noreturn]] void fail(const char* action, const std::string& path, int error)
{
  throw IoError(std::string("cannot ") + action + ": " + std::generic_category().message(error),
    { path }, static_cast<std::errc>(error));
}

/// Says why a pattern fits no file, or that the file of a plain name is not there.
[[noreturn]] void refuse(const std::string& pattern)
{
  os::Status status;
  if (os::status_of(pattern, status) == 0)
  {
    if (os::status_of(pattern, status, true) != 0)
    {
      fail("open", pattern, errno); // a link
    }
    refuse_no_file(pattern, status.kind == os::Kind::Folder);
  }
  std::string folder(folders_of(pattern));
  folder = folder.empty() ? "." : folder;
  if (os::list(folder) != 0)
  {
    fail("list the folder", folder, errno);
  }
  throw IoError(is_pattern(pattern) ? "no file fits the pattern" : "no such file or folder",
    { pattern }, std::errc::no_such_file_or_directory);
}

/// Appends the files that a pattern of the shell fits.
void add_files(const std::string& pattern, std::vector<std::string>& names)
{
  for (const std::string& name : os::glob(pattern))
  {
    os::Status status;
    if (is_beside(last_part(name)))
    {
      continue;
    }
    if (os::status_of(name, status, true) == 0)
    {
      if (status.kind == os::Kind::File)
      {
        names.push_back(name);
      }
    }
    else if (errno != ENOENT && errno != ENOTDIR)
    {
      fail("open", name, errno);
    }
  }
}
}

bool has_numbers(std::string_view name, std::string_view pattern)
{
  if (pattern.empty())
  {
    return name.empty();
  }
  const char sign = pattern[0];
  if (sign == '*')
  {
    // all ends of a number that begins here
    const std::size_t whole = skip_digits(name, 0);
    const bool has_decimals =
      whole > 0 && whole + 1 < name.size() && name[whole] == '.' && is_digit(name[whole + 1]);
    const std::size_t most = has_decimals ? skip_digits(name, whole + 1) : whole;
    for (std::size_t end = most; end >= 1; --end)
    {
      if (is_digit(name[end - 1]) && has_numbers(name.substr(end), pattern.substr(1)))
      {
        return true;
      }
    }
    return false;
  }
  if (sign == '%')
  {
    for (std::size_t end = 0; end <= name.size(); ++end)
    {
      if (has_numbers(name.substr(end), pattern.substr(1)))
      {
        return true;
      }
    }
    return false;
  }
  if (name.empty())
  {
    return false;
  }
  const std::size_t set = set_length(pattern);
  const bool fits =
    set > 0 ? is_in_set(pattern.substr(0, set), name[0]) : sign == '?' || sign == name[0];
  return fits && has_numbers(name.substr(1), pattern.substr(std::max<std::size_t>(set, 1)));
}

bool is_there(const std::string& path)
{
  os::Status status;
  const bool found = os::status_of(path, status, true) == 0;
  if (!found && errno != ENOENT && errno != ENOTDIR && errno != ENAMETOOLONG)
  {
    fail("look for the file", path, errno);
  }
  return found;
}

std::vector<std::string> find_files(const std::vector<std::string>& patterns)
{
  std::set<std::string> all;
  for (const std::string& given : patterns)
  {
    const std::string pattern = with_slashes(given);
    if (is_kind(pattern, os::Kind::File)) // perhaps a name that happens to hold such signs
    {
      all.insert(os::absolute(pattern));
      continue;
    }
    std::vector<std::string> fitting;
    std::vector<std::string> numbered;
    for (const char* ending : { "", ".gz", ".zst" })
    {
      std::vector<std::string> names;
      add_files(shell_pattern(pattern + ending), names);
      for (const std::string& name : names)
      {
        fitting.push_back(name);
        if (has_numbers(last_part(name), last_part(pattern + ending)))
        {
          numbered.push_back(name);
        }
      }
    }
    if (fitting.empty())
    {
      refuse(pattern);
    }
    for (const std::string& name : numbered.empty() ? fitting : numbered)
    {
      all.insert(os::absolute(name));
    }
  }
  std::vector<std::string> sorted(all.begin(), all.end());
  std::ranges::sort(sorted, is_before);
  return sorted;
}
}
