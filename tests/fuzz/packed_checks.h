// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets of compressed files share. Whatever the bytes are, there is an Error or content; the content is the
// same from the start, from anywhere, from seek points that another source found, and as the library itself gives it.
#ifndef granular_tests_fuzz_packed_checks_h
#define granular_tests_fuzz_packed_checks_h

#include "mutations.h"

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular::fuzz
{
constexpr std::size_t most_content = std::size_t{ 1 } << 23; // a few bytes may stand for a lot

inline void require(bool good, const char* what)
{
  if (!good)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

struct Content
{
  std::string text;
  std::string unchecked;
  bool refused = false;
};

inline Content read_all(const ByteSource& source, std::size_t piece)
{
  Content content;
  std::vector<char> buffer(piece);
  try
  {
    for (std::size_t got = piece; got == piece && content.text.size() < most_content;)
    {
      got = source.read(static_cast<std::int64_t>(content.text.size()), buffer.data(), piece);
      content.text.append(buffer.data(), got);
    }
    content.unchecked = source.unchecked();
  }
  catch (const Error& error)
  {
    require(error.where().byte >= 0, "an error without a place");
    content.refused = true;
  }
  return content;
}

/// Reads of a few places, the last first. Damage may show or not, but what is read is the same.
inline void check_places(const ByteSource& source, const Content& content)
{
  const std::size_t size = content.text.size();
  const bool whole = !content.refused && size < most_content;
  std::vector<char> buffer(1000);
  for (std::size_t i = 8; i-- > 0;)
  {
    const std::size_t offset = size / 8 * i;
    try
    {
      const std::size_t got =
        source.read(static_cast<std::int64_t>(offset), buffer.data(), buffer.size());
      const std::size_t known = std::min(got, size - offset);
      require(content.text.compare(offset, known, buffer.data(), known) == 0, "other content");
      require(!whole || got == std::min(buffer.size(), size - offset), "more content, or less");
    }
    catch (const Error&)
    {
      require(!whole, "an error that was not there before");
    }
  }
}

/// The content by the library that made the format.
struct Reference
{
  enum class End
  {
    Whole,
    Cut,    ///< the bytes end within the data
    Damaged ///< nothing is known of what is behind
  };

  std::string text; ///< up to most_content
  End end = End::Whole;
};

inline void compare(const Content& content, const Reference& reference)
{
  using End = Reference::End;
  const std::size_t known = std::min(content.text.size(), reference.text.size());
  require(
    content.text.compare(0, known, reference.text, 0, known) == 0, "not the library's content");
  if (content.text.size() >= most_content || reference.text.size() >= most_content)
  {
    return; // nobody looked at the end
  }
  require(!content.refused || reference.end != End::Whole, "refused, unlike the library");
  // Other damage may be seen or not: in a header that is not all there, in codes that nothing uses, or where no sum is.
  if (content.refused || reference.end == End::Damaged)
  {
    return;
  }
  const bool cut = reference.end == End::Cut;
  constexpr std::size_t held_back = 3; // ISA-L decodes up to three characters at a time
  const std::size_t size = reference.text.size();
  require(content.text.size() == size ||
      (cut && content.text.size() < size && size - content.text.size() <= held_back),
    "the size of the content");
  require(content.unchecked.empty() == (reference.end == End::Whole),
    "checked, or not, unlike the library");
}

/// Other content, packed again, now and then in two parts with something between them.
template <class Unpack, class Pack, class Between>
void mutate_packed(std::string& bytes, Random& random, std::size_t most, const Unpack& unpack,
  const Pack& pack, const Between& between)
{
  if (one_in(random, 3))
  {
    mutate_bytes(bytes, most);
    return;
  }
  std::string content = unpack(bytes, 4 * most).text;
  if (one_in(random, 8)) // the content is then larger than a window, a block, or a step
  {
    while (!content.empty() && content.size() < (std::size_t{ 1 } << 18))
    {
      content += content;
    }
  }
  if (!one_in(random, 3))
  {
    mutate_bytes(content, content.size() + 64);
  }
  const std::size_t cut = one_in(random, 3) ? below(random, content.size() + 1) : content.size();
  bytes = pack(content.substr(0, cut), random) + between(random);
  if (cut < content.size())
  {
    bytes += pack(content.substr(cut), random);
  }
}

/// All there is to do with a compressed file. summed: damage is seen, however the file is read.
inline void check_packed(std::string_view packed, const Reference& reference, bool summed)
{
  const auto points = std::make_shared<SeekPoints>();
  points->spacing = 1;
  const auto whole = unpack(open_memory(packed));
  if (!whole->compressed())
  {
    return;
  }
  const Content content = read_all(*whole, std::size_t{ 1 } << 18);
  compare(content, reference);

  const Content pieces = read_all(*unpack(open_memory(packed), points), 777);
  if (content.text.size() < most_content && pieces.text.size() < most_content)
  {
    const bool refused = content.refused || pieces.refused;
    require(pieces.refused == content.refused || !summed, "refused or not");
    require(refused || pieces.text == content.text, "pieces differ");
    require(refused || pieces.unchecked == content.unchecked, "checked or not");
  }
  require(points->points.size() <= 1024, "too many points");

  check_places(*unpack(open_memory(packed), points), pieces);
  check_places(*unpack(open_memory(packed)), pieces);
}
}

#endif
