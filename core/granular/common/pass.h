// SPDX-License-Identifier: BSD-3-Clause
// pass(archive, thing): one description of the parts of a thing for writing them to an archive and for reading them back.
#ifndef granular_common_pass_h
#define granular_common_pass_h

#include "granular/common/archive.h"
#include "granular/common/error.h"

#include <string>
#include <type_traits>
#include <vector>

namespace granular
{
template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<Where>& where)
{
  archive.text(where.path);
  archive.number(where.line);
  archive.number(where.byte);
  archive.text(where.column);
}

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<Notice>& notice)
{
  pass(archive, notice.where);
  archive.text(notice.text);
  archive.text(notice.topic);
}

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<std::string>& text)
{
  archive.text(text);
}

/// Passes one of many items: plain numbers as in memory, others by pass().
template <typename Archive, typename Thing>
void pass_item(Archive& archive, Thing& thing)
{
  if constexpr (std::is_trivially_copyable_v<Thing>)
  {
    archive.number(thing);
  }
  else
  {
    pass(archive, thing);
  }
}

template <typename Thing>
void pass(ArchiveWriter& archive, const std::vector<Thing>& things)
{
  archive.list(things, [&](const Thing& thing) { pass_item(archive, thing); });
}

template <typename Thing>
void pass(ArchiveReader& archive, std::vector<Thing>& things)
{
  archive.list(things, [&](Thing& thing) { pass_item(archive, thing); });
}
}
#endif
