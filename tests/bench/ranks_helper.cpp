// SPDX-License-Identifier: BSD-3-Clause
// bench_ranks_helper FILE ROWS, under mpirun: reads the frame that bench_ranks wrote, by as many ranks
// as it is asked for. Questions: check|time RANKS plain|sorted.
#include "dump_frame.h"

#include "granular/memory/block_pool.h"
#include "granular/mpi/mpi_communicator.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <sstream>
#include <thread>

namespace
{
using bench::Output;
using bench::Rows;

/// What all ranks are to do.
struct Order
{
  int ranks = 0; ///< that read; 0: none, the work is done
  int sorted = 0;
  int check = 0;
};

/// From rank 0 to all. Who waits sleeps: the cores are for those that read.
void share(Order& order)
{
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(&order, 3, MPI_INT, 0, MPI_COMM_WORLD, &request);
  for (int done = 0; !done;)
  {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (!done)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  }
}

/// Rows of the truth in the order of their ids.
Output sorted(Output& truth, const Rows& rows)
{
  Output result(rows, rows.count);
  const auto* const ids = reinterpret_cast<const std::int64_t*>(truth.array(0));
  std::vector<std::int64_t> order(static_cast<std::size_t>(rows.count));
  std::iota(order.begin(), order.end(), 0);
  std::sort(
    order.begin(), order.end(), [ids](std::int64_t a, std::int64_t b) { return ids[a] < ids[b]; });
  const std::vector<Output::Place> from = truth.places(0);
  const std::vector<Output::Place> to = result.places(0);
  for (std::size_t i = 0; i < to.size(); ++i)
  {
    const std::size_t bytes = to[i].array.bytes_a_row();
    for (std::size_t row = 0; row < order.size(); ++row)
    {
      std::memcpy(to[i].data + row * bytes,
        from[i].data + static_cast<std::size_t>(order[row]) * bytes, bytes);
    }
  }
  return result;
}

/// Some of the ranks, and what each keeps from frame to frame.
class Readers
{
public:
  explicit Readers(MPI_Comm ranks)
    : mpi_(ranks)
    , ranks_(ranks)
  {
    request_.piece = ranks_.rank();
    request_.pieces = ranks_.size();
    request_.pool = std::make_shared<granular::BlockPool>(std::size_t{ 1 } << 32);
  }

  /// Seconds from one barrier to the other.
  double read(const granular::RunIndex& index, bool sort)
  {
    granular::Notices notices;
    granular::Progress progress;
    request_.sort_by_id = sort;
    const std::vector<granular::FramePiece> pieces = index.pieces(0);
    MPI_Barrier(mpi_);
    const auto start = std::chrono::steady_clock::now();
    request_.pool->next_frame();
    frame_ = granular::read_dump(pieces, request_, ranks_, notices, progress);
    MPI_Barrier(mpi_);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (!notices.empty())
    {
      throw std::logic_error(notices.front().text);
    }
    return time.count();
  }

  /// Whether all ranks together hold the rows of truth, in its order.
  bool hold(const Output& truth, std::int64_t rows)
  {
    long long mine = frame_.rows;
    long long end = 0;
    long long all = 0;
    MPI_Scan(&mine, &end, 1, MPI_LONG_LONG, MPI_SUM, mpi_);
    MPI_Allreduce(&mine, &all, 1, MPI_LONG_LONG, MPI_SUM, mpi_);
    int right = all == rows && bench::holds_from(frame_, truth, end - mine);
    MPI_Allreduce(MPI_IN_PLACE, &right, 1, MPI_INT, MPI_MIN, mpi_);
    return right != 0;
  }

private:
  MPI_Comm mpi_;
  granular::MpiCommunicator ranks_;
  granular::DumpRequest request_;
  granular::DumpFrame frame_;
};

/// The first so many ranks of all; null on the others. Collective.
std::unique_ptr<Readers> first_ranks(int count)
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm some = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rank < count ? 0 : MPI_UNDEFINED, rank, &some);
  return some == MPI_COMM_NULL ? nullptr : std::make_unique<Readers>(some);
}

Order read_order()
{
  std::string line;
  Order order;
  if (std::getline(std::cin, line))
  {
    std::istringstream words(line);
    std::string what;
    std::string how;
    words >> what >> order.ranks >> how;
    order.check = what == "check";
    order.sorted = how == "sorted";
  }
  return order;
}

/// Until there are no more questions.
void serve(const std::string& path, std::int64_t count)
{
  const granular::RunIndex index = bench::index_of({ path });
  const Rows rows = bench::make_rows(bench::Form::Custom, count);
  Output truth(rows, count);
  std::vector<granular::ColumnSink> sinks = truth.sinks(0);
  bench::parse_slowly(rows.text.c_str(), sinks, count);
  const Output truth_sorted = sorted(truth, rows);
  std::map<int, std::unique_ptr<Readers>> readers;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  while (true)
  {
    Order order = rank == 0 ? read_order() : Order{};
    share(order);
    if (order.ranks == 0)
    {
      return;
    }
    if (readers.count(order.ranks) == 0)
    {
      readers[order.ranks] = first_ranks(order.ranks);
    }
    if (Readers* const mine = readers[order.ranks].get())
    {
      const double seconds = mine->read(index, order.sorted);
      const bool right = order.check && mine->hold(order.sorted ? truth_sorted : truth, count);
      if (rank == 0)
      {
        std::printf("= %s\n",
          !order.check ? std::to_string(seconds).c_str()
            : right    ? "right"
                       : "wrong");
        std::fflush(stdout);
      }
    }
  }
}
}

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  try
  {
    if (argc != 3)
    {
      throw std::invalid_argument("usage: bench_ranks_helper FILE ROWS");
    }
    serve(argv[1], std::strtoll(argv[2], nullptr, 10));
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}
