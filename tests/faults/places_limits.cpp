// SPDX-License-Identifier: BSD-3-Clause
// Files of every kind where the system gives little: open files, memory, stacks; and in a locale with a decimal comma.
// GRANULAR_PLACES: the number of files of a series; also of limits of memory, a fiftieth.
#include "runs.h"

#include "../support/apart.h"
#include "../support/own_folder.h"
#include "failing_cases.h"

#include "granular/common/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <locale>
#include <map>
#include <sstream>

#include <pthread.h>
#include <sys/resource.h>

using namespace runs;

namespace
{
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
      : visit(from.c_str(), options_of(kind, 4),
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

class PlacesLimits : public OwnFolder
{
protected:
  /// All kinds, all outputs, and a large file, with the results without limits.
  void SetUp() override
  {
    OwnFolder::SetUp();
    fs::permissions(this->folder(), fs::perms(0777)); // another user is to write there
    for (const Kind& kind : kinds)
    {
      const std::string path = this->path(kind.name + std::string(kind.ending));
      fs::copy_file(file_of(kind), path);
      tasks_.push_back({ .from = path, .kind = kind.kind });
    }
    for (const Output& output : outputs)
    {
      tasks_.push_back(
        { .from = good(output.file), .to = this->path(std::string("new") + output.ending) });
    }
    // more rows than a chunk holds, so that all threads have some
    const std::string large = this->write("large.dump", dump_of_rows(100'000));
    tasks_.push_back({ .from = large });
    tasks_.push_back({ .from = large, .to = large + ".zst" });
    const Ended free = run_apart( // this process gets no memory that it could use later
      [&]
      {
        std::string results;
        for (Task& task : tasks_)
        {
          task.run();
          results += (task.status == GRANULAR_OK ? task.result() : task.message.data()) + "\n";
          ::unlink(task.to.c_str()); // which is another user's
        }
        return results;
      });
    std::istringstream results(free.text);
    for (Task& task : tasks_)
    {
      std::getline(results, task.expected);
      ASSERT_EQ(task.expected.find_first_not_of("0123456789"), task.expected.npos) << task.expected;
      ASSERT_FALSE(task.expected.empty()) << free.how;
    }
  }

  void run_all()
  {
    for (Task& task : tasks_)
    {
      task.run();
    }
  }

  std::string judge_all() const
  {
    std::string said;
    for (const Task& task : tasks_)
    {
      said += task.judgement() + "\n";
    }
    return said;
  }

  /// Runs all tasks in a process of its own, and expects the results of a free one. `run` calls what runs the tasks, or returns false
  /// where it cannot limit them.
  void expect_right(const std::function<bool(const std::function<void()>& tasks)>& run)
  {
    const Ended ended =
      run_apart([&] { return run([&] { this->run_all(); }) ? this->judge_all() : "skip"; });
    if (ended.text == "skip")
    {
      GTEST_SKIP() << "the system has no such limit here";
    }
    std::string right;
    for (std::size_t i = 0; i < tasks_.size(); ++i)
    {
      right += "right\n";
    }
    EXPECT_EQ(ended.how + "\n" + ended.text, "done\n" + right);
  }

  std::vector<Task> tasks_;
};

/// A thread with a small stack; those that it starts have one as small.
void with_stack(std::size_t bytes, const std::function<void()>& function)
{
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, bytes);
  ::pthread_setattr_default_np(&attributes);
  pthread_t thread = {};
  const auto call = [](void* called) -> void*
  {
    (*static_cast<const std::function<void()>*>(called))();
    return nullptr;
  };
  ASSERT_EQ(
    ::pthread_create(&thread, &attributes, call, const_cast<std::function<void()>*>(&function)), 0);
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

/// Takes a locale, which is made in a folder if it can be. Returns false if the system does not know it.
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
  const bool known = std::setlocale(LC_ALL, name.c_str()) != nullptr;
  std::locale::global(known ? std::locale(name) : std::locale());
  return known;
}
}

/// A series of many more files than a process may have open.
TEST_F(PlacesLimits, FewOpenFiles)
{
  for (const Kind& kind : kinds)
  {
    SCOPED_TRACE(kind.name);
    const std::string folder = this->path(kind.name);
    fs::create_directory(folder);
    for (int i = 0; i < files_of_series(); ++i)
    {
      fs::create_symlink(file_of(kind), folder + "/s_" + std::to_string(i) + kind.ending);
    }
    const std::string pattern = folder + "/s_*" + kind.ending;
    const Seen free = look(pattern, kind.kind, 4);
    ASSERT_EQ(free.status, GRANULAR_OK) << free;
    const Ended ended = run_apart(
      [&]
      {
        limit(RLIMIT_NOFILE, 64);
        const Seen limited = look(pattern, kind.kind, 4);
        return limited == free ? std::string() : limited.text.substr(0, 300);
      });
    EXPECT_EQ(ended.how + " " + ended.text, "done ");
    fs::remove_all(folder);
  }
}

/// Where none is left, that is the message, and not that there is no file.
TEST_F(PlacesLimits, NoOpenFiles)
{
#ifdef GRANULAR_TEST_SANITIZED
  GTEST_SKIP() << "a sanitizer looks at an exception through a pipe, and cannot have one";
#endif
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
        this->run_all();
        limits.rlim_cur = before;
        ::setrlimit(RLIMIT_AS, &limits);
        return this->judge_all();
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
  EXPECT_EQ(count_hidden(this->folder()), 0);
}

/// Whoever calls may have a small stack, and give small ones to our threads.
TEST_F(PlacesLimits, SmallStacks)
{
  this->expect_right(
    [](const std::function<void()>& tasks)
    {
      with_stack(std::size_t{ 64 } << 10, tasks);
      return true;
    });
}

/// All text has points, whatever the program has set; in Turkish, small I has no dot.
TEST_F(PlacesLimits, DecimalCommas)
{
  fs::create_directory(this->path("locales"));
  this->expect_right(
    [&](const std::function<void()>& tasks)
    {
      const bool set = set_locale("tr_TR.UTF-8", this->path("locales"));
      EXPECT_TRUE(!set || std::localeconv()->decimal_point == std::string(","));
      if (set)
      {
        tasks();
      }
      return set;
    });
}
