// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/shared_names.h"

#include "granular/common/pass.h"
#include "granular/common/words.h"
#include "granular/parallel/gather.h"

#include <algorithm>
#include <string_view>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The names that a rank knows, which may have blanks.
 */
struct KnownNames
{
  bool HasParticles = false;
  std::vector<std::string> Names;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<KnownNames>& known)
{
  archive.number(known.HasParticles);
  granular::pass(archive, known.Names);
}

std::vector<std::string> NumericArrays(const granular::FrameView& particles)
{
  std::vector<std::string> names;
  for (const granular::ArrayView& array : particles.arrays)
  {
    if (array.type != granular::ValueType::Text && array.name != "id")
    {
      names.push_back(array.name);
    }
  }
  return names;
}
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
  const std::vector<KnownNames> all = granular::gather(
    ranks, KnownNames{ particles.rows > 0, NamesIn(list, NumericArrays(particles)) });
  const auto best = std::ranges::find_if(all, &KnownNames::HasParticles);
  return best == all.end() ? all.back().Names : best->Names;
}
}
