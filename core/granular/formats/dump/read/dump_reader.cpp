// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/read/dump_reader.h"

#include "granular/common/shares.h"
#include "granular/formats/dump/grammar/text_header.h"
#include "granular/formats/dump/read/frame_chunks.h"
#include "granular/formats/dump/read/frame_decoder.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/executor.h"
#include "granular/parallel/trade.h"
#include "granular/sorting/sort_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>

namespace granular
{
/// The remarks that a rank sends to the others about its part.
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<DumpPart>& part)
{
  archive.list(part.misfits,
    [&](auto& misfit)
    {
      archive.number(misfit.column);
      archive.number(misfit.status);
      archive.text(misfit.word);
      pass(archive, misfit.where);
    });
  pass(archive, part.notices);
  archive.number(part.loss);
}

namespace
{
std::string text_of(const Misfit& misfit)
{
  return std::string("expected ") +
    (misfit.status == RowStatus::NotExact ? "an integer" : "a number") + ", got " +
    quoted(misfit.word);
}

/// Returns true if a column must be what it is taken for. Ids of a text must be integers: those of a binary file
/// are where the user says that they are. Columns that the request knows hold numbers, and columns that nobody named
/// must be what they are taken for, too. The same on all ranks.
bool must_fit(const Misfit& misfit, const FrameKind& kind, const ColumnSchema& schema)
{
  const ColumnInfo& column = schema.columns()[static_cast<std::size_t>(misfit.column)];
  return (column.role == ColumnRole::Id && kind.is_text()) ||
    (column.known && misfit.status == RowStatus::NotANumber) || kind.guessed;
}

/// Throws if it must.
void check_misfit(const Misfit& misfit, const FrameKind& kind, const ColumnSchema& schema)
{
  if (must_fit(misfit, kind, schema))
  {
    throw FormatError(text_of(misfit) +
        (kind.guessed ? "; the columns, which the file does not name, are not those of dump atom: "
                        "set ColumnNames"
                      : ""),
      misfit.where);
  }
}

/// The type with which a column is read again.
ValueType wider(const Misfit& misfit, const ColumnInfo& column) noexcept
{
  const bool whole = misfit.status == RowStatus::NotDouble ||
    (column.type == ValueType::Int32 && column.role == ColumnRole::Other &&
      check_word(misfit.word, ValueType::Int64) == RowStatus::Done);
  return misfit.status == RowStatus::NotANumber ? ValueType::Text
    : whole                                     ? ValueType::Int64
                                                : ValueType::Float64;
}

/// Integer columns that hold other numbers are read again as longer integers or as doubles, columns that the table does
/// not know and that hold a word as texts. Longer integers lose nothing, so no notice tells of them. What must be what it is
/// taken for is left to the next pass, unless it is first.
void widen(const Misfits& misfits, const FrameKind& kind, ColumnSchema& schema, Notices& notices)
{
  std::vector<ColumnSchema::TypeChange> changes;
  const std::vector<int> arrays = schema.arrays_of_columns();
  std::set<int> done; // arrays, whose other columns are doubles now, too
  for (const Misfit& misfit : misfits)
  {
    if (&misfit != &misfits.front() && must_fit(misfit, kind, schema))
    {
      break;
    }
    const auto column = static_cast<std::size_t>(misfit.column);
    const ValueType type = wider(misfit, schema.columns()[column]);
    const bool is_new = type == ValueType::Text || done.insert(arrays[column]).second;
    if (is_new)
    {
      changes.push_back({ misfit.column, type });
    }
    if (is_new && type != ValueType::Int64)
    {
      notices.push_back({ misfit.where,
        text_of(misfit) + "; the column is kept as " +
          (type == ValueType::Float64 ? "doubles" : "texts") });
    }
  }
  schema.set_types(changes);
}

/// The columns of all pieces, which must be the same; what holds texts in one piece does in all, unless it is known to
/// hold numbers.
ColumnSchema join_schemas(const FramePieces& pieces, const Request& request)
{
  const FrameEntry& first = pieces.front().entry;
  const bool is_open = first.rows == 0 && first.kind->schema.columns().empty(); // names nothing
  if (request.schema && !is_open &&
    request.schema->columns().size() != first.kind->schema.columns().size())
  {
    throw FormatError("expected " + std::to_string(request.schema->columns().size()) +
        " columns, got " + std::to_string(first.kind->schema.columns().size()) + ": " +
        first.kind->schema.text(),
      where_of(pieces.front()));
  }
  ColumnSchema schema = request.schema.value_or(first.kind->schema);
  std::vector<ColumnSchema::TypeChange> texts;
  for (std::size_t i = 1; i < pieces.size(); ++i)
  {
    const FrameEntry& entry = pieces[i].entry;
    const ColumnSchema& other = entry.kind->schema;
    const bool same_form = entry.kind->is_text() == first.kind->is_text();
    const bool same_columns = other.text() == first.kind->schema.text();
    if (!same_form || !same_columns || entry.shape != first.shape)
    {
      throw FormatError("expected a piece of the same frame, got one with " +
          std::string(!same_form ? "text where others are binary"
              : same_columns     ? "another box"
                                 : "the columns " + other.text()),
        where_of(pieces[i]));
    }
    for (std::size_t column = 0; column < other.columns().size(); ++column)
    {
      if (other.columns()[column].type == ValueType::Text &&
        schema.columns().at(column).may_be_words)
      {
        texts.push_back({ static_cast<int>(column), ValueType::Text });
      }
    }
  }
  schema.set_types(texts);
  return schema;
}

/// Which rows a process decodes: one that is alone sorts all to get its part of them.
Request own_request(const Request& request, bool together)
{
  Request own = request;
  if (request.sort_by_id && !together)
  {
    own.piece = 0;
    own.pieces = 1;
  }
  return own;
}

void check(const Request& request)
{
  if (request.stride < 1)
  {
    throw LimitError("expected a stride >= 1, got " + std::to_string(request.stride));
  }
  if (request.piece < 0 || request.piece >= request.pieces)
  {
    throw LimitError("expected a piece from 0 to below " + std::to_string(request.pieces) +
      ", got " + std::to_string(request.piece));
  }
}

/// Returns true if the digits of the box, which scales coordinates to the points, move these.
bool moves_points(const Table& frame, const Request& request)
{
  if (!request.points || frame.header.rows == 0 || frame.header.box_rounding == Vector3{})
  {
    return false;
  }
  Notices known; // the layout has said what there is to say
  const PositionPlan plan =
    plan_positions(frame.schema, frame.header.box, request.coordinates, {}, known);
  return plan.coordinates != Coordinates::Scaled &&
    std::ranges::any_of(plan.axes, [&](const auto& axis) { return is_rescaled(plan, axis); });
}

/// The loss of points that move so far along the axes of their coordinates.
RoundingLoss loss_of(const Vector3& moved, const Table& frame)
{
  RoundingLoss loss{ .moved = moved };
  for (std::size_t axis = 0; frame.coordinates == Coordinates::Scaled && axis < 3; ++axis)
  {
    loss.moved[axis] = 0;
    for (std::size_t edge = 0; edge < 3; ++edge)
    {
      loss.move(axis, moved[edge] * std::abs(frame.header.box.vectors[edge][axis].hi));
    }
  }
  return loss;
}

DumpPart decode(
  const FramePieces& pieces, const ColumnSchema& schema, const Request& request, Progress& progress)
{
  DumpPart part = FrameDecoder(pieces, schema, request).run(progress);
  if (part.misfits.empty())
  {
    part.loss = loss_of(part.loss.moved, part.frame);
    if (request.single_precision || moves_points(part.frame, request))
    {
      part.loss.add_radius(smallest_radius(view_frame(part.frame)));
    }
  }
  return part;
}

/// Puts together what all ranks have to say, on all: the first misfits, and each notice once.
void share_remarks(Communicator& ranks, DumpPart& part)
{
  if (ranks.size() == 1)
  {
    return;
  }
  const std::vector<DumpPart> of_ranks = gather(ranks, part);
  part.misfits.clear();
  part.notices.clear();
  std::set<std::string> said;
  for (const DumpPart& remarks : of_ranks)
  {
    part.misfits = part.misfits.empty() ? remarks.misfits : part.misfits;
    part.loss.add(remarks.loss);
    std::ranges::copy_if(remarks.notices, std::back_inserter(part.notices),
      [&](const Notice& notice) { return said.insert(to_string(notice)).second; });
  }
}

/// The parts of all ranks must have the rows that the headers promise: none of them sees them all.
void check_counts(Communicator& ranks, const FramePieces& pieces, DumpPart& part)
{
  if (ranks.size() == 1)
  {
    return;
  }
  ranks.sum(part.counts);
  for (std::size_t piece = 0; piece < part.counts.size(); ++piece)
  {
    if (part.counts[piece] != pieces[piece].entry.rows)
    {
      fail_count(pieces[piece], part.counts[piece]);
    }
  }
}

/// Tells how far single precision and the digits of the box move points: once per file and origin, and once per file.
void note_losses(const DumpPart& part, const Request& request, const Where& where, Notices& notices)
{
  const FrameHeader& header = part.frame.header;
  std::string topic = "single";
  for (const double coordinate : request.point_origin)
  {
    topic += " " + to_text(coordinate);
  }
  note_loss(part.loss.text(header.box, "points", {}), "rounding to single precision",
    "set PointOrigin near the particles, or PointPrecision=Double", where, topic, notices);
  if (moves_points(part.frame, request))
  {
    RoundingLoss of_box = part.loss;
    of_box.moved = header.box_rounding;
    note_loss(of_box.text(header.box, "points", {}),
      "the last digit of the bounds of the box, which scale the coordinates,",
      "dump x y z with more digits (dump_modify ID format \"%d %d %.12g ...\", a format for "
      "each column), or a binary file",
      where, "digits of the box", notices);
  }
}

/// Sorts the rows if that is asked for. Collective.
void sort(DumpPart& part, const Request& request, Communicator& ranks, const Where& where)
{
  if (!request.sort_by_id)
  {
    return;
  }
  const Executor executor(request.threads);
  if (ranks.size() > 1 || request.pieces > 1)
  {
    FrameRanges(part.frame).store(part.frame); // of none: the rows will be others
  }
  sort_by_id(part.frame, part.ids, ranks, part.notices, where, executor);
  if (ranks.size() == 1 && request.pieces > 1)
  {
    const std::int64_t first = begin_of_part(part.frame.rows, request.piece, request.pieces);
    const std::int64_t end = begin_of_part(part.frame.rows, request.piece + 1, request.pieces);
    keep_rows(part.frame, first, end - first);
  }
}
}

