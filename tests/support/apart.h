// SPDX-License-Identifier: BSD-3-Clause
// Runs something in a process of its own, which may take another user, limits and variables.
#ifndef granular_tests_support_apart_h
#define granular_tests_support_apart_h

#include <cstring>
#include <exception>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

/// How a process ended, and what it said.
struct Ended
{
  std::string how; ///< done, status 3, or a signal
  std::string text;
};

/// Runs a function that returns a text. An exception is status 3 and its text. A process that does not end is killed after a minute.
template <class Function>
Ended run_apart(const Function& function)
{
  int ends[2] = {};
  if (::pipe(ends) != 0)
  {
    return { "no pipe", {} };
  }
  const pid_t child = ::fork();
  if (child == 0)
  {
    ::alarm(60);
    int status = 0;
    std::string text;
    try
    {
      text = function();
    }
    catch (const std::exception& error)
    {
      status = 3;
      text = error.what();
    }
    const bool told =
      ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    ::_exit(told ? status : 4);
  }
  ::close(ends[1]);
  Ended ended;
  char buffer[4096];
  for (ssize_t got = 0; (got = ::read(ends[0], buffer, sizeof(buffer))) > 0;)
  {
    ended.text.append(buffer, static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  ended.how = WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status))
    : WEXITSTATUS(status) != 0    ? "status " + std::to_string(WEXITSTATUS(status))
                                  : "done";
  return ended;
}

/// Takes permissions and limits that bind: root becomes nobody. Returns false if it may not.
inline bool become_nobody()
{
  constexpr uid_t nobody = 65534;
  return ::geteuid() != 0 || ::setresuid(nobody, nobody, nobody) == 0;
}

#endif
