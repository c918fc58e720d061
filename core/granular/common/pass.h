// SPDX-License-Identifier: BSD-3-Clause
// pass(archive, thing): one description of the parts of a thing for writing them to an archive and for reading them back.
#ifndef granular_common_pass_h
#define granular_common_pass_h

#include "granular/common/archive.h"
#include "granular/common/error.h"

#include <string>
#include <vector>

namespace granular
{
template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<Where>& where)
{
  archive.path(where.path);
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

/// Passes a list of things that pass() knows.
template <typename Thing>
void pass(ArchiveWriter& archive, const std::vector<Thing>& things)
{
  archive.list(things, [&](const Thing& thing) { pass(archive, thing); });
}

template <typename Thing>
void pass(ArchiveReader& archive, std::vector<Thing>& things)
{
  archive.list(things, [&](Thing& thing) { pass(archive, thing); });
}
}
#endif
