// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "../support/communicator_checks.h"
#include "../support/dumps.h"
#include "../support/small_disk.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

using granular::MpiCommunicator;

namespace
{
/// The limits: the smallest there may be, one that cuts parts unevenly, and the usual one.
constexpr std::int64_t limits[] = { 8, 100, std::int64_t{ 1 } << 30 };

/// Tests with other numbers of ranks may run at the same time.
std::string folder(const granular::Communicator& ranks)
{
  return std::string(GRANULAR_OUTPUT) + "/ranks_" + std::to_string(ranks.size());
}

/// While it lives, this process is no longer root, if it is to be so and was.
class Nobody
{
public:
  explicit Nobody(bool wanted)
    : is_it_(!wanted || ::geteuid() != 0 || ::seteuid(65534) == 0)
    , changed_(wanted && is_it_ && ::getuid() == 0)
  {
  }

  Nobody(const Nobody&) = delete;
  Nobody& operator=(const Nobody&) = delete;

  ~Nobody()
  {
    if (changed_)
    {
      EXPECT_EQ(::seteuid(0), 0);
    }
  }

  bool is_it() const noexcept { return is_it_; }

private:
  bool is_it_;
  bool changed_;
};

bool all_of(granular::Communicator& ranks, bool value)
{
  std::int64_t without = value ? 0 : 1;
  ranks.sum({ &without, 1 });
  return without == 0;
}
}

TEST(MpiCommunicator, knows_its_ranks)
{
  int rank = 0;
  int size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const MpiCommunicator ranks(MPI_COMM_WORLD);
  EXPECT_EQ(ranks.rank(), rank);
  EXPECT_EQ(ranks.size(), size);
  EXPECT_EQ(ranks.node_size(), size); // mpirun starts them all here
}

TEST(MpiCommunicator, moves_bytes)
{
  for (const std::int64_t limit : limits)
  {
    MpiCommunicator ranks(MPI_COMM_WORLD, limit);
    check_broadcast(ranks);
    check_all_gather(ranks);
    check_sum(ranks);
    check_exchange(ranks);
    check_send(ranks);
    check_send_without_memory(ranks);
  }
}

TEST(MpiCommunicator, opens_a_file)
{
  for (const std::int64_t limit : limits)
  {
    MpiCommunicator ranks(MPI_COMM_WORLD, limit);
    check_open_together(ranks, folder(ranks));
    check_open_together_fails(ranks, folder(ranks));
  }
}

TEST(MpiCommunicator, a_full_disk)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  if (!check_full_disk(ranks, folder(ranks)))
  {
    GTEST_SKIP() << SmallDisk::not_there;
  }
}

/// Some MPI take what is before a colon for the kind of the file system, and the rest for the path.
TEST(MpiCommunicator, opens_no_file_with_a_colon_in_its_path)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const std::string noon = folder(ranks) + "/run_12:00";
  empty_folder(ranks, noon);
  const std::string link = folder(ranks) + "/link";
  if (ranks.rank() == 0)
  {
    std::filesystem::create_symlink("run_12:00/file", link);
  }
  EXPECT_FALSE(ranks.open_together(noon + "/file"));
  EXPECT_FALSE(ranks.open_together(link));
  EXPECT_EQ(names_in(noon), "");
  granular::agree(ranks, nullptr);
  empty_folder(ranks, folder(ranks));
}

/// The last rank alone may not open what rank 0 made.
TEST(MpiCommunicator, a_file_that_one_rank_cannot_open)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const std::string path = folder(ranks) + "/file";
  empty_folder(ranks, folder(ranks));
  std::string error;
  {
    const Nobody nobody(ranks.size() > 1 && ranks.rank() == ranks.size() - 1);
    if (ranks.size() == 1 || !all_of(ranks, nobody.is_it() && ::getuid() == 0))
    {
      GTEST_SKIP() << "needs root, and a second rank to be someone else";
    }
    error = open_together_error(ranks, path);
  }
  const std::string last = std::to_string(ranks.size() - 1);
  EXPECT_EQ(error,
    path + ": cannot write: Permission denied (on rank " + last + " of " +
      std::to_string(ranks.size()) + ")");
  EXPECT_EQ(names_in(folder(ranks)), "");
}

TEST(MpiCommunicator, a_folder_that_may_not_be_written)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const std::string path = folder(ranks) + "/file";
  empty_folder(ranks, folder(ranks));
  std::filesystem::permissions(folder(ranks), std::filesystem::perms(0555));
  granular::agree(ranks, nullptr);
  const bool root = ::geteuid() == 0;
  std::string error;
  {
    const Nobody nobody(root);
    if (!all_of(ranks, nobody.is_it()))
    {
      GTEST_SKIP() << "root may write everywhere here";
    }
    error = open_together_error(ranks, path);
  }
  const std::string rank = " (on rank 0 of " + std::to_string(ranks.size()) + ")";
  EXPECT_EQ(error, path + ": cannot write: Permission denied" + (ranks.size() > 1 ? rank : ""));
  EXPECT_EQ(names_in(folder(ranks)), "");
  std::filesystem::permissions(folder(ranks), std::filesystem::perms(0755));
}

TEST(MpiCommunicator, agree)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  if (ranks.size() > 1)
  {
    check_agree(ranks);
  }
}

/// Parts of a group that work apart, and the whole in between.
TEST(MpiCommunicator, part_of_a_group)
{
  MpiCommunicator all(MPI_COMM_WORLD);
  MPI_Comm half = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, all.rank() % 2, all.rank(), &half);
  MpiCommunicator ranks(half);
  MPI_Comm_free(&half);
  EXPECT_EQ(ranks.rank(), all.rank() / 2);
  std::string bytes = std::to_string(all.rank());
  ranks.broadcast(bytes, 0);
  EXPECT_EQ(bytes, std::to_string(all.rank() % 2));
  check_exchange(all);
  check_exchange(ranks);
}

/// Messages of the program under way on the communicator that it gave stay its own.
TEST(MpiCommunicator, stays_apart_from_the_program)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const int next = (ranks.rank() + 1) % ranks.size();
  int sent = ranks.rank();
  int got = -1;
  MPI_Request requests[2];
  MPI_Irecv(&got, 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &requests[0]);
  check_exchange(ranks);
  MPI_Isend(&sent, 1, MPI_INT, next, 0, MPI_COMM_WORLD, &requests[1]);
  MPI_Waitall(2, requests, MPI_STATUSES_IGNORE);
  EXPECT_EQ(got, (ranks.rank() + ranks.size() - 1) % ranks.size());
}

TEST(MpiCommunicator, errors_of_mpi_are_errors)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const std::string error = error_of<granular::IoError>([&] { ranks.send("x", ranks.size()); });
  EXPECT_NE(error.find("MPI_ERR_RANK"), std::string::npos) << error;
}

/// More is sent than there is room for: the receiver hears of it and keeps to its room.
TEST(MpiCommunicator, too_much)
{
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const auto size = static_cast<std::size_t>(ranks.size());
  const auto rank = static_cast<std::size_t>(ranks.rank());
  std::vector<std::int64_t> from_bytes(size, 2);
  std::vector<std::int64_t> to_bytes(size, 1);
  from_bytes[rank] = to_bytes[rank] = 0;
  const std::string from(2 * size, 'y');
  std::string to(size, 'x');
  const std::string error = error_of<granular::IoError>(
    [&] { ranks.exchange(from.data(), from_bytes, to.data(), to_bytes); });
  EXPECT_TRUE(
    error.empty() ? ranks.size() == 1 : error.find("MPI_ERR_TRUNCATE") != std::string::npos)
    << error;
}
