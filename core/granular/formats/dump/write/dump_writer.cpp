// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/dump_writer.h"

#include "granular/common/error.h"
#include "granular/common/shares.h"
#include "granular/formats/dump/write/frame_plan.h"
#include "granular/formats/dump/write/row_batches.h"

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace granular
{
namespace
{
/// Bytes of text that a rank keeps while it counts all, so that it need not encode them again.
constexpr std::size_t most_kept = std::size_t{ 16 } << 20;
}

/// The file, as this rank knows it.
struct DumpWriter::File
{
  File(const std::string& path, const DumpFormat& format, const WriteOptions& options,
    Communicator& all, bool may_share)
    : executor(options.threads)
    , ranks(is_name_of_ranks(path) ? alone : all)
  {
    if (options.mode == ParallelMode::MpiIo && ranks.size() > 1 &&
      format.compression == Compression::None && may_share)
    {
      shared = ranks.open_together(path);
    }
    if (!shared && ranks.rank() == 0)
    {
      own = std::make_unique<NewFile>(name_of_rank(path, all.rank()));
      appender.emplace(*own, format.compression, executor);
    }
  }

  void append_rows(std::string_view header, RowBatches& rows, Progress& progress)
  {
    appender->append(header);
    if (appender->is_plain())
    {
      rows.write_to(*appender, progress);
      return;
    }
    while (rows.next(progress))
    {
      for (const std::string_view part : rows.bytes())
      {
        appender->append(part);
      }
    }
  }

  /// The first rank takes what the others send until each says that this is all. Also after an error: who sends
  /// waits until somebody takes it.
  void gather_rows(std::string_view header, RowBatches& rows, Progress& progress)
  {
    std::exception_ptr failure;
    const auto attempt = [&](const auto& work)
    {
      try
      {
        if (!failure)
        {
          work();
        }
      }
      catch (...)
      {
        failure = caught_exception();
        ranks.call_off();
      }
    };
    const auto take = [&](std::string& bytes, int source)
    {
      try
      {
        ranks.receive(bytes, source);
        return !bytes.empty();
      }
      catch (const std::bad_alloc&)
      {
        attempt([] { throw; });
        return true;
      }
    };
    PartialProgress part(progress);
    const double share = 1.0 / ranks.size();
    if (ranks.rank() == 0)
    {
      part.set_part(0, share);
      attempt([&] { this->append_rows(header, rows, part); });
      for (int source = 1; source < ranks.size(); ++source)
      {
        part.set_part(source * share, (source + 1) * share);
        std::string bytes;
        while (take(bytes, source))
        {
          attempt(
            [&]
            {
              part.step(0);
              appender->append(bytes);
            });
        }
      }
      attempt([&] { appender->end_part(); });
    }
    else
    {
      attempt(
        [&]
        {
          while (rows.next(part))
          {
            for (const std::string_view bytes : rows.bytes())
            {
              if (!bytes.empty())
              {
                ranks.send(bytes, 0);
              }
            }
          }
        });
      ranks.send({}, 0);
    }
    agree(ranks, failure);
  }

  /// Each rank writes its rows behind those of the ranks before it. Those of a text are counted first.
  void share_rows(std::string_view header, RowBatches& rows, const ChunkLengths& chunks,
    std::span<const std::int64_t> kept_rows, Progress& progress)
  {
    PartialProgress part(progress);
    const auto rank = static_cast<std::size_t>(ranks.rank());
    std::int64_t before = 0;
    std::int64_t all = 0;
    std::string kept;
    if (chunks.rows_per_chunk() > 0)
    {
      before = chunks.offset(sum_of(kept_rows.first(rank)));
      all = chunks.offset(sum_of(kept_rows));
    }
    else
    {
      std::vector<std::int64_t> counts(kept_rows.size());
      part.set_part(0, 0.5);
      counts[rank] = static_cast<std::int64_t>(this->count_text(rows, kept, part));
      ranks.sum(counts);
      before = sum_of(std::span(counts).first(rank));
      all = sum_of(counts);
      part.set_part(0.5, 1);
    }
    if (rank == 0)
    {
      shared->write_at(shared_size, header);
    }
    const std::int64_t begin = shared_size + static_cast<std::int64_t>(header.size());
    std::int64_t offset = begin + before;
    const auto write = [&](std::string_view bytes)
    {
      shared->write_at(offset, bytes);
      offset += static_cast<std::int64_t>(bytes.size());
    };
    write(kept);
    while (rows.next(part))
    {
      std::ranges::for_each(rows.bytes(), write);
    }
    shared_size = begin + all;
  }

  /// Counts the bytes of all rows, keeps the first, and leaves rows where those begin that are not kept.
  std::size_t count_text(RowBatches& rows, std::string& kept, Progress& progress)
  {
    kept.reserve(most_kept); // growing would take thrice as much; what is not used is not touched
    std::size_t bytes = 0;
    std::size_t chunks_kept = 0;
    bool keeps = true;
    while (rows.next(progress))
    {
      for (const std::string_view part : rows.bytes())
      {
        bytes += part.size();
        keeps = keeps && kept.size() + part.size() <= most_kept;
        kept += keeps ? part : std::string_view();
        chunks_kept += keeps ? 1 : 0;
      }
    }
    rows.go_to(chunks_kept);
    return bytes;
  }

  Executor executor;
  SerialCommunicator alone;
  Communicator& ranks;                  ///< those that write this file
  std::unique_ptr<NewFile> own;         ///< of the first of them
  std::optional<FileAppender> appender; ///< to own
  std::unique_ptr<OutputFile> shared;   ///< of all of them
  std::int64_t shared_size = 0;
  bool first = true; ///< no frame is written yet
};

DumpWriter::DumpWriter(
  std::string path, DumpFormat format, const WriteOptions& options, Communicator& ranks)
  : path_(std::move(path))
  , format_(std::move(format))
  , options_(options)
  , ranks_(ranks)
  , held_(options.inputs)
{
  do_together(ranks_,
    [&]
    {
      check_format(format_, path_);
      if (!is_name_of_steps(path_))
      {
        file_ = std::make_unique<File>(path_, format_, options_, ranks_, true);
      }
    });
}

DumpWriter::~DumpWriter() = default;

void DumpWriter::write(const FrameView& frame, Notices& notices, Progress& progress)
{
  if (!file_ && !is_name_of_steps(path_))
  {
    throw std::logic_error("a dump is written to after it was finished");
  }
  this->expect_whole();
  failed_ = true;
  do_together(ranks_,
    [&]
    {
      FramePlan plan = plan_frame(frame, format_, ranks_, notices);
      format_.dialect = plan.header.dialect; // later frames have the same
      const std::string path = name_of_new_step(path_, plan.header.timestep, steps_);
      const bool is_read = held_.is_read(name_of_rank(path, ranks_.rank()), ranks_);
      if (is_name_of_steps(path_))
      {
        file_ = std::make_unique<File>(path, format_, options_, ranks_, !is_read);
      }
      this->write_rows(frame, plan, notices, progress);
      if (is_name_of_steps(path_))
      {
        this->close();
      }
    });
  failed_ = false;
}

void DumpWriter::expect_whole() const
{
  if (failed_)
  {
    throw Error(
      "expected a writer whose frames are whole, got one that failed in a frame before", { path_ });
  }
}

void DumpWriter::write_rows(
  const FrameView& frame, FramePlan& plan, Notices& notices, Progress& progress)
{
  constexpr double share_of_sorting = 0.3;
  PartialProgress part(progress);
  std::optional<SortedRows> sorted;
  if (format_.sort_by_id && plan.columns.ids)
  {
    part.set_part(0, share_of_sorting);
    sorted.emplace(frame, plan, ranks_, file_->executor, part);
    part.set_part(share_of_sorting, 1);
  }
  const FrameView& view = sorted ? sorted->view() : frame;
  const auto rank = static_cast<std::size_t>(ranks_.rank());
  const std::int64_t before = sum_of(std::span(plan.kept_rows).first(rank));
  const bool own = is_name_of_ranks(path_);
  const std::vector<std::string> names = plan.columns.names();
  plan.header.rows = own ? plan.kept_rows[rank] : plan.header.rows;
  const ChunkLengths chunks = format_.binary
    ? ChunkLengths(plan.header.rows, static_cast<std::int64_t>(names.size()), format_.chunk_values)
    : ChunkLengths();
  const PrintLoss printed(plan.columns, plan.header.box, format_, plan.smallest_radius);
  const std::string header =
    encode_header(plan.header, names, format_, chunks, file_->first, printed.of_box());
  const RowsToEncode encoded{ view, plan.columns, plan.header.box, format_, chunks, before,
    own ? 0 : before, printed };
  RowBatches rows(encoded, file_->executor);

  agree(ranks_, nullptr); // or the first rank would wait for the rows of one that has failed
  SharedProgress shared(part, ranks_);
  if (file_->shared)
  {
    file_->share_rows(header, rows, chunks, plan.kept_rows, shared);
  }
  else
  {
    file_->gather_rows(header, rows, shared);
  }
  file_->first = false;
  RoundingLoss loss = add_ranks(rows.loss(), ranks_);
  loss.add_radius(plan.smallest_radius);
  told_loss_ = told_loss_ || note_print_loss(loss, plan.header.box, format_, plan.columns, notices);
}

void DumpWriter::finish()
{
  this->expect_whole();
  this->close();
  do_together(ranks_, [&] { held_.finish_all(is_durable(options_.durable, path_)); });
}

void DumpWriter::close()
{
  const bool durable = is_durable(options_.durable, path_);
  if (file_ && file_->shared)
  {
    file_->shared->finish(durable);
  }
  else if (file_)
  {
    do_together(ranks_,
      [&]
      {
        if (file_->own)
        {
          held_.finish(std::move(file_->own), durable);
        }
      });
  }
  file_.reset();
}
}
