// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/saved_index.h"

#include "granular/bytes/byte_sink.h"
#include "granular/common/hash.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
/// With a slash; empty if the user has none.
std::string cache_folder()
{
  constexpr std::pair<const char*, const char*> places[] = { { "XDG_CACHE_HOME", "/granular/" },
    { "HOME", "/.cache/granular/" } };
  for (const auto& [variable, below] : places)
  {
    const char* const value = std::getenv(variable);
    if (value != nullptr && value[0] == '/')
    {
      return std::string(value) + below;
    }
  }
  return {};
}

std::string path_in_cache(const std::string& first_file)
{
  constexpr std::size_t longest_name = 200; // of 255 that systems allow
  std::error_code error;
  const std::string absolute =
    std::filesystem::absolute(first_file, error).lexically_normal().string();
  const std::string folder = cache_folder();
  if (error || folder.empty())
  {
    return {};
  }
  Hash hash;
  hash.add(absolute.data(), absolute.size());
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4)
  {
    digits += "0123456789abcdef"[hash.value() >> shift & 15];
  }
  const std::string name = absolute.substr(absolute.rfind('/') + 1, longest_name);
  return folder + digits + "-" + name + std::string(index_file_suffix);
}

/// Returns true if a link, or a file that is no index, has the name: it may be anything that comes with a dump.
bool is_foreign(const std::string& path)
{
  std::error_code missing;
  const std::filesystem::file_status there = std::filesystem::symlink_status(path, missing);
  if (!std::filesystem::is_regular_file(there))
  {
    return std::filesystem::is_symlink(there);
  }
  char first[16];
  return !begins_as_index({ first, open_file(path)->read(0, first, sizeof first) });
}
}

std::string index_file_path(KeepIndex where, const std::string& first_file)
{
  if (where == KeepIndex::Never || first_file.empty())
  {
    return {};
  }
  return where == KeepIndex::Cache ? path_in_cache(first_file)
                                   : first_file + std::string(index_file_suffix);
}

std::vector<FileIndex> load_index(const std::string& path, const std::string& first_file,
  const std::shared_ptr<FrameKinds>& kinds, Notices& notices)
{
  std::string why;
  try
  {
    const std::unique_ptr<ByteSource> source = open_file(path);
    const auto size = static_cast<std::size_t>(source->stamp().size);
    const std::unique_ptr<char[]> bytes(new char[size]); // not value-initialised: it may be large
    std::vector<FileIndex> files =
      decode_index({ bytes.get(), source->read(0, bytes.get(), size) }, first_file, kinds);
    for (FileIndex& file : files)
    {
      if (file.frames.size() == 1)
      {
        file.points.reset(); // the end of the content is compared by who reads it: see no_points
      }
      if (file.points)
      {
        file.points->claimed = true;
      }
    }
    return files;
  }
  catch (const IoError& error)
  {
    if (error.code() == std::errc::no_such_file_or_directory ||
      error.code() == std::errc::not_a_directory)
    {
      return {};
    }
    why = "cannot be read: " + error.text();
  }
  catch (const UnsupportedError& error)
  {
    why = "is of another version: " + error.text();
  }
  catch (const FormatError& error)
  {
    why = "is damaged: " + error.text();
  }
  notices.push_back({ { path }, "the index file " + why + "; it is ignored" });
  return {};
}

void save_index(const std::string& path, const std::vector<FileIndex>& files, Notices& notices)
{
  if (std::ranges::all_of(files, [](const FileIndex& file) { return file.frames.empty(); }))
  {
    return;
  }
  if (path == index_file_path(KeepIndex::Cache, files.front().path))
  {
    std::error_code ignored; // without a folder the file cannot be written either
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (std::filesystem::create_directories(folder, ignored))
    {
      // what a user looks at is nobody else's business
      std::filesystem::permissions(folder, std::filesystem::perms::owner_all, ignored);
    }
  }
  try
  {
    if (is_foreign(path))
    {
      throw IoError("a link, or another file", { path }, std::errc::file_exists);
    }
    write_file(path, encode_index(files), false); // it can be made again
  }
  catch (const IoError& error)
  {
    notices.push_back({ { path },
      "cannot write the index file: " + std::make_error_code(error.code()).message() +
        "; the index is not kept" });
  }
}
}
