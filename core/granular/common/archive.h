// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_archive_h
#define granular_common_archive_h

#include "granular/common/error.h"

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Writes the parts of a thing one behind the other, for a process of the same program. It and Unpacker have
/// the same functions, so that one description of a thing, pass(archive, thing), does for both.
struct Packer
{
  std::string bytes = {};

  template <class Value>
  void number(Value& value)
  {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  void text(std::string& value)
  {
    const std::size_t size = value.size();
    this->number(size);
    bytes += value;
  }
};

/// Takes them apart again. The bytes are what a Packer made: they are not checked.
struct Unpacker
{
  std::string_view bytes;

  template <class Value>
  void number(Value& value)
  {
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
  }

  void text(std::string& value)
  {
    std::size_t size = 0;
    this->number(size);
    value = bytes.substr(0, size);
    bytes.remove_prefix(size);
  }
};

template <class Archive>
void pass(Archive& archive, Where& where)
{
  archive.text(where.path);
  archive.number(where.line);
  archive.number(where.byte);
  archive.text(where.column);
}

template <class Archive>
void pass(Archive& archive, Notice& notice)
{
  pass(archive, notice.where);
  archive.text(notice.text);
  archive.text(notice.topic);
}

template <class Archive>
void pass(Archive& archive, std::string& text)
{
  archive.text(text);
}

/// A list of things that pass() knows.
template <class Archive, class Thing>
void pass(Archive& archive, std::vector<Thing>& things)
{
  std::size_t count = things.size();
  archive.number(count);
  things.resize(count);
  for (Thing& thing : things)
  {
    pass(archive, thing);
  }
}
}
#endif
