// SPDX-License-Identifier: BSD-3-Clause
// Files of every kind where the system gives little: open files, memory, threads, stacks; and in locales with a decimal comma.
// GRANULAR_PLACES: the number of files of a series; also of limits of memory, a fiftieth.
#include "places.h"

#include "../support/apart.h"
#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <set>

#include <pthread.h>
#include <sys/resource.h>

using namespace places;

namespace
{
class PlacesLimits : public OwnFolder
{
};

/// The number of files of a series. The long form tries more.
int files_of_series()
{
  const char* const wanted = std::getenv("GRANULAR_PLACES");
  return wanted == nullptr ? 300 : std::atoi(wanted);
}

void limit(__rlimit_resource what, rlim_t most)
{
  const rlimit both = { most, most };
  ::setrlimit(what, &both);
}

/// A thread with a small stack; those that it starts have one as small.
template <class Function>
void with_stack(std::size_t bytes, const Function& function)
{
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, bytes);
  ::pthread_setattr_default_np(&attributes);
  pthread_t thread = {};
  ASSERT_EQ(::pthread_create(
              &thread, &attributes,
              [](void* called) -> void*
              {
                (*static_cast<const Function*>(called))();
                return nullptr;
              },
              const_cast<Function*>(&function)),
    0);
  ::pthread_join(thread, nullptr);
}

/// Takes the pages of the stack that calls need later: the system kills a process that it cannot give them.
[[gnu::noinline]] void grow_stack()
{
  volatile char pages[1 << 20];
  for (std::size_t i = 0; i < sizeof(pages); i += 1024)
  {
    pages[i] = 'x';
  }
}

/// Reads all kinds and writes all outputs, on several threads. Returns the words for what came of each.
std::string use_everything(const std::string& folder, int threads)
{
  std::string said;
  for (const Kind& kind : kinds)
  {
    const std::string path = folder + "/" + kind.name + kind.ending; // an index is kept beside it
    std::error_code failed;
    fs::copy_file(file_of(kind), path, fs::copy_options::skip_existing, failed);
    const Seen seen = look(path, kind.kind, 2, threads);
    said += seen.status == GRANULAR_OK ? "" : std::string(kind.name) + ": " + seen.text + "\n";
  }
  for (const Output& output : outputs)
  {
    const Seen seen = convert(good(output.file), folder + "/new" + output.ending, threads);
    said += seen.status == GRANULAR_OK ? "" : std::string(output.name) + ": " + seen.text + "\n";
  }
  return said;
}

/// The files that `use_everything` writes.
std::string written(const std::string& folder)
{
  std::string all;
  for (const Output& output : outputs)
  {
    all += content(folder + "/new" + output.ending);
  }
  return all;
}

/// A task with more rows than a chunk holds, so that all threads have some.
std::string large_dump(const std::string& path)
{
  std::ofstream file(path);
  constexpr int rows = 100'000;
  file << "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n"
       << rows << "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z radius\n";
  for (int i = 0; i < rows; ++i)
  {
    file << i + 1 << " 1 0." << i % 977 << " 0." << i % 991 << " 0." << i % 997 << " 0.001\n";
  }
  return path;
}

/// Whether the system knows a locale; else it is made in a folder.
bool set_locale(const std::string& name, const std::string& folder)
{
  const std::string made = folder + "/" + name;
  const std::string command =
    "localedef -i " + name.substr(0, 5) + " -f UTF-8 '" + made + "' 2> /dev/null";
  if (std::system(command.c_str()) != 0 && !fs::exists(made))
  {
    return false;
  }
  ::setenv("LOCPATH", folder.c_str(), 1);
  return std::setlocale(LC_ALL, name.c_str()) != nullptr;
}
}

