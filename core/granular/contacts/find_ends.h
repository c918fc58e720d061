// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_find_ends_h
#define granular_contacts_find_ends_h

#include "granular/common/progress.h"
#include "granular/contacts/contact_ends.h"
#include "granular/contacts/contact_rows.h"
#include "granular/lines/fetch_particles.h"
#include "granular/lines/id_finder.h"
#include "granular/lines/minimum_image.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
/// A contact that counts, between two particles of a list, or one and a wall or a particle that is not there (-1).
using ContactPair = std::array<std::int64_t, 2>;

/// The particles that do not bear, and the contacts of those that do.
struct Rattlers
{
  std::vector<unsigned char> are; ///< 1 for a rattler, of each particle of this rank
  std::vector<std::int32_t>
    contacts; ///< of each with particles that are no rattlers and with walls; 0 for rattlers
};

/// Finds the particles of this rank with fewer contacts than `least`, and those that have fewer without the contacts of those
/// found before, until all that are left have as many. homes: of a list of particles, which pairs name; those without a home
/// are in no pair. coordination: of the particles of this rank. Collective.
Rattlers find_rattlers(std::span<const ParticleHome> homes, std::span<const ContactPair> pairs,
  std::span<const std::int32_t> coordination, std::int32_t least, Communicator& ranks,
  Progress& progress);

/// Returns the radii of all particles of this rank, from an array of radii or diameters; none where there is no such array.
/// Throws Error for texts.
std::vector<double> load_radii(const FrameView& particles, const std::string& name);

/// The contacts of this rank with the particles at their ends, which may be those of other ranks. The particles and the rows
/// must outlive this.
class FoundEnds
{
public:
  /// radius: the array of radii, by which the place of a contact that is not given is found; without it that is half the
  /// branch. pool: source of the memory; may be null. Throws Error: see sum_contacts. Collective.
  FoundEnds(const FrameView& particles, std::span<const ContactRows> inputs,
    const std::string& radius, const ContactOptions& options, Communicator& ranks,
    const Executor& executor, Progress& progress, const std::shared_ptr<BlockPool>& pool = nullptr);
  FoundEnds(const FoundEnds&) = delete;
  void operator=(const FoundEnds&) = delete;

  /// Returns the number of contacts of all inputs.
  std::size_t rows() const noexcept { return rows_; }

  /// Returns where a contact is, which is counted over all inputs.
  std::pair<const ContactEnds&, std::size_t> at(std::int64_t contact) const noexcept
  {
    auto row = static_cast<std::size_t>(contact);
    std::size_t i = 0;
    while (row >= inputs_[i].count())
    {
      row -= inputs_[i++].count();
    }
    return { inputs_[i], row };
  }

  /// Returns the particles of both ends of each contact, or -1: nowhere.
  std::span<const std::int64_t> places() const noexcept
  {
    return { static_cast<const std::int64_t*>(places_.data()), 2 * rows_ };
  }

  /// Returns the homes of the particles that places are of; those of a single rank are its rows.
  std::vector<ParticleHome> homes() const;

  /// Returns true if contacts have forces, or if there are none.
  bool have_forces() const noexcept { return forces_; }

  // rows of this rank: see ContactSums
  std::int64_t missing() const noexcept { return missing_; }
  std::int64_t unplaced() const noexcept { return unplaced_; }
  std::int64_t broken() const noexcept { return broken_; }
  std::int64_t repeated() const noexcept { return repeated_; } ///< particles known here

private:
  void find_places(const IdFinder& finder, const ContactRows& rows, const ContactKinds& kinds,
    const ContactParticles& particles, const ContactOptions& options,
    std::span<std::int64_t> places, const Executor& executor, Progress& progress);

  MinimumImage images_;
  std::vector<double> radii_;       ///< of the particles of this rank
  ParticleValues own_;              ///< of these
  FetchedParticles fetched_;        ///< with several ranks
  std::vector<ParticleHome> homes_; ///< of the fetched
  std::int64_t own_rows_ = 0;       ///< with a single rank
  Block places_;
  std::vector<ContactEnds> inputs_;
  std::size_t rows_ = 0;
  bool forces_ = true;
  std::int64_t missing_ = 0;
  std::int64_t unplaced_ = 0;
  std::int64_t broken_ = 0;
  std::int64_t repeated_ = 0;
};
}
#endif
