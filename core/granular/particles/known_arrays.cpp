// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/known_arrays.h"

#include "granular/common/pass.h"
#include "granular/common/words.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <string_view>

namespace granular
{
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<KnownArrays>& known)
{
  archive.number(known.has_particles);
  granular::pass(archive, known.names);
  granular::pass(archive, known.sizes);
}

KnownArrays share_arrays(const FrameView& particles, Communicator& ranks)
{
  KnownArrays own{ particles.rows > 0, {}, {} };
  for (const ArrayView& array : particles.arrays)
  {
    if (array.type != ValueType::Text && array.name != "id")
    {
      own.names.push_back(array.name);
      own.sizes.push_back(array.size());
    }
  }
  const std::vector<KnownArrays> all = gather(ranks, own);
  const auto best = std::ranges::find_if(all, &KnownArrays::has_particles);
  return best == all.end() ? all.back() : *best;
}

std::vector<std::string> names_in(std::string list, const std::vector<std::string>& all)
{
  std::ranges::replace(list, ',', ' ');
  std::vector<std::string> names;
  for (const std::string_view word : split_words(list))
  {
    if (word == "*")
    {
      names.insert(names.end(), all.begin(), all.end());
    }
    else
    {
      names.emplace_back(word);
    }
  }
  return names;
}

std::vector<std::string> share_names(
  const std::string& list, const FrameView& particles, Communicator& ranks)
{
  return names_in(list, share_arrays(particles, ranks).names);
}
}
