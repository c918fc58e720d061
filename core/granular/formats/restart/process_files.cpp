// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/process_files.h"

#include "granular/bytes/find_files.h"
#include "granular/formats/restart/bond_record.h"
#include "granular/formats/restart/find_chunks.h"
#include "granular/formats/restart/restart_bytes.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t count_bytes = 4;

/// Adds the file of one process.
void read_process_file(const std::string& path, RestartLayout& layout, Progress& progress)
{
  constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
  std::unique_ptr<ByteSource> source = open_file(path);
  const FileStamp stamp = source->stamp();
  source = unpack(std::move(source));
  std::string content;
  if (source->compressed())
  {
    content = read_up_to(*source, any, &progress);
    source = open_memory(content, path);
  }
  RestartBytes bytes(*source, layout.swapped);
  const std::int64_t doubles =
    bytes.number_at<std::int32_t>(0, "how many numbers a process has written");
  if (doubles < 0 || bytes.size() != count_bytes + 8 * doubles)
  {
    bytes.refuse("as many doubles behind the count as it says",
      "a count of " + std::to_string(doubles) + " and " +
        std::to_string(bytes.size() - count_bytes) + " bytes",
      0);
  }
  SearchBudget budget = { any, any };
  RecordWalker walker(*source, layout.swapped, layout.header, budget, progress);
  if (!walker.walk(count_bytes, doubles))
  {
    bytes.refuse("the record of a particle",
      "other numbers (" + std::to_string(walker.records()) + " were before it)", walker.at());
  }
  for (RecordBlock block : walker.blocks())
  {
    block.path = path;
    block.first_row += layout.records;
    layout.blocks.push_back(std::move(block));
  }
  layout.records += walker.records();
  layout.chunks.push_back({ path, count_bytes, doubles, stamp });
}
}

bool ProcessNames::match(const std::string& path) const
{
  if (path.size() <= before.size() + behind.size() || !path.starts_with(before) ||
    !path.ends_with(behind))
  {
    return false;
  }
  return std::all_of(path.begin() + static_cast<std::ptrdiff_t>(before.size()),
    path.end() - static_cast<std::ptrdiff_t>(behind.size()),
    [](char one) { return one >= '0' && one <= '9'; });
}

std::vector<ProcessNames> process_names(const std::string& base_path)
{
  constexpr std::string_view base = "base";
  const std::size_t slash = base_path.rfind('/');
  const std::size_t folder = slash == base_path.npos ? 0 : slash + 1;
  std::vector<ProcessNames> names;
  for (std::size_t at = base_path.size(); at-- > folder;)
  {
    if (std::string_view(base_path).substr(at).starts_with(base))
    {
      names.push_back({ base_path.substr(0, at), base_path.substr(at + base.size()) });
    }
  }
  return names;
}

const ProcessNames* find_process_names(const std::vector<ProcessNames>& candidates)
{
  const auto found = std::ranges::find_if(
    candidates, [](const ProcessNames& names) { return is_there(names.of(0)); });
  return found == candidates.end() ? nullptr : &*found;
}

void read_process_files(const ProcessNames& names, RestartLayout& layout, Progress& progress)
{
  layout.records = 0;
  layout.begin = layout.size;
  const std::string of_all = " of " + std::to_string(layout.header.processes);
  for (int process = 0; process < layout.header.processes; ++process)
  {
    const std::string path = names.of(process);
    if (!is_there(path))
    {
      throw FormatError("expected the particles of process " + std::to_string(process) + of_all +
          " in a file of their own, got none of this name",
        { path });
    }
    read_process_file(path, layout, progress);
  }
  if (layout.records != layout.header.atoms)
  {
    throw FormatError("expected " + std::to_string(layout.header.atoms) +
        " particles in the files of " + std::to_string(layout.header.processes) +
        " processes, got " + std::to_string(layout.records),
      { names.of(0) });
  }
}

bool is_process_file(const ByteSource& source)
{
  constexpr std::size_t least = RecordSlots::common;
  for (const bool swapped : { false, true })
  {
    RestartBytes bytes(source, swapped);
    const std::int64_t doubles =
      bytes.has(0, count_bytes) ? bytes.number_at<std::int32_t>(0, "") : -1;
    const std::int64_t end = count_bytes + 8 * doubles;
    if (doubles < 0 || !bytes.has(end - 1, 1) || bytes.has(end, 1))
    {
      continue;
    }
    if (doubles == 0 ||
      length_of(bytes.number_at<double>(count_bytes, ""), least, static_cast<std::size_t>(doubles)))
    {
      return true;
    }
  }
  return false;
}
}
