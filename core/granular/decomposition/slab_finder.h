// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_slab_finder_h
#define granular_decomposition_slab_finder_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Finds the slab between cuts that holds a coordinate: lo <= x < hi, in the last one x <= hi, and where cuts coincide the
/// last that begins there. Only comparisons with the cuts decide; bins tell which cut to compare with. The number of a bin
/// never falls as x grows, in any rounding, so all cuts in lower bins are below x, and all in higher ones above.
class SlabFinder
{
  struct Bin
  {
    double cut;        ///< the only one in the bin, or infinity
    std::int32_t slab; ///< below it, or search
  };

public:
  /// The bins: few enough numbers for a loop to keep them in registers.
  class Guess
  {
  public:
    /// Returns the number of the slab, or below 0 if search must find it.
    std::int32_t operator()(double x) const noexcept
    {
      const Bin& bin = bins_[this->bin_of(x)];
      return bin.slab + static_cast<std::int32_t>(x >= bin.cut);
    }

  private:
    friend SlabFinder;

    /// Accepts coordinates outside, and nan.
    std::size_t bin_of(double x) const noexcept
    {
      const double bin = std::min(last_, std::max(0.0, (x - origin_) * scale_)); // nan becomes 0
      return static_cast<std::size_t>(static_cast<std::int64_t>(bin));
    }

    double origin_ = 0;
    double scale_ = 0; ///< bins a unit of length
    double last_ = 0;  ///< bin
    const Bin* bins_ = nullptr;
  };

  /// cuts: finite, not decreasing; fewer than two make no slab.
  explicit SlabFinder(std::span<const double> cuts);

  /// Valid as long as this stays where it is.
  Guess guess() const noexcept
  {
    Guess guess = guess_;
    guess.bins_ = bins_.data();
    return guess;
  }

  /// Returns the number of the slab, or -1 if none holds the coordinate.
  std::int32_t search(double x) const noexcept;

private:
  Guess guess_;
  std::vector<Bin> bins_;
  std::vector<double> cuts_;
};
}
#endif
