// SPDX-License-Identifier: BSD-3-Clause
// Values of arrays in VTK XML files. Binary ones have a header: their bytes; with compression how many blocks there are,
// the bytes of a block and those of a last one that is shorter (0: none is), then the compressed bytes of each. In
// base64 header and plain values are encoded together; a header of compressed ones on its own, and all blocks together.
#include "granular/bytes/compression.h"

#include "granular/common/words.h"
#include "granular/formats/vtk_files/vtk_values.h"
#include "granular/formats/vtk_files/vtk_xml.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace granular
{
namespace
{
constexpr std::string_view alphabet =
  "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> make_digits() noexcept
{
  std::array<std::uint8_t, 256> digits = {};
  digits.fill(no_digit);
  for (std::size_t i = 0; i < alphabet.size(); ++i)
  {
    digits[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return digits;
}

constexpr std::array<std::uint8_t, 256> digits = make_digits();

std::string number_of(std::int64_t number, std::int64_t count)
{
  return " (" + std::to_string(number + 1) + " of " + std::to_string(count) + ")";
}

/// Bytes as they stand in a file, or in base64.
class EncodedBytes
{
public:
  EncodedBytes(std::string_view text, bool base64, Where where)
    : text_(text)
    , base64_(base64)
    , where_(std::move(where))
  {
  }

  /// The bytes that come next. Throws FormatError if they do not.
  std::string look(std::uint64_t bytes) const
  {
    if (bytes <= text_.size()) // base64 has more characters than bytes
    {
      const auto count = static_cast<std::size_t>(bytes);
      auto found = base64_ ? decode_base64(text_, count) : std::string(text_.substr(0, count));
      if (found)
      {
        return *std::move(found);
      }
    }
    this->fail(
      std::to_string(bytes) + (base64_ ? " bytes in base64" : " bytes"), "others or fewer");
  }

  /// The same, and goes behind them; what comes then is encoded on its own.
  std::string take(std::uint64_t bytes)
  {
    std::string found = this->look(bytes);
    text_.remove_prefix(base64_ ? base64_chars(found.size()) : found.size());
    return found;
  }

  /// The most bytes that may be there.
  std::uint64_t most() const noexcept { return base64_ ? text_.size() / 4 * 3 : text_.size(); }

  [[noreturn]] void fail(const std::string& expected, const std::string& got) const
  {
    throw FormatError("expected " + expected + ", got " + got, where_);
  }

private:
  std::string_view text_;
  bool base64_;
  Where where_;
};

/// A number of a header.
std::uint64_t load_header(
  const std::string& header, std::size_t number, std::size_t bytes, bool big)
{
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
  {
    const std::size_t at = number * bytes + (big ? i : bytes - 1 - i);
    value = value << 8 | static_cast<unsigned char>(header[at]);
  }
  return value;
}

/// The header of compressed values.
struct Blocks
{
  std::uint64_t size = 0;
  std::uint64_t last_size = 0;
  std::vector<std::uint64_t> packed; ///< bytes of each

  std::uint64_t size_of(std::size_t block) const noexcept
  {
    return block + 1 == packed.size() && last_size > 0 ? last_size : size;
  }
};

Blocks take_blocks(EncodedBytes& from, std::uint64_t bytes, std::size_t word, bool big)
{
  constexpr std::size_t before = 3;
  constexpr std::uint64_t most_ratio = 1032; // of zlib
  const std::string head = from.look(before * word);
  const std::uint64_t count = load_header(head, 0, word, big);
  Blocks blocks = { load_header(head, 1, word, big), load_header(head, 2, word, big), {} };
  if (count > from.most() / word)
  {
    from.fail("bytes of " + std::to_string(count) + " compressed blocks", "fewer");
  }
  const std::string all = from.take((before + count) * word);
  blocks.packed.resize(static_cast<std::size_t>(count));
  std::uint64_t left = from.most();
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < blocks.packed.size(); ++i)
  {
    blocks.packed[i] = load_header(all, before + i, word, big);
    const std::uint64_t size = blocks.size_of(i);
    if (blocks.packed[i] > left || size / most_ratio > blocks.packed[i] || size > bytes - sum)
    {
      from.fail("blocks of " + std::to_string(bytes) + " bytes",
        "a block of " + std::to_string(size) + " in " + std::to_string(blocks.packed[i]));
    }
    left -= blocks.packed[i];
    sum += size;
  }
  if (sum != bytes)
  {
    from.fail("values of " + std::to_string(bytes) + " bytes", std::to_string(sum));
  }
  return blocks;
}

std::string unpack_blocks(EncodedBytes& from, const Blocks& blocks, std::uint64_t bytes)
{
  std::uint64_t sum = 0;
  for (const std::uint64_t packed : blocks.packed)
  {
    sum += packed;
  }
  const std::string all = from.take(sum);
  std::string_view rest = all;
  std::string values;
  values.reserve(static_cast<std::size_t>(bytes));
  for (std::size_t i = 0; i < blocks.packed.size(); ++i)
  {
    const auto packed = static_cast<std::size_t>(blocks.packed[i]);
    const auto size = static_cast<std::size_t>(blocks.size_of(i));
    values.resize(values.size() + size);
    if (!decompress_zlib(rest.substr(0, packed), { values.data() + values.size() - size, size }))
    {
      from.fail(std::to_string(size) + " bytes compressed with zlib in block " + std::to_string(i),
        "others");
    }
    rest.remove_prefix(packed);
  }
  return values;
}
}

template <class T>
void VtkXml::read(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const
{
  numbers.clear();
  const bool is_text = array.form == VtkXmlArray::Form::Ascii;
  is_text ? this->read_text(array, count, numbers) : this->read_binary(array, count, numbers);
}

template void VtkXml::read(const VtkXmlArray&, std::int64_t, std::vector<double>&) const;
template void VtkXml::read(const VtkXmlArray&, std::int64_t, std::vector<std::int64_t>&) const;

template <class T>
void VtkXml::read_text(const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const
{
  std::string_view rest = array.text;
  if (count > static_cast<std::int64_t>(rest.size() / 2 + 1))
  {
    throw FormatError("expected " + std::to_string(count) + " numbers, got " +
        std::to_string(rest.size()) + " bytes of text",
      this->where(array));
  }
  numbers.resize(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    const std::string_view word = take_word(rest);
    if (!parse_word(word, numbers[static_cast<std::size_t>(i)]))
    {
      throw FormatError(std::string("expected ") + kind_of_word<T> + number_of(i, count) +
          ", got " + (word.empty() ? "the end of the array" : quoted(word)),
        this->where_of(array, i));
    }
  }
  const std::string_view more = take_word(rest);
  if (!more.empty())
  {
    throw FormatError("expected the end of the array behind " + std::to_string(count) +
        " numbers, got " + quoted(more),
      this->where_of(array, count));
  }
}

template <class T>
void VtkXml::read_binary(
  const VtkXmlArray& array, std::int64_t count, std::vector<T>& numbers) const
{
  const std::int64_t size = bytes_of(array.type);
  if (count > std::numeric_limits<std::int64_t>::max() / size)
  {
    throw FormatError(
      "expected an array that fits memory, got " + std::to_string(count) + " numbers",
      this->where(array));
  }
  std::string bytes = this->bytes_of_array(array, count * size);
  for (std::int64_t i = 0; i < count * size && !big_endian_; i += size)
  {
    std::reverse(bytes.begin() + i, bytes.begin() + i + size);
  }
  numbers.resize(static_cast<std::size_t>(count));
  const std::int64_t good = load_numbers(array.type, bytes.data(), count, numbers.data());
  if (good < count)
  {
    throw FormatError(std::string("expected ") + kind_of_word<T> + " of 64 bits" +
        number_of(good, count) + ", got another",
      this->where(array));
  }
}

/// The values of a binary array, which must have so many bytes.
std::string VtkXml::bytes_of_array(const VtkXmlArray& array, std::int64_t bytes) const
{
  const bool appended = array.form == VtkXmlArray::Form::Appended;
  std::string_view text = array.text;
  const auto offset = static_cast<std::uint64_t>(array.offset);
  if (appended && offset > appended_.size())
  {
    throw FormatError("expected an offset up to " + std::to_string(appended_.size()) + ", got " +
        std::to_string(offset),
      this->where(array));
  }
  text = appended ? appended_.substr(static_cast<std::size_t>(offset)) : take_word(text);
  EncodedBytes from(text, !appended || appended_base64_, this->where(array));
  const auto wanted = static_cast<std::uint64_t>(bytes);
  if (compressed_)
  {
    return unpack_blocks(from, take_blocks(from, wanted, header_bytes_, big_endian_), wanted);
  }
  const std::uint64_t said = load_header(from.look(header_bytes_), 0, header_bytes_, big_endian_);
  if (said != wanted)
  {
    from.fail("values of " + std::to_string(wanted) + " bytes", std::to_string(said));
  }
  if (wanted > from.most())
  {
    from.fail("values of " + std::to_string(wanted) + " bytes", "fewer");
  }
  return from.take(header_bytes_ + wanted).substr(header_bytes_);
}

std::optional<std::string> decode_base64(std::string_view text, std::size_t bytes)
{
  // the first is checked before the second may be too large
  if (bytes / 3 > text.size() / 4 || base64_chars(bytes) > text.size())
  {
    return std::nullopt;
  }
  std::string decoded(bytes, '\0');
  for (std::size_t from = 0, to = 0; to < bytes; from += 4, to += 3)
  {
    const std::size_t wanted = std::min<std::size_t>(3, bytes - to);
    std::uint32_t all = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::uint8_t digit = digits[static_cast<unsigned char>(text[from + i])];
      const bool padding = i > wanted && text[from + i] == '=';
      if (digit == no_digit && !padding)
      {
        return std::nullopt;
      }
      all = all << 6 | (padding ? 0U : digit);
    }
    for (std::size_t i = 0; i < wanted; ++i)
    {
      decoded[to + i] = static_cast<char>(all >> (16 - 8 * i) & 0xff);
    }
  }
  return decoded;
}
}
