// SPDX-License-Identifier: BSD-3-Clause
#include "private/writing/rows_file.h"

#include "private/request/text_of.h"

#include "granular/common/words.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
/**
 * What the pipeline says beyond the field data.
 */
void Complete(RowsInput& data, const FrameTime& time, granular::Notices& notices)
{
  granular::FrameHeader& header = data.View.header;
  if (!data.HasTimestep)
  {
    header.timestep = time.Step.value_or(time.Frame);
    granular::Notice notice;
    notice.text = time.Step ? "the input has no field data 'timestep': its time is taken for it"
                            : "the input has no field data 'timestep': frames are counted from 0";
    notices.push_back(notice);
  }
  if (!data.HasTime)
  {
    header.time = time.Time;
  }
}
}

std::optional<granular::Dialect> DialectOf(int property)
{
  return property == 0 ? std::optional(granular::Dialect::Liggghts)
    : property == 1    ? std::optional(granular::Dialect::Lammps)
                       : std::nullopt;
}

granular::DumpFormat MakeFormat(const char* path, std::optional<granular::Dialect> dialect,
  const char* columns, const char* numberFormat)
{
  granular::DumpFormat format;
  format.dialect = dialect;
  format.binary = granular::is_binary_name(path);
  format.compression = granular::compression_of_name(path);
  format.numbers = granular::parse_number_format(TextOf(numberFormat));
  const std::string names = TextOf(columns);
  for (const std::string_view name : granular::split_words(names))
  {
    format.columns.emplace_back(name);
  }
  return format;
}

RowsFile::RowsFile(const char* path, granular::DumpFormat format,
  const granular::WriteOptions& options, granular::Communicator& ranks)
  : Path(path)
  , Ranks(ranks)
  , Writer(path, std::move(format), options, ranks)
{
}

void RowsFile::Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
  granular::Progress& progress)
{
  granular::Notices own;
  const std::unique_ptr<RowsInput> data = this->Take(input, own);
  Complete(*data, time, own);
  std::string told = data->View.rows > 0 ? "rows" : "none";
  for (const granular::Notice& notice : own)
  {
    told += '\0' + notice.text;
  }
  this->Gather(told, notices);
  this->Writer.write(data->View, notices, progress);
}

void RowsFile::Finish()
{
  this->Writer.finish();
}

/**
 * What any of the processes has to say that has rows, or all of them where none has: who has no rows may have no
 * field data either.
 */
void RowsFile::Gather(const std::string& own, granular::Notices& notices)
{
  const std::vector<std::string> all = this->Ranks.all_gather(own);
  const bool any = std::any_of(
    all.begin(), all.end(), [](const std::string& told) { return told.front() == 'r'; });
  for (const std::string& told : all)
  {
    std::istringstream texts(told);
    std::string text;
    std::getline(texts, text, '\0');
    while ((!any || told.front() == 'r') && std::getline(texts, text, '\0'))
    {
      notices.push_back({ {}, text });
    }
  }
}
}
