// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/restart_bytes.h"

#include <algorithm>
#include <limits>

namespace granular
{
namespace
{
constexpr std::size_t first_read = 4096;
constexpr std::size_t most_read = std::size_t{ 1 } << 17;

bool printable(char byte) noexcept
{
  const auto code = static_cast<unsigned char>(byte);
  return code >= 32 && code != 127;
}
}

RestartBytes::RestartBytes(const ByteSource& source, bool swapped, SearchBudget* budget)
  : source_(source)
  , size_(source.compressed() ? std::numeric_limits<std::int64_t>::max() : source.stamp().size)
  , swapped_(swapped)
  , budget_(budget)
{
}

void RestartBytes::refuse(
  const std::string& expected, const std::string& got, std::int64_t offset) const
{
  throw FormatError("expected " + expected + ", got " + got, { source_.path(), 0, offset });
}

std::int64_t RestartBytes::text_end(std::int64_t offset)
{
  const char* const count = this->find(offset, sizeof(std::int32_t));
  const std::int64_t bytes = count ? this->load<std::int32_t>(count) : 0;
  if (bytes < 2 || bytes > most_text)
  {
    return -1;
  }
  const std::int64_t begin = offset + 4;
  // not more than is looked at: most of what is tried dies with its first byte
  const char* text = this->find(begin, 1);
  if (!text || !printable(*text))
  {
    return -1;
  }
  text = this->find(begin, static_cast<std::size_t>(bytes));
  const bool right = text && std::all_of(text, text + bytes - 1, printable) && text[bytes - 1] == 0;
  return right ? begin + bytes : -1;
}

std::string RestartBytes::next_text(std::int64_t& at, std::string_view what)
{
  const auto count = this->number_at<std::int32_t>(at, what);
  const std::int64_t end = this->text_end(at);
  if (end < 0)
  {
    this->refuse(std::string(what) + ", a text of 1 to " + std::to_string(most_text - 1) +
        " printable bytes and a zero",
      count < 2 || count > most_text ? "a count of " + std::to_string(count) : "other bytes", at);
  }
  const auto bytes = static_cast<std::size_t>(count);
  const char* const text = this->find(end - count, bytes);
  at = end;
  return { text, bytes - 1 };
}

std::string_view RestartBytes::view(std::int64_t offset, std::size_t at_least)
{
  const auto left = static_cast<std::uint64_t>(std::max(std::int64_t{ 0 }, size_ - offset));
  if (offset < 0 || left == 0)
  {
    return {};
  }
  const std::size_t wanted = std::min<std::uint64_t>(left, at_least);
  const std::int64_t end = begin_ + static_cast<std::int64_t>(length_);
  if (offset < begin_ || offset > end || static_cast<std::size_t>(end - offset) < wanted)
  {
    this->move_to(offset, wanted);
  }
  const auto start = static_cast<std::size_t>(offset - begin_);
  return { window_.data() + start, length_ - start };
}

const char* RestartBytes::find(std::int64_t offset, std::size_t bytes)
{
  const std::string_view there = this->view(offset, bytes);
  return there.size() < bytes ? nullptr : there.data();
}

const char* RestartBytes::need(std::int64_t offset, std::size_t bytes, std::string_view what)
{
  const char* const there = this->find(offset, bytes);
  if (!there)
  {
    this->refuse(std::string(what), "the end of the file", offset);
  }
  return there;
}

void RestartBytes::move_to(std::int64_t offset, std::size_t at_least)
{
  const std::int64_t end = begin_ + static_cast<std::int64_t>(length_);
  const bool follows =
    length_ > 0 && offset >= begin_ && offset <= end + std::int64_t{ first_read };
  next_read_ = follows ? std::min(2 * next_read_, most_read) : first_read;
  // a file that grew meanwhile ends where it did
  const std::size_t bytes = std::min<std::uint64_t>(
    static_cast<std::uint64_t>(size_ - offset), std::max(next_read_, at_least));
  window_.resize(std::max(window_.size(), bytes));
  begin_ = offset;
  length_ = 0;
  length_ = source_.read(offset, window_.data(), bytes);
  if (budget_)
  {
    budget_->bytes -= static_cast<std::int64_t>(length_);
  }
}
}
