// SPDX-License-Identifier: BSD-3-Clause
// What all filters of granular_filters.h need. Each group of them has a file filter_*.cpp with a function for each, which turns settings
// into a request of the core, and what the core makes into frames. filters.cpp has the table of these functions.
#ifndef granular_c_filter_h
#define granular_c_filter_h

#include "frame.h"
#include "granular_filters.h"

#include "granular/common/error.h"
#include "granular/common/made_arrays.h"
#include "granular/common/progress.h"
#include "granular/contacts/contact_input.h"
#include "granular/lines/line_rows.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular_c
{
/// The settings of a task. Each function returns the default where there is no setting of that name, and throws ArgumentError where
/// there is another kind or number of values.
class Settings
{
public:
  explicit Settings(std::span<const granular_setting> given);

  std::string text(const char* name, const char* otherwise);
  double number(const char* name, double otherwise);
  std::int64_t integer(const char* name, std::int64_t otherwise);
  bool flag(const char* name, bool otherwise)
  {
    return this->integer(name, otherwise ? 1 : 0) != 0;
  }
  int choice(const char* name, int choices, int otherwise = 0); ///< from 0 to choices - 1

  template <std::size_t count>
  std::array<double, count> numbers(const char* name, std::array<double, count> otherwise)
  {
    this->find(name, otherwise);
    return otherwise;
  }

  std::vector<double> list(const char* name);                               ///< of any length
  granular::ArrayChoice arrays(std::span<const granular::MadeArray> known); ///< that are to be made

  /// Throws ArgumentError for a setting that no function asked for.
  void expect_known(const std::string& filter) const;

private:
  const granular_setting* find(const char* name);
  void find(const char* name, std::span<double> numbers);

  std::span<const granular_setting> given_;
  std::set<std::string_view> asked_;
};

/// An input of a task in the memory of the caller.
struct FilterInput
{
  /// Throws ArgumentError for arrays that cannot be: see granular_content.
  explicit FilterInput(const granular_content& content);

  std::vector<double> absolute_ends() const; ///< six numbers a row, or none

  WriteView rows;            ///< with points, or the ends of lines
  granular::FrameView& view; ///< of these
  bool are_lines;            ///< there are ends, even if there are no rows
  std::optional<std::int64_t> timestep;
};

/// A task in work.
class FilterTask
{
public:
  /// Collective.
  FilterTask(const granular_task& given, granular::Communicator& all, granular::Progress& caller);

  /// Returns an input; null if nothing is connected there. Collective.
  std::unique_ptr<FilterInput> input(std::size_t port, std::size_t frame = 0);

  /// Returns an input, or throws ArgumentError; particles get the header that all ranks share: see share_header. Collective.
  std::unique_ptr<FilterInput> needed_input(std::size_t port, std::size_t frame = 0);
  std::unique_ptr<FilterInput> particles(std::size_t port, std::size_t frame = 0);

  /// Returns the part of so many things made here that this rank gets.
  std::pair<std::int64_t, std::int64_t> range_of(std::int64_t count) const;

  Settings settings;
  granular::Communicator& ranks; ///< all
  const std::size_t frames;
  const std::vector<double> times; ///< of the frames, or none
  const std::size_t shown;
  const int piece;
  const int pieces;
  const bool together;           ///< each rank asks for its own piece
  granular::Communicator& group; ///< the ranks that make one whole: all, or this one alone
  const int threads;
  granular::PartialProgress progress;
  granular::Notices notices;

private:
  const granular_task& given_;
  granular::SerialCommunicator alone_;
};

/// The contacts of a task: those between particles at input 1, and those with walls at input 2, either of which may be missing.
class TaskContacts
{
public:
  /// Collective.
  explicit TaskContacts(FilterTask& task, std::size_t frame = 0);

  const granular::ContactSources& sources() const { return sources_; }
  bool are_lines() const { return inputs_[0] != nullptr && inputs_[0]->are_lines; }

private:
  std::array<std::unique_ptr<FilterInput>, 2> inputs_;
  std::array<std::optional<granular::LineRows>, 2> rows_;
  granular::ContactSources sources_;
};

using Frames = std::vector<std::unique_ptr<granular_frame>>;

/// Makes a frame of a table that was made, whose rows are particles or lines.
std::unique_ptr<granular_frame> make_frame(
  RowKind kind, granular::Table&& table, bool split = false);

/// Makes a frame of one row with numbers of the whole result.
std::unique_ptr<granular_frame> make_facts(
  const std::vector<std::pair<std::string_view, std::vector<double>>>& facts);

// ---- the filters ---------------------------------------------------------------------------------
Frames apply_packing(FilterTask& task);
Frames apply_local_join(FilterTask& task);
Frames apply_decomposition_source(FilterTask& task);
Frames apply_decomposition(FilterTask& task);
Frames apply_contact_sums(FilterTask& task);
Frames apply_point_average(FilterTask& task);
Frames apply_euler_average(FilterTask& task);
Frames apply_profile(FilterTask& task);
Frames apply_compare(FilterTask& task);
Frames apply_trajectories(FilterTask& task);
Frames apply_history(FilterTask& task);
}
#endif
