// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/contact_ends.h"

namespace granular
{
double ContactEnds::is_enough(std::size_t row) const noexcept
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
    else if (this->place(row, 1) == nowhere || (this->place(row, 0) == nowhere && !kinds_.walls))
    {
      return 1; // with a particle that is not there: nobody knows
    }
    else
    {
      overlap = -length_of(this->branch(row));
      overlap += kinds_.walls ? 0 : particles_.radius(this->place(row, 0));
      overlap += particles_.radius(this->place(row, 1));
    }
    return overlap >= options_.least_overlap ? 1 : 0;
  }
  return 1;
}

/// Returns the part of the branch vector up to where the force acts.
double ContactEnds::part(std::size_t row, std::size_t end) const noexcept
{
  const std::int64_t own = this->place(row, end);
  const std::int64_t other = this->place(row, 1 - end);
  if (!particles_.radii || options_.arm == LeverArm::Half || own == nowhere || other == nowhere)
  {
    return 0.5;
  }
  const double radius = particles_.radius(own);
  const double sum = radius + particles_.radius(other);
  return sum > 0 ? radius / sum : 0.5;
}

double ContactEnds::friction(std::size_t row) const noexcept
{
  const Vector3 force = of(rows_.force, row);
  Vector3 across = of(rows_.tangential, row);
  if (!kinds_.tangential)
  {
    const Vector3 along = normal(this->branch(row));
    across = minus(force, times(dot(force, along), along));
  }
  const double tangential = length_of(across);
  return tangential == 0 ? 0 : tangential / length_of(minus(force, across));
}
}
