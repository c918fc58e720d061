// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/dump_reader.h"

#include "granular/dump/frame_decoder.h"
#include "granular/dump/sort_rows.h"
#include "granular/dump/text_dump.h"
#include "granular/dump/text_header.h"

#include <optional>
#include <string>

namespace granular
{
namespace
{
/// An integer column that holds other numbers is read again as doubles, a column that the table does
/// not know and that holds a word as texts. Ids must be integers.
void widen(const Misfit& misfit, ColumnSchema& schema, Notices& notices)
{
  const bool number = misfit.status == RowStatus::NotExact;
  const std::string text = std::string("expected ") + (number ? "an integer" : "a number") +
    ", got " + quoted(misfit.word);
  if (schema.columns()[static_cast<std::size_t>(misfit.column)].role == ColumnRole::Id)
  {
    throw FormatError(text, misfit.where);
  }
  notices.push_back(
    { misfit.where, text + "; the column is kept as " + (number ? "doubles" : "texts") });
  schema.set_type(misfit.column, number ? ValueType::Float64 : ValueType::Text);
}
}

DumpFrame read_dump(const std::string& path, const FrameEntry& entry, const DumpRequest& request,
  Notices& notices, Progress& progress)
{
  return read_dump(*open_file(path), entry, request, notices, progress);
}

DumpFrame read_dump(const ByteSource& source, const FrameEntry& entry, const DumpRequest& request,
  Notices& notices, Progress& progress)
{
  if (request.stride < 1)
  {
    throw LimitError("expected a stride >= 1, got " + std::to_string(request.stride));
  }
  check_unchanged(source, entry);
  ColumnSchema schema = *entry.schema;
  for (;;)
  {
    Notices found;
    FrameDecoder decoder(source, entry, schema, request, found);
    if (const std::optional<Misfit> misfit = decoder.run(progress))
    {
      widen(*misfit, schema, notices);
      continue;
    }
    Block ids;
    DumpFrame frame = decoder.take(ids);
    if (request.sort_by_id)
    {
      sort_by_id(frame, ids, found, { source.path(), entry.line });
    }
    notices.insert(notices.end(), found.begin(), found.end());
    return frame;
  }
}
}
