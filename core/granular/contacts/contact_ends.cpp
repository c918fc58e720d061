// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/contact_ends.h"

namespace granular
{
namespace
{
Vector3 operator-(const Vector3& a, const Vector3& b) noexcept
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector3 operator-(const Vector3& a) noexcept
{
  return { -a[0], -a[1], -a[2] };
}

Vector3 operator*(double factor, const Vector3& a) noexcept
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

Vector3 direction_of(const Vector3& vector) noexcept
{
  const double length = length_of(vector);
  return length > 0 ? Vector3{ vector[0] / length, vector[1] / length, vector[2] / length }
                    : Vector3{};
}
}

ContactEnds::ContactEnds(const ContactRows& rows, const ContactKinds& kinds,
  const ContactParticles& particles, const std::array<std::span<const std::int64_t>, 2>& places,
  const MinimumImage& images, const ContactOptions& options) noexcept
  : rows_(rows)
  , kinds_(kinds)
  , particles_(particles)
  , places_(places)
  , images_(images)
  , options_(options)
{
}

Vector3 ContactEnds::centre(std::size_t row, std::size_t end) const noexcept
{
  if (kinds_.ends)
  {
    const double* const from = rows_.ends.data() + 6 * row + 3 * end;
    return { from[0], from[1], from[2] };
  }
  const double* const from = particles_.points + this->place(row, end) * particles_.point_step;
  return { from[0], from[1], from[2] };
}

Vector3 ContactEnds::first(std::size_t row) const noexcept
{
  return kinds_.walls && !kinds_.ends ? of(rows_.contact_point, row) : this->centre(row, 0);
}

Vector3 ContactEnds::branch(std::size_t row) const noexcept
{
  const Vector3 first = this->first(row);
  const Vector3 second = this->centre(row, 1);
  const Vector3 direct = second - first;
  return kinds_.ends ? direct : images_.moved(second, images_.find(direct), first);
}

double ContactEnds::counts(std::size_t row) const noexcept
{
  if (options_.least_force > 0 && kinds_.force)
  {
    if (!(length_of(of(rows_.force, row)) >= options_.least_force))
    {
      return 0;
    }
  }
  if (options_.least_overlap > 0)
  {
    double overlap = 0;
    if (kinds_.overlap)
    {
      overlap = rows_.overlap[row];
    }
    else
    {
      overlap = -length_of(this->branch(row));
      for (std::size_t end = 0; end < 2; ++end)
      {
        const std::int64_t place = this->place(row, end);
        overlap += place == nowhere ? 0 : particles_.radius(place);
      }
    }
    return overlap >= options_.least_overlap ? 1 : 0;
  }
  return 1;
}

/// From the centre of the particle at an end.
Vector3 ContactEnds::arm(std::size_t row, std::size_t end, const Vector3& branch) const noexcept
{
  if (kinds_.contact_point && options_.arm == LeverArm::ContactPoint)
  {
    const Vector3 centre = this->centre(row, end);
    const Vector3 point = of(rows_.contact_point, row);
    return images_.moved(point, images_.find(point - centre), centre);
  }
  if (kinds_.walls)
  {
    return -branch;
  }
  double part = 0.5;
  if (particles_.radii && options_.arm == LeverArm::ContactPoint)
  {
    const std::int64_t own = this->place(row, end);
    const std::int64_t other = this->place(row, 1 - end);
    if (own != nowhere && other != nowhere)
    {
      const double radius = particles_.radius(own);
      const double sum = radius + particles_.radius(other);
      part = sum > 0 ? radius / sum : part;
    }
  }
  const Vector3 arm = part * branch;
  return end == 0 ? arm : -arm;
}

ContactEnd ContactEnds::load(std::size_t row, std::size_t end) const noexcept
{
  ContactEnd contact;
  const Vector3 branch = this->branch(row);
  const Vector3 force = of(rows_.force, row);
  const bool second = end == 1 && !kinds_.walls; // the other particle feels the opposite
  contact.counts = this->counts(row);
  contact.arm = this->arm(row, end, branch);
  contact.force = second ? -force : force;
  contact.normal = direction_of(kinds_.walls ? contact.arm : second ? -branch : branch);
  if (!kinds_.torque)
  {
    contact.torque = cross(contact.arm, contact.force);
  }
  else if (!second)
  {
    contact.torque = of(rows_.torque, row);
  }
  else // both together have the moment of the two forces, which have the branch vector between them
  {
    contact.torque = cross(branch, force) - of(rows_.torque, row);
  }
  return contact;
}

double ContactEnds::friction(std::size_t row) const noexcept
{
  const Vector3 force = of(rows_.force, row);
  Vector3 across = of(rows_.tangential, row);
  if (!kinds_.tangential)
  {
    const Vector3 normal = this->load(row, 1).normal;
    across = force - dot(force, normal) * normal;
  }
  const double tangential = length_of(across);
  return tangential == 0 ? 0 : tangential / length_of(force - across);
}
}
