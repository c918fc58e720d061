// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_contact_terms_h
#define granular_contacts_contact_terms_h

#include "granular/contacts/contact_sums.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace granular
{
/// What of the contacts is summed, and where its terms are among those of a contact.
struct ContactTerms
{
  static constexpr std::size_t most = 18;

  explicit ContactTerms(const ContactSumsRequest& request, bool forces) noexcept
    : force(forces && request.force)
    , torque(forces && request.torque)
    , fabric(request.fabric)
    , stress(forces && (request.stress || request.principal_stress || request.von_mises))
    , count((force ? 3U : 0U) + (torque ? 3U : 0U) + (fabric ? 6U : 0U) + (stress ? 6U : 0U))
  {
  }

  /// Writes the terms of a contact.
  void make(const ContactEnd& contact, double* to) const noexcept
  {
    if (force)
    {
      to = std::copy_n(contact.force.data(), 3, to);
    }
    if (torque)
    {
      to = std::copy_n(contact.torque.data(), 3, to);
    }
    if (fabric)
    {
      const auto& [x, y, z] = contact.normal;
      const double counts = contact.counts;
      to = std::copy_n(std::array{ counts * x * x, counts * y * y, counts * z * z, counts * x * y,
                         counts * x * z, counts * y * z }
                         .data(),
        6, to);
    }
    if (stress)
    {
      const auto& [x, y, z] = contact.arm;
      const auto& [fx, fy, fz] = contact.force;
      std::copy_n(std::array{ x * fx, y * fy, z * fz, x * fy, x * fz, y * fz }.data(), 6, to);
    }
  }

  bool force;
  bool torque;
  bool fabric;
  bool stress;
  std::size_t count;
};
}
#endif
