// SPDX-License-Identifier: BSD-3-Clause
// The functions of granular.h for writing, and for the names of files.
#include "guard.h"
#include "run.h"
#include "writer.h"

#include "granular/bytes/byte_sink.h"
#include "granular/bytes/find_files.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

using namespace granular_c;

struct granular_file
{
  granular::NewFile file;
  bool finished = false; ///< or has failed
};

struct granular_names
{
  std::vector<std::string> all;
};

namespace
{
/// Writes the view of a frame that the caller gives. Whatever fails, the file would lack a frame that the program wanted in it.
template <class Given, class ViewOf>
granular_status write_frame(
  granular_writer* writer, const Given* given, const char* name, const ViewOf& view_of)
{
  return guarded(
    [&]
    {
      const bool failed = writer != nullptr && std::exchange(writer->failed, true);
      needed(given, name);
      granular_writer& to = needed(writer, "writer");
      const WriteView frame = view_of();
      granular::Notices notices;
      ++to.frames;
      to.caller.begin();
      to.write(frame.view, notices, to.caller);
      to.caller.tell(notices);
      to.failed = failed;
    });
}

granular::NewFile& unfinished(granular_file* file)
{
  if (needed(file, "a file").finished)
  {
    throw granular::ArgumentError(
      "expected a file that is being written, got one that is finished");
  }
  return file->file;
}

}

extern "C"
{
  // ---- writing -----------------------------------------------------------------------------------
  void granular_format_init(granular_format* format)
  {
    if (format != nullptr)
    {
      *format = {};
      format->size = sizeof(*format);
      format->style = format->dialect = format->columns = format->numbers = format->label = "";
      format->scaled = 1;
      format->durable = static_cast<int>(granular::Durability::Automatic);
    }
  }

  granular_status granular_create(
    const char* path, const granular_format* format, granular_writer** writer)
  {
    return guarded(
      [&]
      {
        needed(writer, "writer") = nullptr;
        *writer = create_writer(
          granular::with_slashes(&needed(path, "a path")), taken(format, granular_format_init))
                    .release();
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
    return write_frame(writer, content, "content",
      [&] { return WriteView(taken(content, granular_content_init), writer->kind); });
  }

  granular_status granular_add_input(granular_writer* writer, granular_run* run)
  {
    return guarded(
      [&]
      {
        const std::shared_lock lock(needed(run, "a run").mutex);
        needed(writer, "writer").add_inputs(run->shared_index);
      });
  }

  granular_status granular_write_frame(granular_writer* writer, const granular_frame* frame)
  {
    return write_frame(writer, frame, "frame",
      [&]
      {
        if (writer->kind != frame->kind)
        {
          constexpr std::array<const char*, 4> names = { "particles", "lines", "cells",
            "subdomains" };
          throw granular::ArgumentError(std::string("expected a frame of ") +
            names[static_cast<std::size_t>(writer->kind)] + " for this style, got one of " +
            names[static_cast<std::size_t>(frame->kind)]);
        }
        writer->add_inputs(frame->index);
        return WriteView(*frame);
      });
  }

  granular_status granular_finish(granular_writer* writer)
  {
    return guarded(
      [&]
      {
        const std::unique_ptr<granular_writer> own(&needed(writer, "writer"));
        own->expect_frames();
        own->finish();
      });
  }

  void granular_abandon(granular_writer* writer)
  {
    delete writer;
  }

  // ---- files that a program writes itself --------------------------------------------------------
  granular_status granular_begin_file(const char* path, granular_file** file)
  {
    return guarded(
      [&]
      {
        needed(file, "file") = nullptr;
        *file = new granular_file{ granular::NewFile(
          &needed(path, "a path"), granular::Locking::Others) };
      });
  }

  const char* granular_file_name(const granular_file* file)
  {
    return file == nullptr ? nullptr : file->file.temporary_name().c_str();
  }

  granular_status granular_hold_file(granular_file* file, int durable)
  {
    return guarded([&] { unfinished(file).hold(durable != 0); });
  }

  granular_status granular_finish_files(granular_file* const* files, size_t count, int durable)
  {
    return guarded(
      [&]
      {
        const std::span all(count > 0 ? &needed(files, "files") : nullptr, count);
        std::ranges::for_each(all, [](granular_file* each) { unfinished(each).expect_name(); });
        for (granular_file* const each : all)
        {
          granular::NewFile& file = unfinished(each);
          each->finished = true;
          file.finish(durable != 0);
        }
      });
  }

  void granular_close_file(granular_file* file)
  {
    delete file;
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
