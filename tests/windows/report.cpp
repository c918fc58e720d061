// SPDX-License-Identifier: BSD-3-Clause
// report FOLDER FILE...: prints what the C library reads of files, makes of them by filters, and writes into a folder, as sums of the
// bytes. The report of Windows is that of Linux: see packaging/windows.
#include "granular_filters.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace
{
/// FNV-1a.
std::uint64_t sum_of(const void* data, std::size_t bytes, std::uint64_t sum = 0xcbf29ce484222325)
{
  for (std::size_t i = 0; i < bytes; ++i)
  {
    sum = (sum ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3;
  }
  return sum;
}

std::size_t size_of(granular_type type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 4 };
  return sizes[type];
}

/// Returns true if a call was successful. Prints the error otherwise.
bool done(granular_status status)
{
  if (status != GRANULAR_OK)
  {
    const granular_error& error = *granular_last_error();
    std::printf("    error %d %d: %s\n", status, error.system_error, error.text);
  }
  return status == GRANULAR_OK;
}

/// A frame with its arrays, as content for a writer or a filter.
struct Frame
{
  granular_frame* frame = nullptr;
  granular_frame_header header = {};
  std::vector<granular_array> arrays;
  granular_content content = {};

  explicit Frame(granular_frame* made)
    : frame(made)
  {
    granular_header(frame, &header);
    arrays.resize(header.arrays);
    for (std::size_t i = 0; i < arrays.size(); ++i)
    {
      granular_array_at(frame, i, &arrays[i]);
    }
    granular_content_init(&content);
    content.timestep = header.timestep;
    content.time = header.time;
    content.has_time = header.has_time;
    content.box = header.has_box != 0 ? &header.box : nullptr;
    content.rows = header.rows;
    content.arrays = arrays.data();
    content.array_count = arrays.size();
    content.header = &header;
  }
  Frame(const Frame&) = delete;
  ~Frame() { granular_release(frame); }

  void print() const
  {
    std::printf("    step %" PRId64 " time %a rows %" PRId64 " box %016" PRIx64 " %s\n",
      header.timestep, header.time, header.rows,
      sum_of(&header.box.bounds, sizeof header.box.bounds), header.columns);
    for (const granular_array& array : arrays)
    {
      std::uint64_t sum = sum_of(
        array.data, static_cast<std::size_t>(array.rows * array.components) * size_of(array.type));
      for (std::size_t i = 0; i < array.word_count; ++i)
      {
        sum = sum_of(array.words[i], std::strlen(array.words[i]), sum);
      }
      std::printf(
        "      %s %d x %d: %016" PRIx64 "\n", array.name, array.type, array.components, sum);
    }
  }
};

void print_file(const std::string& path)
{
  granular_bytes* bytes = nullptr;
  if (!done(granular_open_bytes(path.c_str(), &bytes)))
  {
    return;
  }
  std::vector<char> buffer(1 << 20);
  std::size_t got = buffer.size();
  std::size_t all = 0;
  std::uint64_t sum = sum_of(nullptr, 0);
  int is_cut = 0;
  while (got == buffer.size() &&
    done(granular_read_bytes(bytes, buffer.data(), buffer.size(), &got, &is_cut)))
  {
    sum = sum_of(buffer.data(), got, sum);
    all += got;
  }
  granular_close_bytes(bytes);
  std::printf(
    "    wrote %s: %zu bytes %016" PRIx64 "\n", path.substr(path.rfind('/') + 1).c_str(), all, sum);
}

/// Writes a frame in the ways that its kind may have.
void write(const Frame& frame, const std::string& folder)
{
  for (const char* ending :
    { ".dump", ".dump.gz", ".dump.zst", ".bin", ".bonds", ".euler", ".decomposition", ".vtu" })
  {
    const std::string path =
      folder + "/\u043a\u0430\u0434\u0440_*" + ending; // letters that no code page of the West has
    granular_writer* writer = nullptr;
    if (done(granular_create(path.c_str(), nullptr, &writer)))
    {
      if (!done(granular_write_frame(writer, frame.frame)))
      {
        granular_abandon(writer);
      }
      else if (done(granular_finish(writer)))
      {
        print_file(
          folder + "/\u043a\u0430\u0434\u0440_" + std::to_string(frame.header.timestep) + ending);
      }
    }
  }
}

int give(std::size_t port, std::size_t, const granular_content** content, const char**, void* user)
{
  *content = port == 0 ? static_cast<const granular_content*>(user) : nullptr;
  return 0;
}

void apply(
  const char* filter, std::vector<granular_setting> settings, const granular_content* input)
{
  granular_task task;
  granular_task_init(&task);
  task.filter = filter;
  task.settings = settings.data();
  task.setting_count = settings.size();
  task.input = give;
  task.user = const_cast<granular_content*>(input);
  granular_frame* results[GRANULAR_MOST_RESULTS] = {};
  std::size_t count = 0;
  std::printf("    %s\n", filter);
  done(granular_apply(&task, results, GRANULAR_MOST_RESULTS, &count));
  for (std::size_t i = 0; i < count; ++i)
  {
    Frame(results[i]).print();
  }
}

void read(granular_run* run, int table, const std::string& folder)
{
  granular_request request;
  granular_request_init(&request);
  request.table = table;
  granular_frame* made = nullptr;
  granular_run_facts facts;
  granular_run_info(run, &facts);
  for (std::int64_t i = 0; i < facts.frames && i < 3; ++i)
  {
    std::printf("  table %d frame %" PRId64 "\n", table, i);
    if (!done(granular_read(run, i, &request, &made)))
    {
      continue;
    }
    const Frame frame(made);
    frame.print();
    write(frame, folder);
    if (facts.kind == GRANULAR_KIND_DUMP)
    {
      apply("GranularDecomposition", {}, &frame.content);
      const double none = 0; // no kernel: exp, erf and asin are the system's
      apply("GranularEulerAverage", { { "Weights", nullptr, &none, 1 } }, &frame.content);
      for (const granular_coordinates form :
        { GRANULAR_SCALED, GRANULAR_UNWRAPPED, GRANULAR_ABSOLUTE })
      {
        request.coordinates = form;
        if (done(granular_read(run, i, &request, &made)))
        {
          Frame(made).print();
        }
      }
    }
  }
}
}

int main(int count, char** words)
{
  apply("GranularDecompositionSource", {}, nullptr);
  for (int i = 2; i < count; ++i)
  {
    std::printf("%s\n", words[i]);
    granular_run* run = nullptr;
    if (done(granular_open(words + i, 1, nullptr, &run)))
    {
      granular_run_facts facts;
      granular_run_info(run, &facts);
      std::printf(
        "  kind %d frames %" PRId64 " tables %d\n", facts.kind, facts.frames, facts.tables);
      for (int table = 0; table < facts.tables; ++table)
      {
        read(run, table, words[1]);
      }
    }
    granular_close(run);
  }
  return 0;
}
