// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_run_h
#define granular_c_run_h

#include "frame.h"
#include "granular.h"

#include "granular/frames/run_index.h"
#include "granular/memory/block_pool.h"

#include <algorithm>
#include <map>
#include <memory>
#include <shared_mutex>
#include <span>
#include <string>
#include <string_view>
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

private:
  granular_progress progress_;
  granular_notice notice_;
  void* user_;
  double largest_ = 0;
};

/// An array that a frame has in its file.
struct OfferedArray
{
  std::string name;
  granular::ValueType type = granular::ValueType::Float64;
  int components = 1;
  bool is_usual = true;
  const granular::KnownColumn* known = nullptr;
};

/// The wanted part of a frame, checked.
struct Wanted
{
  explicit Wanted(const granular_request& given);

  /// Returns true for arrays that are wanted by name, or usual ones if no names are given.
  bool is_wanted(std::string_view name, bool is_usual) const;

  granular_request request;
  bool all = true; ///< no names were given
  std::vector<std::string> names;
  int threads = 1;
};

struct Kind;
}

/// An open run. Frames are read under a shared lock, and refresh takes it alone.
struct granular_run
{
  granular_run(std::vector<std::string> patterns, const granular_open_options& options);

  void refresh(granular_c::Caller& caller);
  std::size_t number_of(std::int64_t frame) const; ///< throws BadArgument

  const granular_c::Kind& kind() const { return *kind_; }

  /// The arrays of a frame; found once for all frames with the same columns.
  const std::vector<granular_c::OfferedArray>& arrays(std::size_t frame, int table);

  std::unique_ptr<granular_frame> read(
    std::size_t frame, const granular_c::Wanted& wanted, granular_c::Caller& caller);

  std::shared_mutex mutex;
  granular::RunIndex index;
  std::shared_ptr<const granular::RunIndex> shared_index; ///< the same, for frames

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

  // as they were given
  double timestep_size = 1;
  std::string preset;
  std::string column_map;
  std::string atom_style;

private:
  using Offers = std::map<std::pair<std::string, int>, std::vector<granular_c::OfferedArray>>;

  std::vector<std::string> patterns_;
  granular::IndexOptions options_;
  std::vector<std::string> column_names_;
  const granular_c::Kind* kind_ = nullptr;
  std::mutex refresh_mutex_; ///< locked first
  std::mutex offers_mutex_;
  Offers offers_;
};

namespace granular_c
{
/// The operations on files of a kind.
struct Kind
{
  granular_kind kind;
  bool (*is_file)(const std::string& path) noexcept;
  const granular::FileFormat& (*format)() noexcept;
  bool has_bonds;  ///< in table 1
  bool has_pieces; ///< several files may hold one frame
  bool has_parts;  ///< stride, region, coordinates and order can be chosen
  std::vector<OfferedArray> (*arrays)(granular_run& run, std::size_t frame, int table);
  void (*read)(granular_run& run, std::size_t frame, const Wanted& wanted,
    granular::Notices& notices, granular::Progress& progress, granular_frame& to);
};

std::span<const Kind> kinds();
}
#endif
