// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/data_bonds.h"

#include "granular/frames/file_index.h"
#include "granular/numbers/number.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <vector>

namespace granular
{
namespace
{
/// What the lines before the first section say.
struct DataHeader
{
  std::optional<std::int64_t> atoms;
  std::optional<std::int64_t> bonds;
  std::int64_t timestep = 0;
};

bool is_integer(std::string_view word, std::int64_t& value)
{
  return static_cast<bool>(parse_int64(word.data(), word.data() + word.size(), value));
}

/// The words of a line, less a comment.
std::vector<std::string_view> words_of(std::string_view line)
{
  return split_words(line.substr(0, line.find('#')));
}

/// write_data puts "timestep = N" into the title.
std::int64_t timestep_of(std::string_view title)
{
  const std::vector<std::string_view> words = split_words(title);
  std::int64_t timestep = 0;
  for (std::size_t i = 2; i < words.size(); ++i)
  {
    std::int64_t number = 0;
    if (words[i - 2] == "timestep" && words[i - 1] == "=" &&
      is_integer(words[i].substr(0, words[i].find(',')), number))
    {
      timestep = number;
    }
  }
  return timestep;
}

/// Takes "100 bonds" and the like. False for the first line of a section: a word that begins it.
bool take_line(std::string_view line, DataHeader& header)
{
  const std::vector<std::string_view> words = words_of(line);
  std::int64_t number = 0;
  if (words.size() == 2 && is_integer(words[0], number))
  {
    if (words[1] == "atoms")
    {
      header.atoms = number;
    }
    if (words[1] == "bonds")
    {
      header.bonds = number;
    }
  }
  return words.empty() || std::isalpha(static_cast<unsigned char>(words[0][0])) == 0;
}

/// Passes over the rows of the section, from the line that comes next on. Returns how many.
std::int64_t pass_rows(TextScanner& scanner, std::int64_t most, Progress& progress, double size)
{
  constexpr std::int64_t often = 1 << 16;
  std::string_view line;
  std::int64_t rows = 0;
  while (rows < most && scanner.next(line))
  {
    std::int64_t id = 0;
    const std::vector<std::string_view> words = words_of(line);
    const bool comment = words.empty() && has_words(line);
    if (comment || (!words.empty() && !is_integer(words[0], id)))
    {
      scanner.put_back();
      break;
    }
    rows += words.empty() ? 0 : 1;
    if (rows % often == 0)
    {
      progress.step(std::min(1.0, static_cast<double>(scanner.offset()) / size));
    }
  }
  return rows;
}

/// Whether the text ends in a line that its writer may not be done with.
bool has_more(const ByteSource& source, TextScanner& scanner)
{
  std::string_view line;
  if (scanner.next(line))
  {
    scanner.put_back();
    return false;
  }
  char byte = 0;
  return source.read(scanner.offset(), &byte, 1) > 0;
}

/// Goes behind the line that begins the section Bonds, and takes the header on the way. False: there is no such line.
bool find_section(TextScanner& scanner, DataHeader& header, Progress& progress, double size)
{
  constexpr std::int64_t often = 1 << 16;
  std::string_view line;
  bool in_header = true;
  for (std::int64_t number = 0; scanner.next(line); ++number)
  {
    if (number == 0)
    {
      header.timestep = timestep_of(line);
      continue;
    }
    in_header = in_header && take_line(line, header);
    if (!in_header && line.find("Bonds") != line.npos)
    {
      const std::vector<std::string_view> words = words_of(line);
      if (words.size() == 1 && words[0] == "Bonds")
      {
        return true;
      }
    }
    if (number % often == 0)
    {
      progress.step(std::min(1.0, static_cast<double>(scanner.offset()) / size));
    }
  }
  return false;
}
}

bool is_data_with_bonds(std::string_view first_bytes)
{
  DataHeader header;
  bool title = true;
  while (!first_bytes.empty())
  {
    const std::size_t feed = first_bytes.find('\n');
    const std::string_view line = first_bytes.substr(0, feed);
    if (!title && !take_line(line, header))
    {
      break;
    }
    title = false;
    first_bytes.remove_prefix(feed == first_bytes.npos ? first_bytes.size() : feed + 1);
  }
  return header.atoms && header.bonds;
}

void index_data_bonds(const ByteSource& source, FileIndex& index, Progress& progress)
{
  const auto size = static_cast<double>(std::max<std::int64_t>(index.stamp.size, 1));
  index.frames.clear(); // the file is read as a whole, whatever was there before
  index.resume_offset = 0;
  index.resume_line = 1;
  TextScanner scanner(source, 0, 1);
  DataHeader header;
  const bool found = find_section(scanner, header, progress, size);
  FrameEntry entry;
  entry.timestep = header.timestep;
  entry.offset = scanner.offset();
  entry.line = scanner.line();
  const std::int64_t wanted = header.bonds.value_or(0);
  const Where where{ source.path(), entry.line };
  if (!header.bonds)
  {
    set_defect(index, { where, "expected a header that counts bonds, got the end of the file" });
    return;
  }
  if (!found && wanted != 0)
  {
    set_defect(index,
      { where, "expected a section Bonds with " + std::to_string(wanted) + " rows, got none" });
    return;
  }
  entry.rows = found ? pass_rows(scanner, wanted, progress, size) : 0;
  entry.end = scanner.offset();
  if (entry.rows != wanted)
  {
    set_defect(index,
      { where,
        "expected " + std::to_string(wanted) + " rows in the section Bonds, got " +
          std::to_string(entry.rows) +
          (has_more(source, scanner) ? ", and a last line without its line feed" : "") });
    return;
  }
  FrameKind kind;
  kind.schema = ColumnSchema({ "bond_id", "btype", "id1", "id2" });
  kind.layout = FrameKind::bare;
  entry.kind = index.kinds->share(std::move(kind));
  index.frames.assign(1, entry);
  index.resume_offset = entry.end;
  index.resume_line = scanner.line();
}
}
