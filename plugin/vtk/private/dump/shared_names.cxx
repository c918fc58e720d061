// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/shared_names.h"

#include "granular/common/pass.h"
#include "granular/common/words.h"
#include "granular/parallel/gather.h"

#include <algorithm>
#include <string_view>

namespace vtkGranularPrivate
{
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<KnownArrays>& known)
{
  archive.number(known.HasParticles);
  granular::pass(archive, known.Names);
  granular::pass(archive, known.Sizes);
}

KnownArrays ShareArrays(const granular::FrameView& particles, granular::Communicator& ranks)
{
  KnownArrays own{ particles.rows > 0, {}, {} };
  for (const granular::ArrayView& array : particles.arrays)
  {
    if (array.type != granular::ValueType::Text && array.name != "id")
    {
      own.Names.push_back(array.name);
      own.Sizes.push_back(array.size());
    }
  }
  const std::vector<KnownArrays> all = granular::gather(ranks, own);
  const auto best = std::ranges::find_if(all, &KnownArrays::HasParticles);
  return best == all.end() ? all.back() : *best;
}

std::vector<std::string> NamesIn(std::string list, const std::vector<std::string>& all)
{
  std::ranges::replace(list, ',', ' ');
  std::vector<std::string> names;
  for (const std::string_view word : granular::split_words(list))
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

std::vector<std::string> ShareNames(
  const std::string& list, const granular::FrameView& particles, granular::Communicator& ranks)
{
  return NamesIn(list, ShareArrays(particles, ranks).Names);
}
}
