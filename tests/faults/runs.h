// SPDX-License-Identifier: BSD-3-Clause
// A file of each kind, and everything that the C interface reads and writes of a run.
#ifndef granular_tests_faults_runs_h
#define granular_tests_faults_runs_h

#include "../c/handles.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace runs
{
namespace fs = std::filesystem;

/// A kind of files, with a small file of a real run.
struct Kind
{
  const char* name;
  const char* file;
  const char* ending;
  granular_kind kind;
};

constexpr Kind kinds[] = {
  { "text", "grains_1000.dump", ".dump", GRANULAR_KIND_DUMP },
  { "binary", "ortho_custom.bin", ".bin", GRANULAR_KIND_DUMP },
  { "gzip", "ortho_000000.dump.gz", ".dump.gz", GRANULAR_KIND_DUMP },
  { "Zstandard", "", ".dump.zst", GRANULAR_KIND_DUMP }, // written from the first
  { "contacts", "local/contacts.dump", ".dump", GRANULAR_KIND_LOCAL },
  { "restart", "restart/style_sphere.restart", ".restart", GRANULAR_KIND_RESTART },
  { "data file", "data_file/granular.data", ".data", GRANULAR_KIND_DATA_FILE },
  { "cells", "euler_1000.vtk", ".vtk", GRANULAR_KIND_EULER },
  { "subdomains", "decomposition_1000.vtk", ".vtk", GRANULAR_KIND_DECOMPOSITION },
};

/// A status, and all values of a run, or the message.
struct Seen
{
  granular_status status = GRANULAR_OK;
  std::string text;

  bool operator==(const Seen&) const = default;
};

/// For messages of tests, which show the beginning.
inline std::ostream& operator<<(std::ostream& out, const Seen& seen)
{
  return out << "status " << seen.status << ": " << seen.text.substr(0, 300);
}

inline Seen failed(granular_status status)
{
  return { status, message() };
}

/// Calls add(bytes, count) for the name, the size and the values of an array.
template <class Add>
void visit_values(const granular_array& array, const Add& add)
{
  static constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 4 };
  add(array.name, std::strlen(array.name) + 1);
  add(&array.rows, sizeof array.rows);
  if (array.rows > 0)
  {
    add(array.data, sizes[array.type] * static_cast<std::size_t>(array.rows * array.components));
  }
  for (std::size_t i = 0; i < array.word_count; ++i)
  {
    add(array.words[i], std::strlen(array.words[i]) + 1);
  }
}

/// Calls use(frame) for each frame of a run, or for each of its tables, until one fails. Needs no memory but that of the interface,
/// which lets no exception out.
template <class Use>
granular_status for_each_frame(
  granular_run* run, granular_request request, bool all_tables, const Use& use) noexcept
{
  granular_run_facts facts = {};
  granular_status status = granular_run_info(run, &facts);
  const int tables = all_tables ? facts.tables : 1;
  for (std::int64_t i = 0; status == GRANULAR_OK && i < facts.frames * tables; ++i)
  {
    granular_frame* read = nullptr;
    request.table = static_cast<int>(i % tables);
    status = granular_read(run, i / tables, &request, &read);
    const FrameHandle frame(read, granular_release);
    status = status == GRANULAR_OK ? use(read) : status;
  }
  return status;
}

/// Reads all arrays of all frames of a run, as above; not headers, where timesteps of some kinds are from the names of files.
template <class Add>
granular_status visit(granular_run* run, const granular_request& request, const Add& add) noexcept
{
  const auto visit_frame = [&](const granular_frame* frame)
  {
    granular_frame_header header = {};
    granular_status status = granular_header(frame, &header);
    for (std::size_t i = 0; status == GRANULAR_OK && i < header.arrays; ++i)
    {
      granular_array array = {};
      status = granular_array_at(frame, i, &array);
      if (status == GRANULAR_OK)
      {
        visit_values(array, add);
      }
    }
    return status;
  };
  return for_each_frame(run, request, true, visit_frame);
}

inline granular_open_options options_of(granular_kind kind, int threads)
{
  granular_open_options options;
  granular_open_options_init(&options);
  options.kind = kind;
  options.threads = threads;
  return options;
}

inline granular_request request_of(int threads)
{
  granular_request request;
  granular_request_init(&request);
  request.threads = threads;
  return request;
}

