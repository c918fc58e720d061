// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/formats/unnamed_columns.h"

#include "granular/common/words.h"

#include <algorithm>
#include <string_view>

namespace granular
{
namespace
{
/// The columns of dump atom, scaled or not only the user knows: by default they are.
constexpr std::string_view columns_of_atom = "id type xs ys zs ix iy iz";
}

UnnamedColumns name_columns(std::size_t columns, const std::vector<std::string>& of_user)
{
  if (!of_user.empty())
  {
    return { of_user };
  }
  const std::vector<std::string_view> atom = split_words(columns_of_atom);
  const bool guessed = columns == 5 || columns == atom.size();
  UnnamedColumns found = { {}, guessed, guessed };
  for (std::size_t i = 0; i < columns; ++i)
  {
    found.names.push_back(guessed ? std::string(atom[i]) : "column" + std::to_string(i + 1));
  }
  return found;
}

bool is_named_so(const FrameKind& kind, const std::vector<std::string>& of_user)
{
  const UnnamedColumns columns = name_columns(kind.schema.columns().size(), of_user);
  return columns.named == kind.named && columns.guessed == kind.guessed &&
    std::ranges::equal(columns.names, kind.schema.columns(), {}, {}, &ColumnInfo::name);
}
}
