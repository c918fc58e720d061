// SPDX-License-Identifier: BSD-3-Clause
// Numbers of legacy VTK files: text is passed over by counting where words begin, and parsed word by word.
#include "granular/formats/vtk_files/legacy_vtk.h"

#include "granular/common/words.h"
#include "granular/formats/vtk_files/vtk_values.h"
#include "granular/numbers/number_scan.h"

#include <algorithm>

namespace granular
{
namespace
{
/// Words of a block of text.
struct Words
{
  std::int64_t starts = 0;
  std::int64_t odd = 0; ///< that begin with other than a digit, a sign or a point
  std::int64_t feeds = 0;
};

constexpr std::ptrdiff_t block_bytes = 4096; // sums of a block fit 16 bits

constexpr bool is_odd(char c) noexcept
{
  return static_cast<std::uint8_t>(c - '+') > '9' - '+';
}

/// Counts the words that begin in a block. The byte before it is there.
Words count_words(const char* first, const char* last) noexcept
{
  std::uint16_t starts = 0;
  std::uint16_t odd = 0;
  std::uint16_t feeds = 0;
  for (; first != last; ++first)
  {
    // no branches: several bytes at a time
    const int start = int{ !is_blank(first[0]) } & int{ is_blank(first[-1]) };
    starts = static_cast<std::uint16_t>(starts + start);
    odd = static_cast<std::uint16_t>(odd + (start & int{ is_odd(first[0]) }));
    feeds = static_cast<std::uint16_t>(feeds + int{ first[0] == '\n' });
  }
  return { starts, odd, feeds };
}
}

template <class T>
void LegacyVtk::read(const VtkArray& array, std::vector<T>& numbers)
{
  constexpr std::int64_t step = std::int64_t{ 1 } << 16; // a multiple of 8: whole bytes of bits
  if (!is_number(array.type))
  {
    this->fail("numbers", line_text_);
  }
  components_ = array.components;
  const std::int64_t count = array.size();
  this->check_claim(array);
  numbers.clear();
  if (end_ != no_end)
  {
    numbers.reserve(static_cast<std::size_t>(count));
  }
  for (std::int64_t done = 0; done < count;)
  {
    const std::int64_t next = std::min(done + step, count);
    numbers.resize(static_cast<std::size_t>(next));
    if (binary_)
    {
      this->read_binary(array.type, numbers.data(), done, next, count);
    }
    else
    {
      this->read_text(numbers.data(), done, next, count);
    }
    done = next;
  }
  line_is_open_ = !binary_ && count > 0;
}

/// Holds a claim against the bytes that are there, as far as their number is known.
void LegacyVtk::check_claim(const VtkArray& array)
{
  const std::int64_t count = array.size();
  const std::int64_t left = end_ - this->offset();
  const std::int64_t bytes = bytes_of(array.type);
  const std::int64_t most = !binary_ ? left / 2 + 1 : bytes > 0 ? left / bytes : left;
  if (end_ != no_end && count > most && (!binary_ || bytes > 0 || count / 8 > left))
  {
    this->fail_end(std::to_string(count) + " numbers");
  }
}

/// The text up to the last blank in the window: its words are whole, and there is at least one blank.
std::string_view LegacyVtk::whole_words(std::int64_t done, std::int64_t count)
{
  for (;;)
  {
    const std::string_view text = this->text();
    const auto blank = std::find_if(text.rbegin(), text.rend(), is_blank);
    if (blank != text.rend())
    {
      return text.substr(0, static_cast<std::size_t>(text.rend() - blank));
    }
    if (text.size() == window_.size())
    {
      this->fail_number(done, count, "a number");
    }
    if (!this->more())
    {
      this->fail_count(done, count);
    }
  }
}

void LegacyVtk::fail_count(std::int64_t done, std::int64_t count)
{
  ended_ = true;
  throw FormatError("expected " + std::to_string(count) + " numbers, got " + std::to_string(done) +
      " and the end of the file",
    this->where(this->place()));
}

/// Says that the word that is next is no number.
void LegacyVtk::fail_number(std::int64_t done, std::int64_t count, const char* kind)
{
  std::string_view text = this->text();
  line_place_ = this->place();
  this->fail(
    std::string(kind) + " (" + std::to_string(done + 1) + " of " + std::to_string(count) + ")",
    take_word(text));
}

template <class T>
void LegacyVtk::read_text(T* numbers, std::int64_t first, std::int64_t last, std::int64_t count)
{
  std::int64_t done = first;
  while (done < last)
  {
    const std::string_view text = this->whole_words(done, count);
    const char* const end = text.data() + text.size();
    const char* at = text.data();
    std::int64_t feeds = 0;
    while (done < last)
    {
      for (; at != end && is_blank(*at); ++at)
      {
        feeds += *at == '\n' ? 1 : 0;
      }
      if (at == end)
      {
        break;
      }
      const char* word_end = scan_number(at, end, numbers[done]);
      if (!word_end || !is_blank(*word_end))
      {
        word_end = std::find_if(at, end, is_blank);
        if (!parse_word({ at, word_end }, numbers[done]))
        {
          this->pass(static_cast<std::size_t>(at - text.data()));
          line_ += line_ > 0 ? feeds : 0;
          this->fail_number(done, count, kind_of_word<T>);
        }
      }
      at = word_end;
      ++done;
    }
    this->pass(static_cast<std::size_t>(at - text.data()));
    line_ += line_ > 0 ? feeds : 0;
  }
}

template <class T>
void LegacyVtk::read_binary(
  ValueType type, T* numbers, std::int64_t first, std::int64_t last, std::int64_t count)
{
  const bool bits = type == ValueType::Bit;
  const auto bytes = static_cast<std::size_t>(bits ? 1 : bytes_of(type));
  std::int64_t done = first;
  while (done < last)
  {
    if (this->text().size() < bytes && !this->more())
    {
      this->fail_count(done, count);
    }
    const auto there = static_cast<std::int64_t>(this->text().size() / bytes) * (bits ? 8 : 1);
    const std::int64_t next = std::min(last, done + there);
    const std::int64_t good = load_numbers(type, this->text().data(), next - done, numbers + done);
    this->pass(static_cast<std::size_t>(bits ? (good + 7) / 8 : good * bytes_of(type)));
    done += good;
    if (done < next)
    {
      throw FormatError(std::string("expected ") + kind_of_word<T> + " of 64 bits (" +
          std::to_string(done + 1) + " of " + std::to_string(count) + "), got another",
        this->where(this->place()));
    }
  }
}

template void LegacyVtk::read(const VtkArray&, std::vector<double>&);
template void LegacyVtk::read(const VtkArray&, std::vector<std::int64_t>&);

void LegacyVtk::skip(const VtkArray& array)
{
  components_ = array.components;
  const std::int64_t count = array.size();
  if (!is_number(array.type))
  {
    // a variant is a line of its type and its value, also in binary files
    if (binary_ && array.type == ValueType::Text)
    {
      this->skip_strings(count);
    }
    else
    {
      this->skip_lines(count);
    }
    return;
  }
  this->check_claim(array);
  if (binary_)
  {
    const std::int64_t bytes = bytes_of(array.type);
    const bool fits = bytes == 0 || count <= (no_end - this->offset()) / bytes;
    this->skip_bytes(bytes == 0 ? count / 8 + (count % 8 != 0)
        : fits                  ? count * bytes
                                : no_end - this->offset(),
      count);
  }
  else
  {
    this->skip_text(count);
  }
  line_is_open_ = !binary_ && count > 0;
}

/// Passes over bytes, which must be there.
void LegacyVtk::skip_bytes(std::int64_t bytes, std::int64_t count)
{
  if (bytes > static_cast<std::int64_t>(this->text().size()))
  {
    this->go_to({ this->offset() + bytes - 1, line_ });
    bytes = 1;
    if (!this->more())
    {
      this->fail_end(std::to_string(count) + " numbers");
    }
  }
  this->pass(static_cast<std::size_t>(bytes));
}

void LegacyVtk::skip_text(std::int64_t count)
{
  std::int64_t done = 0;
  while (done < count)
  {
    const std::string_view text = this->whole_words(done, count);
    const char* const end = text.data() + text.size();
    const char* at = text.data();
    while (at != end && done < count)
    {
      const char* const last = at + std::min(block_bytes, end - at);
      const Words words = count_words(at, last);
      if (words.odd > 0 || words.starts >= count - done)
      {
        at = this->skip_words(at, last, end, done, count);
      }
      else
      {
        done += words.starts;
        line_ += line_ > 0 ? words.feeds : 0;
        at = last;
      }
    }
    this->pass(static_cast<std::size_t>(at - text.data()));
  }
}

/// Passes one by one over the words that begin in [at, last). Returns where that ended.
const char* LegacyVtk::skip_words(
  const char* at, const char* last, const char* end, std::int64_t& done, std::int64_t count)
{
  while (at < last && done < count)
  {
    if (is_blank(*at))
    {
      line_ += *at == '\n' && line_ > 0 ? 1 : 0;
      ++at;
      continue;
    }
    const char* const word_end = std::find_if(at, end, is_blank);
    if (is_blank(at[-1])) // else it is the rest of a word that was counted
    {
      double number = 0;
      if (is_odd(*at) && !parse_word({ at, word_end }, number))
      {
        this->pass(static_cast<std::size_t>(at - this->text().data()));
        this->fail_number(done, count, kind_of_word<double>);
      }
      ++done;
    }
    at = word_end;
  }
  return at;
}
}