/// A series of many more files than a process may have open.
TEST_F(PlacesLimits, FewOpenFiles)
{
  const int count = files_of_series();
  for (const Kind& kind : kinds)
  {
    SCOPED_TRACE(kind.name);
    const std::string folder = this->path(kind.name);
    fs::create_directory(folder);
    const bool is_text = kind.kind == GRANULAR_KIND_DUMP && std::string(kind.ending) == ".dump";
    for (int i = 0; i < count; ++i)
    {
      const std::string path = folder + "/s_" + std::to_string(i) + kind.ending;
      if (is_text)
      {
        std::ofstream(path)
          << "ITEM: TIMESTEP\n"
          << i
          << "\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
             "ITEM: ATOMS id x y z\n"
          << i << " 0.1 0.2 0.3\n";
      }
      else
      {
        fs::create_symlink(file_of(kind), path);
      }
    }
    const std::string pattern = folder + "/s_*" + kind.ending;
    const Seen free = look(pattern, kind.kind, 0, 4);
    ASSERT_EQ(free.status, GRANULAR_OK) << free;
    const Ended ended = run_apart(
      [&]
      {
        limit(RLIMIT_NOFILE, 64);
        for (int keep_index : { 0, 2, 2 })
        {
          const Seen seen = look(pattern, kind.kind, keep_index, 4);
          if (seen != free)
          {
            return seen.text.substr(0, 300);
          }
        }
        const Seen seen = is_text ? convert(pattern, folder + "/all.dump.gz", 4) : Seen{};
        return seen.status == GRANULAR_OK ? std::string() : seen.text;
      });
    EXPECT_EQ(ended.how + " " + ended.text, "done ");
    if (is_text)
    {
      EXPECT_EQ(look(folder + "/all.dump.gz", kind.kind), free);
    }
    fs::remove_all(folder);
  }
}

/// Where none is left, that is the message, and not that there is no file.
TEST_F(PlacesLimits, NoOpenFiles)
{
  const std::string pattern = good("grains_*.dump");
  const Ended ended = run_apart(
    [&]
    {
      limit(RLIMIT_NOFILE, 0);
      return look(pattern).text + "\n" + convert(good("grains.dump"), this->path("new.dump")).text;
    });
  EXPECT_EQ(ended.text,
    good("") + ": cannot list the folder: Too many open files\n" + good("grains.dump") +
      ": cannot open: Too many open files");
}

/// From hopeless to enough: done, or an error.
TEST_F(PlacesLimits, LittleMemory)
{
  const std::string large = large_dump(this->path("large.dump"));
  const int steps = std::max(16, files_of_series() / 50);
  std::set<std::string> seen;
  for (int step = 0; step < steps; ++step)
  {
    for (const bool everything : { true, false })
    {
      // closer together where there is little; 8 MiB are one stack of a thread, 64 one arena of malloc
      const rlim_t bytes = static_cast<rlim_t>(6e8 * std::pow((step + 0.3) / steps, 5));
      const Ended ended = run_apart(
        [&]
        {
          grow_stack();
          std::ifstream status("/proc/self/statm");
          rlim_t pages = 0;
          status >> pages;
          limit(RLIMIT_AS, pages * 4096 + bytes);
          if (everything)
          {
            return use_everything(this->folder(), 4).empty() ? "done" : "failed";
          }
          const bool done = look(large, GRANULAR_KIND_DUMP, 0, 4).status == GRANULAR_OK &&
            convert(large, this->path("large.dump.zst"), 4).status == GRANULAR_OK;
          return done ? "done" : "failed";
        });
      EXPECT_TRUE(ended.how == "done" || ended.how == "status 3")
        << ended.how << " with " << bytes << " bytes";
      seen.insert(ended.text);
    }
  }
  EXPECT_TRUE(seen.contains("done"));
  EXPECT_TRUE(seen.contains("failed"));
  for (const std::string& name : names_in(this->folder()))
  {
    EXPECT_FALSE(name.ends_with(".tmp")) << name;
  }
}

