// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_contact_ends_h
#define granular_contacts_contact_ends_h

#include "granular/contacts/contact_rows.h"
#include "granular/geometry/box.h"
#include "granular/local/minimum_image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// Where the force of a contact acts, seen from the centre of a particle.
enum class LeverArm : std::uint8_t
{
  ContactPoint, ///< at the contact point; where it is not known, at that part of the branch vector that the radii give; where
                ///< they are not known, at half
  Half          ///< at half the branch vector, as compute stress/atom has it
};

struct ContactOptions
{
  LeverArm arm = LeverArm::ContactPoint;
  double least_force = 0;   ///< [N] contacts below it do not count; 0: all count
  double least_overlap = 0; ///< [m] as well
};

/// A contact as a particle feels it.
struct ContactEnd
{
  Vector3 force = {};  ///< on the particle
  Vector3 arm = {};    ///< from its centre to where the force acts
  Vector3 torque = {}; ///< on the particle
  Vector3 normal = {}; ///< towards the other end, of length 1, or 0 if the ends coincide
  double counts = 0;   ///< 1, or 0 for a contact below the least force or overlap
};

/// The particles at the ends of contacts.
struct ContactParticles
{
  const double* points = nullptr; ///< x y z of the first
  std::int64_t point_step = 3;    ///< numbers from one to the next
  const double* radii = nullptr;  ///< of the first; null: not known
  std::int64_t radius_step = 1;

  double radius(std::int64_t place) const noexcept { return radii[place * radius_step]; }
};

/// Contacts between particles that are known here. All views must outlive this.
class ContactEnds
{
public:
  static constexpr std::int64_t nowhere = -1;

  /// places: of both particles of each row, or nowhere; of a wall always nowhere.
  ContactEnds(const ContactRows& rows, const ContactKinds& kinds, const ContactParticles& particles,
    const std::array<std::span<const std::int64_t>, 2>& places, const MinimumImage& images,
    const ContactOptions& options) noexcept;

  std::size_t count() const noexcept { return rows_.count; }

  bool is_wall() const noexcept { return kinds_.walls; }

  /// Returns the particle at end 0 or 1 of a row, or nowhere.
  std::int64_t place(std::size_t row, std::size_t end) const noexcept { return places_[end][row]; }

  /// Returns the vector from the first to the second end: with a wall from the point that is touched to the centre.
  Vector3 branch(std::size_t row) const noexcept;

  /// Returns where the first end is.
  Vector3 first(std::size_t row) const noexcept;

  /// Returns 1, or 0 for a contact below the least force or overlap.
  double counts(std::size_t row) const noexcept;

  Vector3 force(std::size_t row) const noexcept { return of(rows_.force, row); }

  /// Returns the part of the force across the normal over that along it: of the contact's friction, that is in use. 0 without
  /// a force.
  double friction(std::size_t row) const noexcept;

  /// Returns the contact as the particle at an end feels it.
  ContactEnd load(std::size_t row, std::size_t end) const noexcept;

  /// Prefetches what load needs.
  void prefetch(std::size_t row) const noexcept
  {
    __builtin_prefetch(rows_.force.data() + 3 * row);
    __builtin_prefetch(rows_.ends.data() + 6 * row);
    __builtin_prefetch(rows_.contact_point.data() + 3 * row);
  }

private:
  static Vector3 of(std::span<const double> values, std::size_t row) noexcept
  {
    return values.empty() ? Vector3{}
                          : Vector3{ values[3 * row], values[3 * row + 1], values[3 * row + 2] };
  }

  Vector3 centre(std::size_t row, std::size_t end) const noexcept;
  Vector3 arm(std::size_t row, std::size_t end, const Vector3& branch) const noexcept;

  const ContactRows& rows_;
  ContactKinds kinds_;
  ContactParticles particles_;
  std::array<std::span<const std::int64_t>, 2> places_;
  const MinimumImage& images_;
  ContactOptions options_;
};
}
#endif
