// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_slab_finder_h
#define granular_decomposition_slab_finder_h

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Finds the slab between cuts that holds a coordinate: lo <= x < hi, in the last one x <= hi, and where cuts
/// coincide the last that begins there. Comparisons with the cuts alone decide. Bins only say which cut to compare
/// with: the number of a bin never falls as x grows, however it is rounded, so that all cuts in lower bins are
/// below x, and all in higher ones above.
class SlabFinder
{
public:
  /// cuts: finite, none below the one before; fewer than two make no slab.
  explicit SlabFinder(std::span<const double> cuts);

  /// The number of the slab, or below 0: search must look.
  std::int32_t guess(double x) const noexcept
  {
    const Bin& bin = bins_[this->bin_of(x)];
    return bin.slab + static_cast<std::int32_t>(x >= bin.cut);
  }

  /// The number of the slab, or -1: none holds the coordinate.
  std::int32_t search(double x) const noexcept;

private:
  struct Bin
  {
    double cut;        ///< the only one in the bin, or infinity
    std::int32_t slab; ///< below it, or search
  };

  /// Also of what is outside or no number.
  std::size_t bin_of(double x) const noexcept
  {
    double bin = (x - origin_) * scale_;
    bin = bin > 0 ? bin : 0;
    bin = bin < last_ ? bin : last_;
    return static_cast<std::size_t>(static_cast<std::int64_t>(bin));
  }

  double origin_ = 0;
  double scale_ = 0; ///< bins a unit of length
  double last_ = 0;  ///< bin
  std::vector<Bin> bins_;
  std::vector<double> cuts_;
};
}
#endif
