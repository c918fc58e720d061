// SPDX-License-Identifier: BSD-3-Clause
#include "helper.h"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bench
{
Helper::Helper(const std::string& command)
{
  std::signal(SIGPIPE, SIG_IGN); // one that has ended is told by its answer
  int questions[2];
  int answers[2];
  if (::pipe2(questions, O_CLOEXEC) != 0 || ::pipe2(answers, O_CLOEXEC) != 0)
  {
    throw std::runtime_error("no pipe");
  }
  to_ = questions[1];
  from_ = answers[0];
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, questions[0], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, answers[1], STDOUT_FILENO);
  const char* const arguments[] = { "sh", "-c", command.c_str(), nullptr };
  const int failed = ::posix_spawn(
    &process_, "/bin/sh", &actions, nullptr, const_cast<char* const*>(arguments), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(questions[0]);
  ::close(answers[1]);
  if (failed)
  {
    throw std::runtime_error("cannot start " + command);
  }
}

Helper::~Helper()
{
  ::close(to_);
  ::close(from_);
  ::waitpid(process_, nullptr, 0);
}

std::string Helper::ask(const std::string& question)
{
  const std::string line = question + "\n";
  if (::write(to_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
  {
    throw std::runtime_error("the helper has ended before: " + question);
  }
  while (true)
  {
    const std::string answer = this->read_line();
    if (answer.starts_with("= "))
    {
      return answer.substr(2);
    }
    std::fprintf(stderr, "%s\n", answer.c_str());
  }
}

std::string Helper::read_line()
{
  std::size_t feed = 0;
  while ((feed = unread_.find('\n')) == std::string::npos)
  {
    char buffer[4096];
    const ssize_t got = ::read(from_, buffer, sizeof buffer);
    if (got <= 0)
    {
      throw std::runtime_error("the helper ended instead of an answer: " + unread_);
    }
    unread_.append(buffer, static_cast<std::size_t>(got));
  }
  const std::string line = unread_.substr(0, feed);
  unread_.erase(0, feed + 1);
  return line;
}

std::string program_beside(const std::string& name)
{
  return std::filesystem::read_symlink("/proc/self/exe").replace_filename(name).string();
}
}
