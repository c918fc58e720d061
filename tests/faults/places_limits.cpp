// SPDX-License-Identifier: BSD-3-Clause
// Files of every kind where the system gives little: open files, memory, threads, stacks; and in locales with a decimal comma.
// GRANULAR_PLACES: the number of files of a series; also of limits of memory, a fiftieth.
#include "places.h"

#include "../support/apart.h"
#include "../support/own_folder.h"

#include "granular/common/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <locale>
#include <map>
#include <sstream>

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
    const std::string path = folder + "/" + kind.name + kind.ending;
    std::error_code failed;
    fs::copy_file(file_of(kind), path, fs::copy_options::skip_existing, failed);
    const Seen seen = look(path, kind.kind, threads);
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

/// A run that is read, or written into another file where `to` is not empty. Running needs no memory but that of the interface.
struct Task
{
  std::string from = {};
  std::string to = {};
  granular_kind kind = GRANULAR_KIND_AUTOMATIC;
  std::string expected = {}; ///< the result without limits
  granular_status status = GRANULAR_OK;
  std::uint64_t hash = 0;              ///< of the values read
  std::array<char, 1000> message = {}; ///< of the error

  /// An exception that leaves the interface ends the process.
  void run() noexcept
  {
    granular::Hash values;
    ::unlink(to.c_str()); // of the run before
    status = !to.empty()
      ? convert_file(from.c_str(), to.c_str(), 4)
      : visit(from.c_str(), kind, 4,
          [&](const void* bytes, std::size_t count) { values.add(bytes, count); });
    hash = values.value();
    if (status != GRANULAR_OK)
    {
      std::strncpy(message.data(), granular_last_error()->message, message.size() - 1);
    }
  }

  std::string result() const
  {
    granular::Hash bytes;
    const std::string written = to.empty() ? "" : content(to);
    bytes.add(written.data(), written.size());
    return std::to_string(to.empty() ? hash : bytes.value());
  }

  std::string judgement() const
  {
    if (status == GRANULAR_OK)
    {
      return this->result() == expected ? "right" : "other values or bytes: " + from + " " + to;
    }
    if (!to.empty() && fs::exists(to))
    {
      return "an error, and yet a file: " + to;
    }
    if (status == GRANULAR_NO_MEMORY)
    {
      return "no memory";
    }
    const std::string text = message.data();
    const bool named = text.find(from) != text.npos || (!to.empty() && text.find(to) != text.npos);
    return named ? "names the file" : from + " " + to + ": " + text;
  }
};

/// All kinds, all outputs, and a large file.
std::vector<Task> all_tasks(const std::string& folder)
{
  std::vector<Task> tasks;
  for (const Kind& kind : kinds)
  {
    const std::string path = folder + "/" + kind.name + kind.ending;
    fs::copy_file(file_of(kind), path);
    tasks.push_back({ .from = path, .kind = kind.kind });
  }
  for (const Output& output : outputs)
  {
    tasks.push_back({ .from = good(output.file), .to = folder + "/new" + output.ending });
  }
  const std::string large = large_dump(folder + "/large.dump");
  tasks.push_back({ .from = large });
  tasks.push_back({ .from = large, .to = folder + "/large.dump.zst" });
  return tasks;
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
    const Seen free = look(pattern, kind.kind, 4);
    ASSERT_EQ(free.status, GRANULAR_OK) << free;
    const Ended ended = run_apart(
      [&]
      {
        limit(RLIMIT_NOFILE, 64);
        const Seen limited = look(pattern, kind.kind, 4);
        if (limited != free)
        {
          return limited.text.substr(0, 300);
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

/// From hopeless to enough: the values and bytes are right, or the error says that memory lacks, or names the file.
TEST_F(PlacesLimits, LittleMemory)
{
#ifdef GRANULAR_TEST_SANITIZED
  GTEST_SKIP() << "a sanitizer takes more memory than the limits leave";
#endif
  std::vector<Task> tasks = all_tasks(this->folder());
  const Ended free = run_apart( // this process gets no memory that it could use later
    [&]
    {
      std::string results;
      for (Task& task : tasks)
      {
        task.run();
        results += task.status == GRANULAR_OK ? task.result() + "\n" : task.message.data();
      }
      return results;
    });
  std::istringstream results(free.text);
  for (Task& task : tasks)
  {
    std::getline(results, task.expected);
    ASSERT_EQ(task.expected.find_first_not_of("0123456789"), task.expected.npos) << task.expected;
    ASSERT_FALSE(task.expected.empty()) << free.how;
  }
  const int steps = std::max(16, files_of_series() / 50);
  std::map<std::string, int> count;
  for (int step = 0; step < steps; ++step)
  {
    // closer together where there is little; 8 MiB are one stack of a thread, 64 one arena of malloc
    const auto bytes = static_cast<rlim_t>(6e8 * std::pow((step + 0.3) / steps, 5));
    const Ended ended = run_apart(
      [&]
      {
        grow_stack();
        rlimit limits = {};
        ::getrlimit(RLIMIT_AS, &limits);
        const rlim_t before = limits.rlim_cur;
        std::ifstream status("/proc/self/statm");
        status >> limits.rlim_cur;
        limits.rlim_cur = limits.rlim_cur * 4096 + bytes;
        ::setrlimit(RLIMIT_AS, &limits);
        for (Task& task : tasks)
        {
          task.run();
        }
        limits.rlim_cur = before;
        ::setrlimit(RLIMIT_AS, &limits);
        std::string said;
        for (const Task& task : tasks)
        {
          said += task.judgement() + "\n";
        }
        return said;
      });
    EXPECT_EQ(ended.how, "done") << ended.text << " with " << bytes << " bytes";
    std::istringstream lines(ended.text);
    for (std::string line; std::getline(lines, line);)
    {
      ++count[line];
    }
  }
  EXPECT_GT(count["right"], 0);
  EXPECT_GT(count["no memory"], 0);
  for (const auto& [line, times] : count)
  {
    EXPECT_TRUE(line == "right" || line == "no memory" || line == "names the file") << line;
    this->RecordProperty(line, times);
  }
  for (const std::string& name : names_in(this->folder()))
  {
    EXPECT_FALSE(name.starts_with(".granular-")) << name;
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
        const Seen seen = look(file_of(kind), kind.kind, 4);
        said += seen.status == GRANULAR_OK ? "" : seen.text + "\n";
      }
      said += look(large, GRANULAR_KIND_DUMP, 4) == free ? "" : "other values\n";
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
              said += look(large, GRANULAR_KIND_DUMP, threads) == free ? "" : "other values\n";
              said += convert(large, this->path("large.dump.zst"), threads).text;
              said += convert(large, this->path("large.dump.gz"), threads).text;
              said += look(this->path("large.dump.zst"), GRANULAR_KIND_DUMP, threads) == free
                ? ""
                : "other zst\n";
              said += look(this->path("large.dump.gz"), GRANULAR_KIND_DUMP, threads) == free
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
