// SPDX-License-Identifier: BSD-3-Clause
#include "frame_content.h"

#include "dumps.h"

#include "granular/common/progress.h"

#include <algorithm>
#include <new>

using namespace granular;

namespace
{
std::string bytes_of(const Block& block)
{
  return { static_cast<const char*>(block.data()), block.bytes() };
}

std::string texts_of(const TableArray& array, std::int64_t rows)
{
  const auto* const indices = static_cast<const std::int32_t*>(array.block.data());
  std::string texts;
  for (std::int64_t row = 0; row < rows; ++row)
  {
    texts += array.words.at(static_cast<std::size_t>(indices[row])) + "\n";
  }
  return texts;
}

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += word + "\n";
  }
  return text;
}

/// Lines, each once.
std::string merged(const std::string& lines, const std::string& more)
{
  std::string all = "\n" + lines;
  for (std::size_t at = 0; at < more.size();)
  {
    const std::size_t end = more.find('\n', at) + 1;
    const std::string line = more.substr(at, end - at);
    all += all.find("\n" + line) == all.npos ? line : "";
    at = end;
  }
  return all.substr(1);
}
}

FrameContent content_of(const Table& frame)
{
  FrameContent content;
  content.head = "step " + std::to_string(frame.header.timestep) + ", rows of all " +
    std::to_string(frame.header.rows) + ", " + to_string(frame.coordinates) + ", columns";
  for (const ColumnInfo& column : frame.schema.columns())
  {
    content.head += " " + column.name + ":" + std::to_string(static_cast<int>(column.type));
  }
  content.rows = frame.rows;
  content.values.push_back(bytes_of(frame.points));
  content.head += ", arrays";
  for (const TableArray& array : frame.arrays)
  {
    const bool texts = array.info.type == ValueType::Text;
    content.head += " " + array.info.name + ":" + std::to_string(static_cast<int>(array.info.type));
    content.values.push_back(texts ? texts_of(array, frame.rows) : bytes_of(array.block));
    content.words.push_back(joined(array.words));
  }
  return content;
}

void FrameContent::append(const FrameContent& next)
{
  if (next.head != head)
  {
    head += "; another part: " + next.head;
    return;
  }
  rows += next.rows;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] += next.values[i];
  }
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    words[i] = merged(words[i], next.words[i]);
  }
}

std::string FrameContent::difference(const FrameContent& other) const
{
  if (head != other.head)
  {
    return head + " / " + other.head;
  }
  if (rows != other.rows)
  {
    return std::to_string(rows) + " rows / " + std::to_string(other.rows);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (values[i] != other.values[i])
    {
      const auto [at, unused] = std::ranges::mismatch(values[i], other.values[i]);
      return "values " + std::to_string(i) + " differ at byte " +
        std::to_string(at - values[i].begin()) + " of " + std::to_string(values[i].size());
    }
  }
  return words == other.words ? "" : "words differ";
}

std::string Outcome::difference(const Outcome& other) const
{
  if (error != other.error)
  {
    return "'" + error + "' / '" + other.error + "'";
  }
  return said != other.said ? "'" + said + "' / '" + other.said + "'"
                            : content.difference(other.content);
}

Outcome outcome_of(const ReadFrame& read, const Request& request)
{
  Outcome outcome;
  Notices notices;
  try
  {
    outcome.content = content_of(read(request, notices));
  }
  catch (const Error& error)
  {
    outcome.error = error.what();
  }
  catch (const std::bad_alloc&)
  {
    outcome.error = "out of memory";
  }
  catch (const Cancelled&)
  {
    outcome.error = "cancelled";
  }
  outcome.said = lines_of(notices);
  return outcome;
}

Request plainly(Request request)
{
  return in_chunks(std::move(request), 1, std::size_t{ 1 } << 40);
}

Request in_chunks(Request request, int threads, std::size_t chunk_bytes)
{
  request.threads = threads;
  request.chunk_bytes = chunk_bytes;
  return request;
}

Outcome outcome_of_parts(const ReadFrame& read, Request request, int pieces)
{
  Outcome all;
  request.pieces = pieces;
  for (request.piece = 0; request.piece < pieces; ++request.piece)
  {
    const Outcome part = outcome_of(read, request);
    if (!part.error.empty())
    {
      return part;
    }
    if (request.piece == 0)
    {
      all = part;
      continue;
    }
    all.content.append(part.content);
    all.said = merged(all.said, part.said);
  }
  return all;
}

std::vector<Request> all_requests()
{
  const std::array<double, 6> half = { -1e300, 0.02, 1, -1, 0, 1e300 };
  std::vector<Request> all(9);
  all[0] = everything();
  all[1].stride = 3;
  all[2].region = half;
  all[3] = everything();
  all[3].stride = 2;
  all[3].region = half;
  all[3].single_precision = true;
  all[3].point_origin = { 1, 2, 3 };
  all[4] = everything();
  all[4].sort_by_id = true;
  all[5].sort_by_id = true;
  all[5].stride = 2;
  all[5].wanted = [](std::string_view, bool) { return false; };
  all[6].coordinates = Coordinates::Unwrapped;
  all[6].region = half;
  all[7].coordinates = Coordinates::Scaled;
  all[7].single_precision = true;
  all[8].wanted = [](std::string_view, bool) { return false; };
  all[8].stride = 5;
  return all;
}
