// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular.h for errors, runs and frames.
#include "guard.h"
#include "run.h"

#include <algorithm>
#include <utility>

using namespace granular_c;

namespace
{
/// The last error of a thread, which its strings are pointers into.
struct LastError
{
  std::string message, text, path, column;
  granular_error error = { GRANULAR_OK, "", "", "", 0, -1, "", 0, "" };

  granular_status set(granular_status status, std::string whole, const std::string& words,
    const granular::Where& where, int system_error = 0) noexcept
  try
  {
    message = std::move(whole);
    text = words;
    path = where.path;
    column = where.column;
    error = { status, message.c_str(), text.c_str(), path.c_str(), where.line, where.byte,
      column.c_str(), system_error, "" };
    return status;
  }
  catch (const std::exception&)
  {
    error = { status, "out of memory", "out of memory", "", 0, -1, "", 0, "" };
    return status;
  }
};

thread_local LastError last_error;

template <class Known>
bool is(const granular::Error& error) noexcept
{
  return dynamic_cast<const Known*>(&error) != nullptr;
}

granular_status status_of(const granular::Error& error) noexcept
{
  return is<granular::MemoryError>(error) ? GRANULAR_NO_MEMORY
    : is<granular::IoError>(error)        ? GRANULAR_IO_ERROR
    : is<granular::FormatError>(error)    ? GRANULAR_FORMAT_ERROR
    : is<granular::LimitError>(error)     ? GRANULAR_LIMIT_ERROR
    : is<granular::UnsupportedError>(error)
    ? GRANULAR_UNSUPPORTED
    : GRANULAR_BAD_ARGUMENT; // a choice, a format, a column or a frame
}

const FrameArray& array_at(const granular_frame& frame, std::size_t number)
{
  const std::size_t count = frame.arrays.size();
  if (number >= count)
  {
    throw granular::ArgumentError("expected an array from 0 to " + std::to_string(count) +
      " exclusive, got " + std::to_string(number));
  }
  return frame.arrays[number];
}

granular_array array_of(const granular_frame& frame, const FrameArray& array)
{
  return { array.name, static_cast<granular_type>(array.type), array.components, frame.table.rows,
    array.values->data(), array.word_list.empty() ? nullptr : array.word_list.data(),
    array.word_list.size(), array.known == nullptr ? "" : array.known->unit.data(),
    array.known == nullptr ? "" : array.known->meaning.data(), array.columns.c_str(),
    array.range.empty() ? nullptr : array.range.data() };
}
}

granular_status granular_c::keep_error(const granular::Error& error) noexcept
{
  try
  {
    const auto* const refused = dynamic_cast<const granular::IoError*>(&error);
    return last_error.set(status_of(error), error.what(), error.text(), error.where(),
      refused == nullptr ? 0 : static_cast<int>(refused->code()));
  }
  catch (const std::bad_alloc&)
  {
    return keep_error(GRANULAR_NO_MEMORY, "out of memory");
  }
}

granular_status granular_c::keep_error(granular_status status, const char* text) noexcept
{
  return last_error.set(status, text, text, {});
}

