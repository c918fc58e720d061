// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/dump_reader.h"

#include "granular/dump/frame_chunks.h"
#include "granular/dump/frame_decoder.h"
#include "granular/dump/sort_rows.h"
#include "granular/dump/text_header.h"

#include <optional>
#include <string>

namespace granular
{
namespace
{
/// An integer column that holds other numbers is read again as doubles, a column that the table does
/// not know and that holds a word as texts. Ids of a text must be integers: those of a binary file
/// are where the user says that they are. Columns that nobody named must be what they are taken for.
void widen(const Misfit& misfit, const FrameKind& kind, ColumnSchema& schema, Notices& notices)
{
  const bool binary = kind.layout != FrameKind::text;
  const bool number = misfit.status == RowStatus::NotExact;
  const std::string text = std::string("expected ") + (number ? "an integer" : "a number") +
    ", got " + quoted(misfit.word);
  if (schema.columns()[static_cast<std::size_t>(misfit.column)].role == ColumnRole::Id && !binary)
  {
    throw FormatError(text, misfit.where);
  }
  if (kind.guessed)
  {
    throw FormatError(text +
        "; the columns, which the file does not name, are not those of dump atom: set ColumnNames",
      misfit.where);
  }
  notices.push_back(
    { misfit.where, text + "; the column is kept as " + (number ? "doubles" : "texts") });
  schema.set_type(misfit.column, number ? ValueType::Float64 : ValueType::Text);
}

/// The columns of all pieces, which must be the same; what holds texts in one piece does in all.
ColumnSchema join_schemas(const PieceList& pieces)
{
  const FrameEntry& first = *pieces.entries.front();
  ColumnSchema schema = first.kind->schema;
  for (std::size_t i = 1; i < pieces.entries.size(); ++i)
  {
    const FrameEntry& entry = *pieces.entries[i];
    const ColumnSchema& other = entry.kind->schema;
    const bool same_form = (entry.kind->layout < 0) == (first.kind->layout < 0);
    if (!same_form || entry.shape != first.shape)
    {
      const bool same_columns = other.text() == schema.text();
      throw FormatError("expected a piece of the same frame, got one with " +
          std::string(!same_form ? "text where others are binary"
              : same_columns     ? "another box"
                                 : "the columns " + other.text()),
        where_of(pieces.open(i)->path(), entry));
    }
    for (std::size_t column = 0; column < other.columns().size(); ++column)
    {
      if (other.columns()[column].type == ValueType::Text)
      {
        schema.set_type(static_cast<int>(column), ValueType::Text);
      }
    }
  }
  return schema;
}

DumpFrame read(
  const PieceList& pieces, const DumpRequest& request, Notices& notices, Progress& progress)
{
  if (request.stride < 1)
  {
    throw LimitError("expected a stride >= 1, got " + std::to_string(request.stride));
  }
  ColumnSchema schema = join_schemas(pieces);
  for (;;)
  {
    Notices found;
    FrameDecoder decoder(pieces, schema, request, found);
    if (const std::optional<Misfit> misfit = decoder.run(progress))
    {
      widen(*misfit, *pieces.entries.front()->kind, schema, notices);
      continue;
    }
    Block ids;
    DumpFrame frame = decoder.take(ids);
    if (request.sort_by_id)
    {
      sort_by_id(frame, ids, found, decoder.where());
    }
    notices.insert(notices.end(), found.begin(), found.end());
    return frame;
  }
}
}

DumpFrame read_dump(const std::vector<FramePiece>& pieces, const DumpRequest& request,
  Notices& notices, Progress& progress)
{
  PieceList list;
  for (const FramePiece& piece : pieces)
  {
    list.entries.push_back(&piece.entry);
  }
  list.open = [&pieces](std::size_t i) { return open_indexed(pieces[i].file); };
  return read(list, request, notices, progress);
}

DumpFrame read_dump(const ByteSource& source, const FrameEntry& entry, const DumpRequest& request,
  Notices& notices, Progress& progress)
{
  const auto lent = [](const ByteSource*) {};
  const PieceList list = { { &entry },
    [&](std::size_t) { return std::shared_ptr<const ByteSource>(&source, lent); } };
  return read(list, request, notices, progress);
}
}
