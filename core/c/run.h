// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_run_h
#define granular_c_run_h

#include "frame.h"
#include "granular.h"

#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/runs/run.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <string>
#include <vector>

namespace granular_c
{
/// Progress and notices of the caller.
class Caller final : public granular::Progress
{
public:
  Caller(granular_progress progress, granular_notice notice, void* user)
    : progress_(progress)
    , notice_(notice)
    , user_(user)
  {
  }

  /// Begins another task, whose fractions grow from 0 again.
  void begin() noexcept { largest_ = 0; }

  bool report(double fraction) override
  {
    largest_ = std::max(largest_, fraction);
    return progress_ == nullptr || progress_(largest_, user_) == 0;
  }

  void tell(const granular::Notices& notices) const;

  /// Tells the notices of the first rank on all ranks that have worked together. Collective.
  void tell(const granular::Notices& notices, granular::Communicator& ranks) const;

private:
  granular_progress progress_;
  granular_notice notice_;
  void* user_;
  double largest_ = 0;
};

/// The wanted part of a frame, checked.
struct Wanted
{
  Wanted(const granular_request& given, const granular::Communicator& ranks);

  granular::Request request;
  int table = 0;
  std::vector<std::string> names; ///< of arrays that must be there
};
}

/// An open run. Frames are read under a shared lock, and refresh takes it alone.
struct granular_run
{
  granular_run(std::vector<std::string> patterns, const granular_open_options& options);

  void refresh(granular_c::Caller& caller);
  std::size_t number_of(std::int64_t frame) const; ///< throws ArgumentError

  /// Works with all ranks. Throws ArgumentError in a function for progress or notices of the same run: the other ranks would wait for
  /// this one elsewhere. One rank alone may read there.
  template <class Work>
  auto together(bool reads, const Work& work)
  {
    if (!reads || ranks_->size() > 1)
    {
      this->expect_idle();
    }
    return granular::do_together(*ranks_, work);
  }
  const granular::Kind& kind() const { return run_.kind(); }
  const granular::RunIndex& index() const { return run_.index(); }

  /// Returns the offer of the files for a frame; found once for all frames with the same columns. Throws ArgumentError for a table that
  /// there is not.
  const granular::Offer& offer(std::size_t frame, int table);

  /// Returns the arrays that look() finds in all frames, each name once. Collective.
  const std::vector<granular::OfferedArray>& every_array(int table);

  /// Collective.
  std::unique_ptr<granular_frame> read(std::int64_t frame, const granular_request& given);

  std::shared_mutex mutex;
  std::shared_ptr<const granular::RunIndex> shared_index; ///< that of the run, for frames

  /// Memory of frames that were released, for the next ones: at most 256 MiB.
  std::shared_ptr<granular::BlockPool> pool =
    std::make_shared<granular::BlockPool>(std::size_t{ 1 } << 28);
  std::vector<double> times;

  /// The frames of a file that are not shown.
  struct LeftOut
  {
    std::string defect;        ///< of the first frame that was left out; empty: none
    std::int64_t repeated = 0; ///< frames with a timestep of an earlier one in the file
  };
  std::vector<LeftOut> left_out; ///< of each file

private:
  void expect_idle() const;
  void expect_table(int table) const;

  /// Returns the notices whose subjects the caller has not heard of: see subject_of.
  granular::Notices news(granular::Notices notices, bool of_files);

  std::unique_ptr<granular::Communicator> ranks_;
  granular::SerialCommunicator alone_;
  double timestep_size_;
  std::vector<std::string> patterns_;
  granular::Run run_ = granular::Run(granular::dump_kind);
  std::vector<granular::OfferedArray> every_array_[2]; ///< of each table, as far as asked
  std::mutex refresh_mutex_;                           ///< locked first
  std::mutex offers_mutex_;
  std::mutex told_mutex_;
  std::set<std::string> told_;
};
#endif