extern "C"
{
  // ---- errors ------------------------------------------------------------------------------------
  const granular_error* granular_last_error(void)
  {
    return &last_error.error;
  }

  const char* granular_version(void)
  {
    return GRANULAR_VERSION;
  }

  // ---- runs --------------------------------------------------------------------------------------
  granular_status granular_find_kind(const char* path, granular_kind* kind)
  {
    return guarded(
      [&]
      {
        const granular::Kind* const found = granular::find_kind(&needed(path, "a path"));
        needed(kind, "kind") =
          found == nullptr ? GRANULAR_KIND_AUTOMATIC : static_cast<granular_kind>(found->number);
      });
  }

  void granular_open_options_init(granular_open_options* options)
  {
    if (options != nullptr)
    {
      *options = {};
      options->size = sizeof(*options);
      options->kind = GRANULAR_KIND_AUTOMATIC;
      options->timestep_size = 1;
    }
  }

  granular_status granular_open(const char* const* paths, size_t count,
    const granular_open_options* options, granular_run** run)
  {
    return guarded(
      [&]
      {
        needed(run, "run") = nullptr;
        *run = new granular_run(texts_of(paths, count), taken(options, granular_open_options_init));
      });
  }

  void granular_close(granular_run* run)
  {
    delete run;
  }

  granular_status granular_refresh(
    granular_run* run, granular_progress progress, granular_notice notice, void* user)
  {
    return guarded(
      [&]
      {
        Caller caller(progress, notice, user);
        needed(run, "run").together(false, [&] { run->refresh(caller); });
      });
  }

  granular_status granular_run_info(granular_run* run, granular_run_facts* facts)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        const granular::Kind& kind = run->kind();
        needed(facts, "facts") = { static_cast<granular_kind>(kind.number),
          static_cast<std::int64_t>(run->index().size()),
          static_cast<std::int64_t>(run->index().files().size()), kind.has_bonds ? 2 : 1 };
      });
  }

  granular_status granular_frame_info(granular_run* run, int64_t frame, granular_frame_facts* facts)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        const std::size_t number = run->number_of(frame);
        std::int64_t rows = 0;
        for (const granular::FramePiece& piece : run->index().pieces(number))
        {
          rows += piece.entry.rows;
        }
        const granular::FramePiece first = run->index().first_piece(number);
        needed(facts, "facts") = { first.entry.timestep, run->times[number], rows,
          first.file.path.c_str() };
      });
  }

  granular_status granular_file_info(granular_run* run, int64_t file, granular_file_facts* facts)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        const auto& files = run->index().files();
        if (file < 0 || file >= static_cast<std::int64_t>(files.size()))
        {
          throw granular::ArgumentError("expected a file from 0 to " +
            std::to_string(files.size() - 1) + ", got " + std::to_string(file));
        }
        const auto number = static_cast<std::size_t>(file);
        const granular::FileIndex& index = files[number];
        const granular_run::LeftOut& left_out = run->left_out[number];
        needed(facts, "facts") = { index.path.c_str(), index.stamp.size,
          static_cast<std::int64_t>(index.frames.size()), left_out.repeated,
          left_out.defect.c_str() };
      });
  }

  granular_status granular_find_frame(granular_run* run, double time, int64_t* frame)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        needed(frame, "frame") =
          static_cast<std::int64_t>(granular::RunIndex::find(run->times, time));
      });
  }

  granular_status granular_arrays(granular_run* run, int64_t frame, int table,
    granular_array_facts* arrays, size_t most, size_t* count)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        const std::vector<granular::OfferedArray>& all = frame == GRANULAR_EVERY_FRAME
          ? *run->together(true, [&] { return &run->every_array(table); })
          : run->offer(run->number_of(frame), table).tables[static_cast<std::size_t>(table)];
        needed(count, "count") = all.size();
        for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
        {
          const granular::KnownColumn* known = all[i].known;
          (&needed(arrays, "arrays"))[i] = { all[i].name.c_str(),
            static_cast<granular_type>(all[i].type), all[i].components, all[i].is_usual ? 1 : 0,
            known == nullptr ? "" : known->unit.data(),
            known == nullptr ? "" : known->meaning.data(), all[i].columns.c_str() };
        }
      });
  }

  // ---- frames ------------------------------------------------------------------------------------
  void granular_request_init(granular_request* request)
  {
    if (request != nullptr)
    {
      *request = {};
      request->size = sizeof(*request);
      request->points = 1;
      const double region[] = { 1, -1, 1, -1, 1, -1 };
      std::memcpy(request->region, region, sizeof(region));
      request->stride = 1;
    }
  }

  granular_status granular_read(
    granular_run* run, int64_t frame, const granular_request* request, granular_frame** out)
  {
    return guarded(
      [&]
      {
        needed(out, "out") = nullptr;
        const std::shared_lock lock(needed(run, "run").mutex);
        *out = run
                 ->together(
                   true, [&] { return run->read(frame, taken(request, granular_request_init)); })
                 .release();
      });
  }

  granular_status granular_read_into(granular_run* run, int64_t frame,
    const granular_request* request, const granular_destination* destinations, size_t count,
    int64_t* rows)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        run->together(true,
          [&]
          {
            granular_request named = taken(request, granular_request_init);
            std::vector<const char*> names;
            for (std::size_t i = 0; i < count; ++i)
            {
              names.push_back(
                &needed((&needed(destinations, "destinations"))[i].array, "an array"));
            }
            named.arrays = names.data();
            named.array_count = names.size();
            const std::unique_ptr<granular_frame> read = run->read(frame, named);
            if (rows != nullptr)
            {
              *rows = read->table.rows;
            }
            for (std::size_t i = 0; i < count; ++i)
            {
              copy_array(*read, destinations[i]);
            }
          });
      });
  }

  void granular_release(granular_frame* frame)
  {
    delete frame;
  }

  granular_status granular_header(const granular_frame* frame, granular_frame_header* header)
  {
    return guarded([&] { needed(header, "header") = header_of(needed(frame, "frame")); });
  }

  granular_status granular_complete_box(granular_box* box)
  {
    return guarded(
      [&]
      {
        granular::FrameHeader header;
        header.box = make_box(needed(box, "box"));
        const granular_box made = box_of(header);
        std::copy_n(made.origin, 3, box->origin);
        std::copy_n(made.vectors, 9, box->vectors);
        std::copy_n(made.bounds, 9, box->bounds);
        box->has_bounds = made.has_bounds;
      });
  }

  granular_status granular_grids(const granular_frame* frame, granular_notice notice, void* user,
    granular_grid* grids, size_t most, size_t* count)
  {
    return guarded(
      [&]
      {
        granular::Notices notices;
        const std::vector<granular::RegularGrid> found =
          granular_c::find_grids(needed(frame, "frame"), notices);
        needed(count, "count") = found.size();
        for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
        {
          const granular::EulerGrid& from = found[i].grid;
          granular_grid& to = (&needed(grids, "grids"))[i];
          to.first = found[i].first;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            to.lo[axis] = from.lo[axis];
            to.hi[axis] = from.hi[axis];
            to.spacing[axis] = from.spacing(axis);
            to.counts[axis] = from.counts[axis];
          }
        }
        Caller(nullptr, notice, user).tell(notices);
      });
  }

  granular_status granular_array_at(
    const granular_frame* frame, size_t number, granular_array* array)
  {
    return guarded(
      [&]
      {
        const FrameArray& found = array_at(needed(frame, "frame"), number);
        needed(array, "array") = array_of(*frame, found);
      });
  }

  granular_status granular_take(granular_frame* frame, size_t number, void** data)
  {
    return guarded(
      [&]
      {
        const FrameArray& array = array_at(needed(frame, "frame"), number);
        void*& taken_data = needed(data, "data");
        taken_data = nullptr;
        expect_values(array);
        taken_data = array.values->release_malloc();
      });
  }

  granular_status granular_array_named(
    const granular_frame* frame, const char* name, granular_array* array)
  {
    return guarded(
      [&]
      {
        const granular_frame& from = needed(frame, "frame");
        const FrameArray& found = find_array(from, &needed(name, "a name"));
        needed(array, "array") = array_of(from, found);
      });
  }
}
