// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/formats/unnamed_columns.h"

#include "granular/common/words.h"

#include <string_view>

namespace granular
{
namespace
{
constexpr std::string_view scaled_atom = "id type xs ys zs ix iy iz";
constexpr std::string_view absolute_atom = "id type x y z ix iy iz";
}

bool is_atom(std::size_t columns) noexcept
{
  return columns == 5 || columns == 8;
}

UnnamedColumns name_columns(
  std::size_t columns, const std::vector<std::string>& of_user, AtomFit fit)
{
  if (!of_user.empty())
  {
    return { of_user };
  }
  const bool guessed = is_atom(columns);
  const bool named = guessed && fit.scaled != fit.absolute;
  const std::vector<std::string_view> atom = split_words(fit.scaled ? scaled_atom : absolute_atom);
  UnnamedColumns found = { {}, named, guessed };
  for (std::size_t i = 0; i < columns; ++i)
  {
    found.names.push_back(named ? std::string(atom[i]) : "column" + std::to_string(i + 1));
  }
  return found;
}
}
