// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_average_passes_h
#define granular_averages_average_passes_h

#include "granular/averages/average.h"
#include "granular/averages/block_sums.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/sorting/block_rows.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// The passes of an average over the particles. The first pass finds the magnitudes of the numbers and the blocks of
/// cells that each particle touches. Then, for some blocks at a time, the second pass makes the sums, and the third,
/// with the mean velocities known, the sums for the stress. All ranks work on the same blocks at the same time.
class AveragePasses
{
public:
  /// rows: the number of rows of all ranks.
  AveragePasses(const FrameView& frame, const ParticleSources& sources, std::int64_t rows,
    const EulerAverageRequest& request, Communicator& ranks, const Executor& executor,
    Progress& progress);

  EulerAverages run();

private:
  struct Batch;

  enum class Pass : std::uint8_t
  {
    Means,
    Stress
  };

  using Group = BlockSums::Group;
  using Part = BlockSums::Part;

  /// The shares of a part, kept as long as there are not too many.
  struct KeptShares
  {
    struct Share
    {
      double share;
      std::uint32_t particle; ///< from the first of the part
      std::int16_t cell;
    };

    std::size_t most = 0;
    std::vector<Share> shares = {};
    bool complete = true;

    void add(std::uint64_t particle, std::int64_t cell, double share)
    {
      complete = complete && shares.size() < most && particle <= UINT32_MAX;
      if (complete)
      {
        shares.push_back(
          { share, static_cast<std::uint32_t>(particle), static_cast<std::int16_t>(cell) });
      }
    }
  };

  void scan();
  void plan();
  void make_cells();
  void locate();
  template <class Take>
  void each_block(std::size_t chunks, const Take& take);
  void sum_group(const Group& group);
  template <class MakeTerms>
  void add_particles(Pass pass, const Group& group, const MakeTerms& make_terms);
  template <class Take>
  void each_batch(Pass pass, const Part& part, Batch& batch, KeptShares& kept, const Take& take);
  bool find_cells(std::int64_t place, const CellRange& range, Pass pass, Batch& batch);
  void finish_means(const Group& group);
  double stress_scale(const SumScale::Terms& sums) const noexcept;
  void finish_stress(const Group& group);
  const FrameView& frame_;
  const std::int64_t rows_;
  const EulerAverageRequest& request_;
  Communicator& ranks_;
  const Executor& executor_;
  PartialProgress progress_;
  ParticleLoader particles_;
  ParticleCells cells_;
  BlockSums blocks_;
  bool stress_;  ///< there is one on some rank
  bool tensors_; ///< are wanted

  ParticleLoader::Scan scanned_;
  double largest_mass_ = 1; ///< or 1, if all are 0
  int mass_top_ = 0;        ///< all masses are below 2^mass_top
  int speed_top_ = 0;       ///< see ParticleBlock::speed
  std::vector<std::int16_t>
    found_; ///< cells of the rows of all blocks, where each has one; else empty
  SumScale sums_{ {}, 1 };
  SumScale stresses_{ {}, 1 };
  std::vector<KeptShares> kept_; ///< of each part of a group
  /// The mean velocity of a cell, and the power of two that makes the terms of its stress less than 1.
  struct Mean
  {
    Vector3 velocity;
    double scale;
  };

  std::vector<Mean> means_;
  std::vector<double> masses_; ///< of these, for temperatures
  std::int64_t outside_ = 0;   ///< particles without a share in the last pass over this rank's
  EulerAverages result_;
};
}
#endif
