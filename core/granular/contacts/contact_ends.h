// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_contact_ends_h
#define granular_contacts_contact_ends_h

#include "granular/contacts/contact_rows.h"
#include "granular/geometry/box.h"
#include "granular/lines/minimum_image.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// Place where the force of a contact acts, seen from the centre of a particle.
enum class LeverArm : std::uint8_t
{
  ContactPoint, ///< at the contact point; where it is not known, at that part of the branch vector that the radii give; where
                ///< they are not known, at half
  Half ///< at half the branch vector, as compute stress/atom has it; of walls where they are touched
};

struct ContactOptions
{
  LeverArm arm = LeverArm::ContactPoint;
  double least_force = 0;   ///< [N] contacts below it do not count; 0: all count
  double least_overlap = 0; ///< [m] as well
};

/// The particles at the ends of contacts.
struct ContactParticles
{
  const double* points = nullptr; ///< x y z of the first; null: the ends of lines count
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
    std::span<const std::int64_t> places, const MinimumImage& images,
    const ContactOptions& options) noexcept
    : rows_(rows)
    , kinds_(kinds)
    , particles_(particles)
    , places_(places)
    , images_(images)
    , options_(options)
  {
  }

  std::size_t count() const noexcept { return rows_.count; }

  bool is_wall() const noexcept { return kinds_.walls; }

  /// Returns the particle at end 0 or 1 of a row, or nowhere.
  std::int64_t place(std::size_t row, std::size_t end) const noexcept
  {
    return places_[2 * row + end];
  }

  /// Returns true for a contact of a particle known here that has two known ends. Without them only its force is known.
  bool has_line(std::size_t row) const noexcept
  {
    const bool first = this->place(row, 0) != nowhere;
    const bool second = this->place(row, 1) != nowhere;
    return kinds_.ends ? first || second : second && (first || kinds_.walls);
  }

  /// Returns where the first end is, of a contact that has a line; here and below.
  Vector3 first(std::size_t row) const noexcept
  {
    return kinds_.walls && !kinds_.ends ? of(rows_.contact_point, row) : this->centre(row, 0);
  }

  /// Returns the shortest vector from the first to the second end: with a wall from the point that is touched to the centre.
  /// A particle that touches its own image is as far from it as the line is long.
  Vector3 branch(std::size_t row) const noexcept
  {
    if (kinds_.ends && this->place(row, 0) == this->place(row, 1))
    {
      return minus(this->drawn(row, 1), this->drawn(row, 0));
    }
    const Vector3 first = this->first(row);
    const Vector3 second = this->centre(row, 1);
    return images_.moved(second, images_.find(minus(second, first)), first);
  }

  /// Returns 1, or 0 for a contact below the least force or overlap.
  double counts(std::size_t row) const noexcept
  {
    return options_.least_force > 0 || options_.least_overlap > 0 ? this->is_enough(row) : 1;
  }

  /// Returns the force on the first particle, of a wall on the particle.
  Vector3 force(std::size_t row) const noexcept { return of(rows_.force, row); }

  /// Returns the force on the particle at an end.
  Vector3 force(std::size_t row, std::size_t end) const noexcept
  {
    return this->turned(end, this->force(row));
  }

  /// Returns the vector from the centre of the particle at an end to where the force acts. branch: of the row, here and below.
  Vector3 arm(std::size_t row, std::size_t end, const Vector3& branch) const noexcept
  {
    if (kinds_.contact_point && options_.arm == LeverArm::ContactPoint)
    {
      const Vector3 centre = this->centre(row, end);
      const Vector3 point = of(rows_.contact_point, row);
      return images_.moved(point, images_.find(minus(point, centre)), centre);
    }
    return kinds_.walls ? negative(branch) : this->turned(end, times(this->part(row, end), branch));
  }

  /// Returns the torque on the particle at an end. Both together have the moment of the two forces, which have the branch
  /// vector between them.
  Vector3 torque(
    std::size_t row, std::size_t end, const Vector3& branch, const Vector3& arm) const noexcept
  {
    if (!kinds_.torque)
    {
      return cross(arm, this->force(row, end));
    }
    const Vector3 of_first = of(rows_.torque, row);
    return this->is_other(end) ? minus(cross(branch, this->force(row)), of_first) : of_first;
  }

  /// Returns the vector of length 1 from the second end to the first one, which may be at a wall; 0 if the ends coincide.
  static Vector3 normal(const Vector3& branch) noexcept
  {
    const double length = length_of(branch);
    return length > 0 ? Vector3{ -branch[0] / length, -branch[1] / length, -branch[2] / length }
                      : Vector3{};
  }

  /// Returns the part of the force across the normal over that along it: of the contact's friction, that is in use. 0 without
  /// a force.
  double friction(std::size_t row) const noexcept;

private:
  static Vector3 negative(const Vector3& a) noexcept { return { -a[0], -a[1], -a[2] }; }
  static Vector3 times(double factor, const Vector3& a) noexcept
  {
    return { factor * a[0], factor * a[1], factor * a[2] };
  }
  static Vector3 of(std::span<const double> values, std::size_t row) noexcept
  {
    return values.empty() ? Vector3{}
                          : Vector3{ values[3 * row], values[3 * row + 1], values[3 * row + 2] };
  }

  /// Returns true at the end whose particle feels the opposite of what the first one feels.
  bool is_other(std::size_t end) const noexcept { return end == 1 && !kinds_.walls; }
  Vector3 turned(std::size_t end, const Vector3& a) const noexcept
  {
    return this->is_other(end) ? negative(a) : a;
  }

  Vector3 drawn(std::size_t row, std::size_t end) const noexcept
  {
    const double* const from = rows_.ends.data() + 6 * row + 3 * end;
    return { from[0], from[1], from[2] };
  }

  Vector3 centre(std::size_t row, std::size_t end) const noexcept
  {
    const std::int64_t place = this->place(row, end);
    if (kinds_.ends && (!particles_.points || place == nowhere))
    {
      return this->drawn(row, end);
    }
    const double* const from = particles_.points + place * particles_.point_step;
    return { from[0], from[1], from[2] };
  }

  double is_enough(std::size_t row) const noexcept;
  double part(std::size_t row, std::size_t end) const noexcept;

  const ContactRows& rows_;
  ContactKinds kinds_;
  ContactParticles particles_;
  std::span<const std::int64_t> places_; ///< two a row
  const MinimumImage& images_;
  ContactOptions options_;
};
}
#endif
