// SPDX-License-Identifier: BSD-3-Clause
// Lines of as many words as a frame may have columns.
#ifndef granular_tests_support_many_columns_h
#define granular_tests_support_many_columns_h

#include "granular/common/words.h"

#include <string>

constexpr int many_columns = 5000;

/// The words before them, and then those of a form, in which '#' stands for the number from 1, until there are so many.
inline std::string line_of_many(std::string line, const std::string& form, int count = many_columns)
{
  const std::size_t at = form.find('#');
  const int before = static_cast<int>(granular::split_words(line).size());
  for (int i = 1; i <= count - before; ++i)
  {
    line += line.empty() ? "" : " ";
    line += at == form.npos ? form : form.substr(0, at) + std::to_string(i) + form.substr(at + 1);
  }
  return line;
}

#endif
