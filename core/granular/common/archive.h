// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_archive_h
#define granular_common_archive_h

#include "granular/common/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace granular
{
/// Appends the parts of an object to bytes, for another rank. ArchiveReader has the same functions, so one
/// description of an object, pass(archive, thing), serves both. Numbers are as in memory.
class ArchiveWriter
{
public:
  /// The type of an object whose parts are passed.
  template <typename Thing>
  using Passed = const Thing;

  std::string bytes; ///< written so far

  template <typename T>
  void number(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  void count(std::size_t value) { this->number(std::uint64_t{ value }); }
  void flag(bool value) { bytes.push_back(value ? '\1' : '\0'); }

  void text(std::string_view value)
  {
    this->count(value.size());
    bytes.append(value);
  }

  template <typename Item, typename Each>
  void list(const std::vector<Item>& items, const Each& each)
  {
    this->count(items.size());
    std::for_each(items.begin(), items.end(), each);
  }

  /// Writes the content of an optional or a shared_ptr, if there is any.
  template <typename Holder, typename Each>
  void perhaps(const Holder& holder, const Each& each)
  {
    this->flag(static_cast<bool>(holder));
    if (holder)
    {
      each(*holder);
    }
  }
};

/// Throws FormatError unless the bytes of an archive are good.
inline void require(bool good, const char* expected)
{
  if (!good)
  {
    throw FormatError(std::string("expected ") + expected + ", got something else");
  }
}

/// Reads the bytes of an ArchiveWriter. Every function throws FormatError if the bytes do not hold the requested part; memory
/// is allocated only for bytes that are there.
class ArchiveReader
{
public:
  template <typename Thing>
  using Passed = Thing;

  explicit ArchiveReader(std::string_view bytes)
    : bytes_(bytes)
  {
  }

  template <typename T>
  void number(T& value)
  {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    std::memcpy(&value, this->take(sizeof value).data(), sizeof value);
  }

  /// Reads a number of items, each of at least so many bytes.
  std::size_t count(std::size_t bytes)
  {
    std::uint64_t value = 0;
    this->number(value);
    require(value <= bytes_.size() / bytes, "a number of things that are there");
    return static_cast<std::size_t>(value);
  }

  void flag(bool& value)
  {
    const char byte = this->take(1).front();
    value = byte != '\0';
    require(byte == (value ? '\1' : '\0'), "yes or no");
  }

  void text(std::string& value) { value = this->take(this->count(1)); }

  template <typename Item, typename Each>
  void list(std::vector<Item>& items, const Each& each)
  {
    items.clear();
    for (std::size_t left = this->count(1); left > 0; --left)
    {
      each(items.emplace_back());
    }
    items.shrink_to_fit();
  }

  template <typename Holder, typename Each>
  void perhaps(Holder& holder, const Each& each)
  {
    bool there = false;
    this->flag(there);
    if (there)
    {
      each(make(holder));
    }
  }

  bool ended() const noexcept { return bytes_.empty(); }

private:
  template <typename T>
  static T& make(std::optional<T>& holder)
  {
    return holder.emplace();
  }

  template <typename T>
  static T& make(std::shared_ptr<T>& holder)
  {
    return *(holder = std::make_shared<T>());
  }

  std::string_view take(std::size_t bytes)
  {
    require(bytes <= bytes_.size(), "more bytes");
    const std::string_view taken = bytes_.substr(0, bytes);
    bytes_.remove_prefix(bytes);
    return taken;
  }

  std::string_view bytes_; ///< not yet taken
};
}
#endif
