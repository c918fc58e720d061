// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_caller_ranks_h
#define granular_c_caller_ranks_h

#include "granular.h"

#include "granular/parallel/communicator.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular_c
{
/// The ranks of a caller, by the only function that it gives: every rank tells all ranks some bytes. They go in parts of a size that all
/// ranks know, so that memory stays small. What only writers need is missing.
class CallerRanks final : public granular::Communicator
{
public:
  /// Throws ArgumentError for a rank that is not one of so many, and without a function.
  explicit CallerRanks(const granular_ranks& given);

  int rank() const noexcept override { return ranks_.rank; }
  int size() const noexcept override { return ranks_.size; }
  int node_size() const noexcept override { return 1; }

private:
  void do_sum(std::span<std::int64_t> values) override;
  void do_broadcast(std::span<char> bytes, int root) override;
  void do_gather(char* parts, std::span<const std::int64_t> counts) override;
  void prepare_exchange(
    std::span<const std::int64_t> from_bytes, std::span<const std::int64_t> to_bytes) override;
  void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override;

  template <class Take>
  void gather_parts(std::string_view mine, std::size_t most, const Take& take);

  granular_ranks ranks_;
  std::vector<char> mine_;
  std::vector<char> all_;
  std::vector<std::int64_t> exchanged_; ///< bytes from each rank to each
  std::vector<std::int64_t> row_bytes_; ///< of each rank's row of these
  bool failed_ = false;                 ///< the ranks are at odds: nothing more can be gathered
};

/// Returns the ranks of a caller, or one alone if it gives none.
std::unique_ptr<granular::Communicator> make_ranks(const granular_ranks* given);
}
#endif
