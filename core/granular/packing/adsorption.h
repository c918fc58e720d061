// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_adsorption_h
#define granular_packing_adsorption_h

#include "granular/packing/adsorption_grid.h"
#include "granular/packing/arrivals.h"
#include "granular/parallel/executor.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// Random sequential adsorption: particles arrive one after the other at random places, and a particle stays if it
/// overlaps no earlier one that stayed. That depends only on the few particles that arrived nearby, so any shelves of
/// the box can be computed alone, with a margin around them. The outcome beyond the margin is unknown; where it
/// matters, the outcome inside is unknown too, and this may spread to the shelves themselves. A wider margin is needed
/// then.
class Adsorption
{
public:
  struct Grain
  {
    Vector3 at; ///< from the origin of the box
    double radius;
    std::int32_t size_class;
    std::int32_t next; ///< in the same cell, or none
  };

  /// Prepares the shelves from first to last - 1, with a margin of this many largest diameters.
  Adsorption(const AdsorptionGrid& grid, std::int64_t first, std::int64_t last, double margin);

  /// Lets the new rounds arrive, the last one without settling which particles stay, because its end may change.
  /// Returns false if anything in the shelves is unknown; the object is then useless. Throws Cancelled.
  bool follow(const std::vector<Arrivals>& rounds, const Executor& executor, Progress& progress);

  /// Returns the arrival times of the particles of the last round that stay, in the shelves.
  std::vector<std::uint64_t> moments() const;

  /// Settles which particles of the last round stay.
  void finish(const std::vector<Arrivals>& rounds, const Executor& executor);

  /// Returns true if these shelves were computed and nothing in them is unknown.
  bool has(std::int64_t first, std::int64_t last) const noexcept;

  /// Returns the particles that stay in a layer, in the same order for any shelves and threads. The layer must have
  /// been computed.
  const std::vector<Grain>& grains(std::size_t level, std::int64_t layer) const noexcept
  {
    return this->find(level, layer)->grains;
  }

private:
  static constexpr std::int32_t none = -1;

  enum Fate : std::uint8_t
  {
    Open,
    Stays,
    Leaves,
    Unknown
  };

  /// A particle that overlaps none of those that stayed in earlier rounds.
  struct Fresh
  {
    Vector3 scaled; ///< in the order of axes
    Vector3 at;
    std::uint64_t moment;
    std::int32_t cell;
    std::int32_t next;
    bool dim; ///< near to what is unknown
  };

  struct Layer
  {
    std::vector<Grain> grains;
    std::vector<std::int32_t> first;   ///< grain of each cell
    std::vector<std::uint8_t> unknown; ///< cells
    std::vector<Fresh> fresh;
    std::vector<std::int32_t> first_fresh; ///< of each cell
    mutable std::vector<std::atomic<std::uint8_t>>
      fates;          ///< found when asked for, by any thread the same
    bool dim = false; ///< anything is unknown
  };

  struct Level
  {
    std::int64_t begin = 0; ///< the first layer that is here; they go on through a periodic face
    std::vector<Layer> layers;
  };

  const Layer* find(std::size_t level, std::int64_t layer) const noexcept;
  template <class Visit>
  bool any_near(std::size_t level, const Vector3& scaled, const Vector3& at, double distance,
    const Visit& visit) const;
  static bool blocks(
    const Layer& layer, std::size_t cell, const Vector3& at, double clear) noexcept;
  bool has_room(Fresh& fresh, const Arrivals& round, const Layer& layer) const;
  void arrive(const Arrivals& round, std::int64_t layer, std::int64_t line, Layer& to) const;
  Fate fate(const Arrivals& round, const Layer& layer, std::size_t index) const;
  void settle(const Arrivals& round, Layer& layer) const;
  void keep(const Arrivals& round, Layer& layer) const;
  template <class Work>
  void for_layers(
    const Arrivals& round, const Executor& executor, Progress& progress, const Work& work);

  const AdsorptionGrid& grid_;
  std::int64_t first_;
  std::int64_t last_;
  std::vector<Level> levels_;
  std::size_t rounds_ = 0; ///< that have arrived
  bool settled_ = true;    ///< the last of them
};
}
#endif
