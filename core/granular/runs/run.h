// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_runs_run_h
#define granular_runs_run_h

#include "granular/common/progress.h"
#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"
#include "granular/runs/kind.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace granular
{
/// Files of one kind as a run: the index of their frames, and what the files tell of these. offer() changes it; several threads may only
/// read frames together.
class Run
{
public:
  explicit Run(const Kind& kind)
    : kind_(&kind)
  {
  }

  const Kind& kind() const noexcept { return *kind_; }
  const RunOptions& options() const noexcept { return options_; }
  const RunIndex& index() const noexcept { return index_; }

  /// Looks at the files: see update_run_index. Collective.
  void refresh(const std::vector<std::string>& files, const RunOptions& options,
    Communicator& ranks, Notices& notices, Progress& progress);

  /// Returns the run as it is before its files were asked. Others may call offer() meanwhile.
  Run without_offers() const;

  /// Takes options. Others of column_names and repeated_steps need a refresh.
  void set_options(const RunOptions& options);

  /// Returns what the files tell of a frame. They are asked once for all frames with the same columns. Throws Error; Cancelled.
  const Offer& offer(std::size_t frame, Progress& progress);

  /// Returns what offer() has returned for a frame, or look() has found; nothing if the files were not asked.
  const Offer& known_offer(std::size_t frame) const;

  /// Makes all ranks know the arrays of all frames, which rank 0 asks the files for. Collective.
  void look(Communicator& ranks, Progress& progress);

  /// Returns the arrays of a table that look() found, frame by frame: names may repeat.
  std::vector<OfferedArray> arrays(std::size_t table) const;

  /// Returns `ranks` if each of them asks for its own part of one frame in one way, and otherwise `alone`: ranks that read together must
  /// agree on everything. names: of the arrays that are asked for. Collective.
  Communicator& group(std::size_t frame, const Request& request,
    const std::vector<std::string>& names, Communicator& ranks, Communicator& alone) const;

  /// Reads a frame, with what offer() or known_offer() returns for it. Collective. Throws Error; Cancelled.
  Tables read(std::size_t frame, const Request& request, const Offer& offer, Communicator& ranks,
    Notices& notices, Progress& progress) const;

private:
  std::string key_of(std::size_t frame) const;

  const Kind* kind_;
  RunOptions options_;
  RunIndex index_;
  std::map<std::string, Offer> offers_; ///< by the names of the columns, or the number of the frame
  std::vector<std::string> looked_at_;  ///< keys of offers_
};
}
#endif
