// SPDX-License-Identifier: BSD-3-Clause
// A program beside the benchmark's own: what can only be measured in there takes its turns all the same.
#ifndef tests_bench_helper_h
#define tests_bench_helper_h

#include <string>

#include <sys/types.h>

namespace bench
{
/// Answers one question at a time. A question is a line, so is its answer, which begins with "= "; all
/// other lines go to standard error. The program ends where its input does.
class Helper
{
public:
  /// command: for the shell.
  explicit Helper(const std::string& command);
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  ~Helper();

  /// Throws std::runtime_error where the program has ended instead.
  std::string ask(const std::string& question);

private:
  std::string read_line();

  pid_t process_ = 0;
  int to_ = -1;
  int from_ = -1;
  std::string unread_;
};

/// A program of this build: the path of a neighbour of the benchmark.
std::string program_beside(const std::string& name);
}
#endif