Table read_dump(const std::vector<FramePiece>& pieces, const Request& request, Communicator& ranks,
  Notices& notices, Progress& progress)
{
  SharedProgress shared(progress, ranks);
  PartialProgress forward(shared); // also where a frame is read again
  return do_together(ranks,
    [&]
    {
      check(request);
      const Request own = own_request(request, ranks.size() > 1);
      const Where where = where_of(pieces.front());
      ColumnSchema schema = join_schemas(pieces, request);
      Notices
        widened; // dropped if the frame cannot be read: how many there are depends on chunk_bytes
      DumpPart part = decode(pieces, schema, own, forward);
      for (share_remarks(ranks, part); !part.misfits.empty(); share_remarks(ranks, part))
      {
        const FrameKind& kind = *pieces.front().entry.kind;
        check_misfit(part.misfits.front(), kind, schema);
        widen(part.misfits, kind, schema, widened);
        part = {}; // the memory of a rank whose own rows did fit
        part = decode(pieces, schema, own, forward);
      }
      check_counts(ranks, pieces, part);
      sort(part, request, ranks, where);
      notices.insert(notices.end(), widened.begin(), widened.end());
      notices.insert(notices.end(), part.notices.begin(), part.notices.end());
      note_losses(part, request, where, notices);
      return std::move(part.frame);
    });
}

Table read_dump(const std::vector<FramePiece>& pieces, const Request& request, Notices& notices,
  Progress& progress)
{
  SerialCommunicator alone;
  return read_dump(pieces, request, alone, notices, progress);
}

DumpPart decode_dump(
  const std::vector<FramePiece>& pieces, const Request& request, bool together, Progress& progress)
{
  check(request);
  return decode(pieces, join_schemas(pieces, request), own_request(request, together), progress);
}
}