/// Opens a run and reads it, as above.
template <class Add>
granular_status visit(
  const char* pattern, const granular_open_options& options, const Add& add) noexcept
{
  granular_run* opened = nullptr;
  const granular_status status = granular_open(&pattern, 1, &options, &opened);
  const RunHandle run(opened, granular_close);
  return status == GRANULAR_OK ? visit(opened, request_of(options.threads), add) : status;
}

/// Returns the values of all frames and arrays of a run.
inline Seen look(
  const std::string& pattern, granular_kind kind = GRANULAR_KIND_AUTOMATIC, int threads = 2)
{
  Seen seen;
  const granular_status status = visit(pattern.c_str(), options_of(kind, threads),
    [&](const void* bytes, std::size_t count)
    { seen.text.append(static_cast<const char*>(bytes), count); });
  return status == GRANULAR_OK ? seen : failed(status);
}

/// Writes the frames of one run into the file of another name. As `visit`.
inline granular_status convert_file(const char* from, const char* to, int threads) noexcept
{
  granular_run* opened = nullptr;
  if (const granular_status status = granular_open(&from, 1, nullptr, &opened))
  {
    return status;
  }
  const RunHandle run(opened, granular_close);
  granular_format format;
  granular_format_init(&format);
  format.threads = threads;
  granular_writer* writer = nullptr;
  if (const granular_status status = granular_create(to, &format, &writer))
  {
    return status;
  }
  const granular_status status = for_each_frame(opened, request_of(threads), false,
    [&](const granular_frame* frame) { return granular_write_frame(writer, frame); });
  if (status != GRANULAR_OK)
  {
    granular_abandon(writer); // which keeps the last error
    return status;
  }
  return granular_finish(writer);
}

inline Seen convert(const std::string& from, const std::string& to, int threads = 2)
{
  const granular_status status = convert_file(from.c_str(), to.c_str(), threads);
  return status == GRANULAR_OK ? Seen{} : failed(status);
}

/// The frames of a run, read once, to be written again and again.
class Frames
{
public:
  explicit Frames(const std::string& path)
    : run_(open_run(path))
  {
    granular_run_facts facts = {};
    EXPECT_EQ(granular_run_info(run_.get(), &facts), GRANULAR_OK) << message();
    for (std::int64_t number = 0; number < facts.frames; ++number)
    {
      frames_.push_back(read_frame(run_, number));
    }
  }

  granular_status write(const std::string& path, const granular_format& format) const
  {
    granular_writer* writer = nullptr;
    granular_status status = granular_create(path.c_str(), &format, &writer);
    if (status != GRANULAR_OK)
    {
      return status;
    }
    for (const FrameHandle& frame : frames_)
    {
      status = granular_write_frame(writer, frame.get());
      if (status != GRANULAR_OK)
      {
        granular_abandon(writer); // which keeps the last error
        return status;
      }
    }
    return granular_finish(writer);
  }

private:
  RunHandle run_;
  std::vector<FrameHandle> frames_;
};

/// A file to write: the kind, the file of a real run that its frames come from, and its ending.
struct Output
{
  const char* name;
  const char* file;
  const char* ending;
};

constexpr Output outputs[] = {
  { "text", "grains_1000.dump", ".dump" },
  { "gzip", "grains_1000.dump", ".dump.gz" },
  { "Zstandard", "grains_1000.dump", ".dump.zst" },
  { "binary", "grains_1000.dump", ".bin" },
  { "contacts", "local/contacts.dump", ".bonds" },
  { "cells", "euler_1000.vtk", ".euler" },
  { "subdomains", "decomposition_1000.vtk", ".decomposition" },
};

/// The names and contents of all files of a folder, hidden ones too.
inline std::map<std::string, std::string> files_of(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    files[entry.path().filename()] =
      fs::is_regular_file(entry.symlink_status()) ? content(entry.path()) : "";
  }
  return files;
}

/// The file of a kind. That of Zstandard is written here.
inline std::string file_of(const Kind& kind)
{
  if (*kind.file != '\0')
  {
    return good(kind.file);
  }
  const std::string path = std::string(GRANULAR_OUTPUT) + "/source" + kind.ending;
  if (!fs::exists(path))
  {
    EXPECT_EQ(convert(good(kinds[0].file), path).status, GRANULAR_OK) << message();
  }
  return path;
}
}

#endif
