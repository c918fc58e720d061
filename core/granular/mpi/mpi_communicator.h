// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_mpi_mpi_communicator_h
#define granular_mpi_mpi_communicator_h

#include "granular/parallel/communicator.h"

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace granular
{
/// The ranks of an MPI communicator. Errors of MPI become IoError; afterwards the state of the communicator is
/// undefined.
class MpiCommunicator final : public Communicator
{
public:
  /// Duplicates the communicator, so that messages never mix with others of the program. Call between MPI_Init and
  /// MPI_Finalize. MPI counts in int: larger data than most_bytes go in several messages; most_bytes is from 8 to 2^31
  /// - 1 and the same on all ranks. Collective, like the destructor. Throws LimitError on all ranks if one lacks memory.
  explicit MpiCommunicator(MPI_Comm ranks, std::int64_t most_bytes = std::int64_t{ 1 } << 30);

  /// Returns a new one. Here all ranks also know whether one lacks memory for the object itself.
  static std::unique_ptr<MpiCommunicator> make(MPI_Comm ranks);

  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  ~MpiCommunicator() override;

  int rank() const noexcept override { return rank_; }
  int size() const noexcept override { return size_; }
  int node_size() const noexcept override { return node_size_; }
  void call_off() override;
  bool called_off() override;
  void send(std::string_view bytes, int to) override;
  void receive(std::string& bytes, int from) override;
  std::unique_ptr<OutputFile> open_together(const std::string& path) override;

private:
  void do_sum(std::span<std::int64_t> values) override;
  void do_broadcast(std::span<char> bytes, int root) override;
  void prepare_gather(std::span<const std::int64_t> counts) override;
  void do_gather(char* parts, std::span<const std::int64_t> counts) override;
  void prepare_exchange(
    std::span<const std::int64_t> from_bytes, std::span<const std::int64_t> to_bytes) override;
  void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override;
  void settle(std::int64_t callers) override;
  void expect_other(int rank) const;

  MPI_Comm ranks_ = MPI_COMM_NULL;
  std::vector<MPI_Request> calls_;    ///< on their way, of call_off; has room for them
  std::vector<MPI_Request> messages_; ///< of do_exchange; has room for them
  std::vector<MPI_Status> states_;    ///< of messages_
  std::vector<int> parts_;   ///< of do_gather: bytes of each rank, where they fit MPI's counts
  std::vector<int> offsets_; ///< of parts_
  std::int64_t most_bytes_;
  int rank_ = 0;
  int size_ = 1;
  int node_size_ = 1;
};
}
#endif
