// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/numbered_name.h"

#include "granular/numbers/number_scan.h"

#include <algorithm>

namespace granular
{
NumberedName split_name(std::string_view path)
{
  for (const std::string_view suffix : { ".gz", ".zst" })
  {
    path = path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
  }
  const std::size_t start = path.rfind('/') + 1; // 0 without a slash
  NumberedName name = { std::string(path.substr(0, start)), {} };
  for (const char *at = path.data() + start, *end = path.data() + path.size(); at < end;)
  {
    const char* const last = std::find_if_not(at, end, is_digit);
    if (last == at)
    {
      name.rest += *at++;
      continue;
    }
    at = std::find_if(at, last - 1, [](char c) { return c != '0'; });
    name.rest += '*';
    name.numbers.push_back({ std::string(at, last) });
    at = last;
  }
  return name;
}

std::map<std::string, Family> families_of(const std::vector<FileIndex>& files)
{
  std::map<std::string, Family> families;
  for (std::uint32_t i = 0; i < files.size(); ++i)
  {
    NumberedName name = split_name(files[i].path);
    families[name.rest][i] = std::move(name.numbers);
  }
  return families;
}

Siblings group_by_others(const Family& family, std::size_t at)
{
  Siblings groups;
  for (const auto& [file, numbers] : family)
  {
    std::vector<NameNumber> others = numbers;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    groups[others][numbers[at]] = file; // of equal numbers the last file
  }
  return groups;
}
}
