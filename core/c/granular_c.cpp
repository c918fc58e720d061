// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular.h. Each runs in a guard that turns exceptions into a status and the last error of the thread.
#include "bad_argument.h"
#include "granular.h"
#include "run.h"
#include "writer.h"

#include "granular/bytes/find_files.h"

#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

using namespace granular_c;

struct granular_names
{
  std::vector<std::string> all;
};

namespace
{
/// The last error of a thread, which its strings are pointers into.
struct LastError
{
  std::string message, text, path, column;
  granular_error error = { GRANULAR_OK, "", "", "", 0, -1, "" };

  granular_status set(granular_status status, std::string whole, const std::string& words,
    const granular::Where& where) noexcept
  try
  {
    message = std::move(whole);
    text = words;
    path = where.path;
    column = where.column;
    error = { status, message.c_str(), text.c_str(), path.c_str(), where.line, where.byte,
      column.c_str() };
    return status;
  }
  catch (const std::exception&)
  {
    error = { status, "out of memory", "out of memory", "", 0, -1, "" };
    return status;
  }
};

thread_local LastError last_error;

granular_status status_of(const granular::Error& error) noexcept
{
  if (dynamic_cast<const BadArgument*>(&error) != nullptr)
  {
    return GRANULAR_BAD_ARGUMENT;
  }
  if (dynamic_cast<const granular::IoError*>(&error) != nullptr)
  {
    return GRANULAR_IO_ERROR;
  }
  if (dynamic_cast<const granular::FormatError*>(&error) != nullptr)
  {
    return GRANULAR_FORMAT_ERROR;
  }
  if (dynamic_cast<const granular::LimitError*>(&error) != nullptr)
  {
    return GRANULAR_LIMIT_ERROR;
  }
  return dynamic_cast<const granular::UnsupportedError*>(&error) != nullptr
    ? GRANULAR_UNSUPPORTED
    : GRANULAR_BAD_ARGUMENT; // of a format, a column or a frame that cannot be
}

/// Runs the body of a function.
template <class Body>
granular_status guarded(Body&& body) noexcept
{
  try
  {
    body();
    return GRANULAR_OK;
  }
  catch (const granular::Error& error)
  {
    return last_error.set(status_of(error), error.what(), error.text(), error.where());
  }
  catch (const granular::Cancelled&)
  {
    return last_error.set(GRANULAR_CANCELLED, "cancelled", "cancelled", {});
  }
  catch (const std::bad_alloc&)
  {
    return last_error.set(GRANULAR_NO_MEMORY, "out of memory", "out of memory", {});
  }
  catch (const std::exception& error)
  {
    return last_error.set(GRANULAR_OTHER_ERROR, error.what(), error.what(), {});
  }
  catch (...)
  {
    return last_error.set(GRANULAR_OTHER_ERROR, "unknown error", "unknown error", {});
  }
}

template <class Pointer>
Pointer& needed(Pointer* pointer, const char* name)
{
  if (pointer == nullptr)
  {
    throw BadArgument(std::string("expected ") + name + ", got null");
  }
  return *pointer;
}

/// The caller's struct, which may be of an earlier version and shorter, over the defaults.
template <class Struct>
Struct taken(const Struct* given, void (*init)(Struct*))
{
  Struct made;
  init(&made);
  if (given != nullptr)
  {
    if (given->size < sizeof(std::size_t) || given->size > sizeof(Struct))
    {
      throw BadArgument("expected a struct of up to " + std::to_string(sizeof(Struct)) +
        " bytes that its init function has filled, got size " + std::to_string(given->size));
    }
    std::memcpy(&made, given, given->size);
  }
  return made;
}

std::vector<std::string> texts_of(const char* const* texts, std::size_t count)
{
  std::vector<std::string> made;
  for (std::size_t i = 0; i < count; ++i)
  {
    made.emplace_back(&needed((&needed(texts, "names"))[i], "a name"));
  }
  if (made.empty())
  {
    throw BadArgument("expected at least one name, got none");
  }
  return made;
}

granular_array array_of(const granular_frame& frame, const FrameArray& array)
{
  return { array.name.c_str(), static_cast<granular_type>(array.type), array.components, frame.rows,
    array.data, array.word_list.empty() ? nullptr : array.word_list.data(), array.word_list.size(),
    array.known == nullptr ? "" : array.known->unit.data(),
    array.known == nullptr ? "" : array.known->meaning.data() };
}
}

