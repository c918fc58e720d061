// SPDX-License-Identifier: BSD-3-Clause
// Lines of a hundred thousand columns: what takes time in proportion to the square of their number does not end before
// a test is stopped.
#ifndef granular_tests_support_many_columns_h
#define granular_tests_support_many_columns_h

#include <string>

constexpr int many_columns = 100'000;

/// The words before them, if any, and then that of each number from 1.
template <class Word>
std::string line_of_many(std::string line, const Word& word)
{
  for (int i = 1; i <= many_columns; ++i)
  {
    line += line.empty() ? "" : " ";
    line += word(i);
  }
  return line;
}

/// The same by a form of words: '#' stands for the number.
inline std::string line_of_many(const std::string& line, const char* form)
{
  const std::string text = form;
  const std::size_t at = text.find('#');
  return line_of_many(line,
    [&](int i) {
      return at == text.npos ? text : text.substr(0, at) + std::to_string(i) + text.substr(at + 1);
    });
}

#endif