/// A user may have no more threads: the caller's does it all.
TEST_F(PlacesLimits, NoThreads)
{
  ASSERT_EQ(use_everything(this->folder(), 4), "");
  const std::string large = large_dump(this->path("large.dump"));
  const Seen free = look(large);
  const std::string before = written(this->folder());
  fs::permissions(this->folder(), fs::perms(0777));
  const Ended ended = run_apart(
    [&]
    {
      if (!become_nobody() || ::access(large.c_str(), R_OK) != 0)
      {
        return std::string("skip");
      }
      limit(RLIMIT_NPROC, 0);
      pthread_t thread = {};
      if (::pthread_create(
            &thread, nullptr, [](void*) -> void* { return nullptr; }, nullptr) != EAGAIN)
      {
        return std::string("skip");
      }
      std::string said;
      for (const Kind& kind : kinds)
      {
        const Seen seen = look(file_of(kind), kind.kind, 0, 4);
        said += seen.status == GRANULAR_OK ? "" : seen.text + "\n";
      }
      said += look(large, GRANULAR_KIND_DUMP, 0, 4) == free ? "" : "other values\n";
      const std::string folder = this->path("nobody");
      fs::create_directory(folder);
      for (const Output& output : outputs)
      {
        const Seen seen = convert(good(output.file), folder + "/new" + output.ending, 4);
        said += seen.status == GRANULAR_OK ? "" : seen.text + "\n";
      }
      said += written(folder) == before ? "" : "other bytes\n";
      return said;
    });
  fs::permissions(this->folder(), fs::perms(0755));
  if (ended.text == "skip")
  {
    GTEST_SKIP() << "limits of threads do not bind here";
  }
  EXPECT_EQ(ended.how, "done");
  EXPECT_EQ(ended.text, "");
}

/// Whoever calls may have a small stack, and give small ones to our threads.
TEST_F(PlacesLimits, SmallStacks)
{
  ASSERT_EQ(use_everything(this->folder(), 4), "");
  const std::string large = large_dump(this->path("large.dump"));
  const Seen free = look(large);
  const std::string before = written(this->folder());
  for (const std::size_t bytes : { std::size_t{ 64 } << 10, std::size_t{ 256 } << 10 })
  {
    for (const int threads : { 1, 4 })
    {
      const Ended ended = run_apart(
        [&]
        {
          std::string said;
          with_stack(bytes,
            [&]
            {
              said = use_everything(this->folder(), threads);
              said += look(large, GRANULAR_KIND_DUMP, 0, threads) == free ? "" : "other values\n";
              said += convert(large, this->path("large.dump.zst"), threads).text;
              said += convert(large, this->path("large.dump.gz"), threads).text;
              said += look(this->path("large.dump.zst"), GRANULAR_KIND_DUMP, 0, threads) == free
                ? ""
                : "other zst\n";
              said += look(this->path("large.dump.gz"), GRANULAR_KIND_DUMP, 0, threads) == free
                ? ""
                : "other gz\n";
            });
          return said + (written(this->folder()) == before ? "" : "other bytes");
        });
      EXPECT_EQ(ended.how + " " + ended.text, "done ")
        << bytes << " bytes, " << threads << " threads";
    }
  }
}

/// All text has points, whatever the program has set.
TEST_F(PlacesLimits, DecimalCommas)
{
  ASSERT_EQ(use_everything(this->folder(), 2), "");
  const std::string before = written(this->folder());
  std::vector<Seen> plain;
  for (const Kind& kind : kinds)
  {
    plain.push_back(look(file_of(kind), kind.kind));
  }
  fs::create_directory(this->path("locales"));
  for (const std::string name : { "de_DE.UTF-8", "tr_TR.UTF-8" }) // in Turkish, small I has no dot
  {
    const Ended ended = run_apart(
      [&]
      {
        if (!set_locale(name, this->path("locales")))
        {
          return std::string("skip");
        }
        std::locale::global(std::locale(name));
        std::string said = std::localeconv()->decimal_point == std::string(",") ? "" : "no comma\n";
        said += use_everything(this->folder(), 2);
        for (std::size_t i = 0; i < plain.size(); ++i)
        {
          said += look(file_of(kinds[i]), kinds[i].kind) == plain[i]
            ? ""
            : std::string(kinds[i].name) + "\n";
        }
        return said + (written(this->folder()) == before ? "" : "other bytes");
      });
    if (ended.text == "skip")
    {
      GTEST_SKIP() << "the sources of locales are needed (Debian: locales)";
    }
    EXPECT_EQ(ended.how + " " + ended.text, "done ") << name;
  }
}