extern "C"
{
  const granular_error* granular_last_error(void)
  {
    return &last_error.error;
  }

  const char* granular_version(void)
  {
    return GRANULAR_VERSION;
  }

  // ---- runs --------------------------------------------------------------------------------------
  void granular_open_options_init(granular_open_options* options)
  {
    if (options != nullptr)
    {
      *options = { sizeof(*options), GRANULAR_KIND_AUTOMATIC, 1, "", "", "", "", 0, 0, 0, nullptr,
        nullptr, nullptr };
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

  granular_status granular_refresh(granular_run* run)
  {
    return guarded(
      [&]
      {
        Caller nobody(nullptr, nullptr, nullptr);
        needed(run, "run").refresh(nobody);
      });
  }

  granular_status granular_run_info(granular_run* run, granular_run_facts* facts)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "run").mutex);
        const Kind& kind = run->kind();
        needed(facts, "facts") = { kind.kind, static_cast<std::int64_t>(run->index.size()),
          static_cast<std::int64_t>(run->index.files().size()), kind.has_bonds ? 2 : 1 };
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
        for (const granular::FramePiece& piece : run->index.pieces(number))
        {
          rows += piece.entry.rows;
        }
        const granular::FramePiece first = run->index.first_piece(number);
        needed(facts, "facts") = { first.entry.timestep, run->times[number], rows,
          first.file.path.c_str() };
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
        const std::vector<OfferedArray>& all = run->arrays(run->number_of(frame), table);
        needed(count, "count") = all.size();
        for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
        {
          const granular::KnownColumn* known = all[i].known;
          (&needed(arrays, "arrays"))[i] = { all[i].name.c_str(),
            static_cast<granular_type>(all[i].type), all[i].components, all[i].is_usual ? 1 : 0,
            known == nullptr ? "" : known->unit.data(),
            known == nullptr ? "" : known->meaning.data() };
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
      request->stride = 1;
      const double everywhere[] = { 1, -1, 1, -1, 1, -1 };
      std::memcpy(request->region, everywhere, sizeof(everywhere));
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
        const Wanted wanted(taken(request, granular_request_init));
        Caller caller(wanted.request.progress, wanted.request.notice, wanted.request.user);
        *out = run->read(run->number_of(frame), wanted, caller).release();
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
        granular_request named = taken(request, granular_request_init);
        std::vector<const char*> names;
        for (std::size_t i = 0; i < count; ++i)
        {
          names.push_back(&needed((&needed(destinations, "destinations"))[i].array, "an array"));
        }
        named.arrays = names.data();
        named.array_count = names.size();
        const Wanted wanted(named);
        Caller caller(named.progress, named.notice, named.user);
        const std::unique_ptr<granular_frame> read =
          run->read(run->number_of(frame), wanted, caller);
        if (rows != nullptr)
        {
          *rows = read->rows;
        }
        for (std::size_t i = 0; i < count; ++i)
        {
          copy_array(*read, destinations[i]);
        }
      });
  }

  void granular_release(granular_frame* frame)
  {
    delete frame;
  }

  granular_status granular_header(const granular_frame* frame, granular_frame_header* header)
  {
    return guarded(
      [&]
      {
        const granular::FrameHeader& from = needed(frame, "frame").header;
        granular_frame_header made = {};
        made.timestep = from.timestep;
        made.has_time = from.time ? 1 : 0;
        made.time = from.time ? *from.time : frame->time;
        made.rows = frame->rows;
        made.has_box = from.has_box ? 1 : 0;
        made.box = box_of(from);
        made.coordinates = static_cast<granular_coordinates>(frame->coordinates);
        std::copy_n(frame->origin.begin(), 3, made.origin);
        made.label = from.label.c_str();
        made.units = from.units.c_str();
        made.columns = frame->column_text.c_str();
        made.dialect = !from.dialect                   ? ""
          : *from.dialect == granular::Dialect::Lammps ? "LAMMPS"
                                                       : "LIGGGHTS";
        made.arrays = frame->arrays.size();
        needed(header, "header") = made;
      });
  }

  granular_status granular_array_at(
    const granular_frame* frame, size_t number, granular_array* array)
  {
    return guarded(
      [&]
      {
        const std::size_t count = needed(frame, "frame").arrays.size();
        if (number >= count)
        {
          throw BadArgument("expected an array from 0 to " + std::to_string(count) +
            " exclusive, got " + std::to_string(number));
        }
        needed(array, "array") = array_of(*frame, frame->arrays[number]);
      });
  }

  granular_status granular_array_named(
    const granular_frame* frame, const char* name, granular_array* array)
  {
    return guarded(
      [&]
      {
        needed(array, "array") =
          array_of(needed(frame, "frame"), find_array(*frame, &needed(name, "a name")));
      });
  }

  // ---- writing -----------------------------------------------------------------------------------
  void granular_format_init(granular_format* format)
  {
    if (format != nullptr)
    {
      *format = {};
      format->size = sizeof(*format);
      format->style = format->dialect = format->columns = format->numbers = format->label = "";
      format->scaled = 1;
    }
  }

  granular_status granular_create(
    const char* path, const granular_format* format, granular_writer** writer)
  {
    return guarded(
      [&]
      {
        needed(writer, "writer") = nullptr;
        *writer =
          create_writer(&needed(path, "a path"), taken(format, granular_format_init)).release();
      });
  }

  void granular_content_init(granular_content* content)
  {
    if (content != nullptr)
    {
      *content = {};
      content->size = sizeof(*content);
      content->units = "";
    }
  }

  granular_status granular_write(granular_writer* writer, const granular_content* content)
  {
    return guarded(
      [&]
      {
        const granular_content given = taken(&needed(content, "content"), granular_content_init);
        const WriteView frame(given, needed(writer, "writer").kind);
        granular::Notices notices;
        writer->caller.begin();
      writer->write(frame.view, notices, writer->caller);
        writer->caller.tell(notices);
      });
  }

  granular_status granular_write_frame(granular_writer* writer, const granular_frame* frame)
  {
    return guarded(
      [&]
      {
        const WriteView view(needed(frame, "frame"));
        granular::Notices notices;
        needed(writer, "writer").caller.begin();
      writer->write(view.view, notices, writer->caller);
        writer->caller.tell(notices);
      });
  }

  granular_status granular_finish(granular_writer* writer)
  {
    return guarded(
      [&]
      {
        const std::unique_ptr<granular_writer> own(&needed(writer, "writer"));
        own->finish();
      });
  }

  void granular_abandon(granular_writer* writer)
  {
    delete writer;
  }

  // ---- files -------------------------------------------------------------------------------------
  granular_status granular_find_files(
    const char* const* patterns, size_t count, granular_names** names)
  {
    return guarded(
      [&]
      {
        needed(names, "names") = nullptr;
        *names = new granular_names{ granular::find_files(texts_of(patterns, count)) };
      });
  }

  size_t granular_name_count(const granular_names* names)
  {
    return names == nullptr ? 0 : names->all.size();
  }

  const char* granular_name_at(const granular_names* names, size_t number)
  {
    return names == nullptr || number >= names->all.size() ? nullptr : names->all[number].c_str();
  }

  void granular_free_names(granular_names* names)
  {
    delete names;
  }
}
