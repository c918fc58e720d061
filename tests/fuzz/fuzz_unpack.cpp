// SPDX-License-Identifier: BSD-3-Clause
// A compressed file from memory. Whatever the bytes are, there is an Error or content; the content
// is the same from the start, from anywhere, and from seek points that another source found.
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

using namespace granular;

namespace
{
constexpr std::size_t most_content = std::size_t{ 1 } << 23; // a few bytes may stand for a lot

void require(bool good, const char* what)
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

Content read_all(const ByteSource& source, std::size_t piece)
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
void check_places(const ByteSource& source, const Content& content)
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
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view packed(reinterpret_cast<const char*>(data), size);
  const Content content = read_all(*unpack(open_memory(packed)), std::size_t{ 1 } << 18);

  const auto points = std::make_shared<SeekPoints>();
  points->spacing = 1;
  const Content pieces = read_all(*unpack(open_memory(packed), points), 777);
  if (content.text.size() < most_content && pieces.text.size() < most_content)
  {
    require(pieces.refused == content.refused, "refused or not");
    require(content.refused || pieces.text == content.text, "pieces differ");
    require(content.refused || pieces.unchecked == content.unchecked, "checked or not");
  }
  require(points->points.size() <= 1024, "too many points");

  check_places(*unpack(open_memory(packed), points), pieces);
  check_places(*unpack(open_memory(packed)), pieces);
  return 0;
}
