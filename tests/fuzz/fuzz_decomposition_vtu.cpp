// SPDX-License-Identifier: BSD-3-Clause
// A file of subdomains from memory, in VTK's XML format. The mutator changes the values of an array behind base64 and zlib, and
// their counts.
#include "decomposition_checks.h"
#include "mutations.h"

#include "granular/formats/vtk_files/vtk_xml.h"

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace granular;
using namespace granular::fuzz;

namespace
{
constexpr std::string_view letters =
  "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string encode_base64(const std::string& bytes)
{
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3)
  {
    std::uint32_t three = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      three = three << 8 | (at + i < bytes.size() ? static_cast<std::uint8_t>(bytes[at + i]) : 0u);
    }
    for (std::size_t i = 0; i < 4; ++i)
    {
      text += at + i <= bytes.size() ? letters[three >> (18 - 6 * i) & 63] : '=';
    }
  }
  return text;
}

/// All bytes behind base64, if it is that.
std::optional<std::string> decode_all(std::string_view text)
{
  const std::size_t letters_of = std::min(text.find('='), text.size());
  return decode_base64(text, letters_of * 3 / 4);
}

/// A part of a text.
struct Part
{
  std::size_t at = 0;
  std::size_t size = 0;
};

/// The longest runs of letters of base64.
std::vector<Part> find_encoded(const std::string& text)
{
  constexpr std::size_t least = 12; // more than most words of XML
  std::vector<Part> parts;
  const auto is_letter = [](char c) { return letters.find(c) != letters.npos || c == '='; };
  for (std::size_t at = 0; at < text.size();)
  {
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
    const auto size =
      static_cast<std::size_t>(std::find_if_not(begin, text.end(), is_letter) - begin);
    if (size >= least && size % 4 == 0)
    {
      parts.push_back({ at, size });
    }
    at += size + 1;
  }
  return parts;
}

/// How the file writes arrays.
struct Form
{
  explicit Form(const std::string& file)
    : swapped(file.find("BigEndian") != file.npos)
    , wide(file.find("header_type=\"UInt64\"") != file.npos)
    , compressed(file.find("vtkZLibDataCompressor") != file.npos)
  {
  }

  std::size_t width() const { return wide ? 8 : 4; }

  std::uint64_t number(const std::string& bytes, std::size_t i) const
  {
    return wide ? load<std::uint64_t>(bytes, 8 * i, swapped)
                : load<std::uint32_t>(bytes, 4 * i, swapped);
  }

  std::string header(const std::vector<std::size_t>& numbers) const
  {
    std::string bytes(this->width() * numbers.size(), '\0');
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      wide ? store<std::uint64_t>(bytes, 8 * i, numbers[i], swapped)
           : store(bytes, 4 * i, static_cast<std::uint32_t>(numbers[i]), swapped);
    }
    return bytes;
  }

  bool swapped;
  bool wide;
  bool compressed;
};

std::optional<std::string> unpack_plain(const Form& form, std::string_view text)
{
  const auto bytes = decode_all(text);
  return bytes ? std::optional(bytes->substr(std::min(form.width(), bytes->size()))) : std::nullopt;
}

/// The number of blocks, the size of each and of the last, those of what each is compressed to; then the blocks.
std::optional<std::string> unpack_blocks(const Form& form, std::string_view text)
{
  const auto head = decode_base64(text, 3 * form.width());
  const std::uint64_t blocks = head ? form.number(*head, 0) : 0;
  if (blocks == 0 || blocks > 64)
  {
    return std::nullopt;
  }
  const std::size_t head_bytes = (3 + blocks) * form.width();
  const auto sizes = decode_base64(text, head_bytes);
  if (!sizes || base64_chars(head_bytes) > text.size())
  {
    return std::nullopt;
  }
  const std::string_view rest = text.substr(base64_chars(head_bytes));
  const auto packed = decode_all(rest);
  std::string content;
  std::size_t at = 0;
  for (std::uint64_t i = 0; packed && i < blocks; ++i)
  {
    std::string block(1 << 16, '\0');
    uLongf size = block.size();
    const std::size_t bytes =
      std::min<std::size_t>(form.number(*sizes, 3 + i), packed->size() - at);
    if (uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
          reinterpret_cast<const Bytef*>(packed->data() + at), bytes) != Z_OK)
    {
      break;
    }
    content.append(block, 0, size);
    at += bytes;
  }
  return content;
}

std::string pack_blocks(const Form& form, const std::string& content, Random& random)
{
  const std::size_t block =
    1 + (one_in(random, 2) ? content.size() : below(random, content.size() + 1));
  std::vector<std::size_t> numbers = { (content.size() + block - 1) / block, block,
    content.size() % block };
  std::string packed;
  for (std::size_t at = 0; at < content.size(); at += block)
  {
    const std::size_t bytes = std::min(block, content.size() - at);
    uLongf size = compressBound(bytes);
    std::string part(size, '\0');
    compress2(reinterpret_cast<Bytef*>(part.data()), &size,
      reinterpret_cast<const Bytef*>(content.data() + at), bytes,
      static_cast<int>(below(random, 10)));
    packed.append(part, 0, size);
    numbers.push_back(size);
  }
  return encode_base64(form.header(numbers)) + encode_base64(packed);
}

/// Other values, sometimes more or fewer of them.
void mutate_values(std::string& content, Random& random, bool swapped)
{
  switch (content.empty() ? 0 : below(random, 5))
  {
    case 0:
      return mutate_bytes(content, content.size() + 32);
    case 1:
      return store(content, 8 * below(random, content.size() / 8), other_double(random), swapped);
    case 2:
      return store(content, 4 * below(random, content.size() / 4),
        static_cast<float>(below(random, 9)), swapped);
    case 3:
      return store(content, 8 * below(random, content.size() / 8),
        other_integer<std::int64_t>(1, random), swapped);
    default:
      return store(content, 4 * below(random, content.size() / 4),
        other_integer<std::int32_t>(1, random), swapped);
  }
}

}

void fuzz::mutate(std::string& bytes, Random& random, std::size_t most)
{
  const std::vector<Part> parts = find_encoded(bytes);
  if (parts.empty() || one_in(random, 3))
  {
    mutate_bytes(bytes, most);
    return;
  }
  const Part part = parts[below(random, parts.size())];
  const std::string_view text = std::string_view(bytes).substr(part.at, part.size);
  const Form form(bytes);
  auto content = form.compressed ? unpack_blocks(form, text) : unpack_plain(form, text);
  if (!content)
  {
    mutate_bytes(bytes, most);
    return;
  }
  mutate_values(*content, random, form.swapped);
  const std::string encoded = form.compressed
    ? pack_blocks(form, *content, random)
    : encode_base64(form.header({ content->size() }) + *content);
  bytes.replace(part.at, part.size, encoded);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  check_subdomain_file({ reinterpret_cast<const char*>(data), size });
  return 0;
}
