// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_contact_input_h
#define granular_contacts_contact_input_h

#include "granular/common/progress.h"
#include "granular/contacts/contact_rows.h"
#include "granular/lines/line_rows.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace granular
{
/// Arrays that are read of contacts, besides ids and places.
struct ContactArrays
{
  bool force = true;
  bool tangential = false;
  bool torque = false;
  bool point = false;
  bool overlap = false;
};

/// An input of contacts in memory of others.
struct ContactSource
{
  const LineRows* rows = nullptr; ///< null: there is no such input

  /// Returns the absolute places of the first and the last point of each cell, six numbers; none for rows without places.
  std::function<std::vector<double>()> read_ends;
  std::optional<std::int64_t> timestep = {};
};

/// Contacts between particles, and those with walls.
using ContactSources = std::array<ContactSource, 2>;

/// The contacts of an input. Nothing is copied that lies in memory as it is wanted.
class ContactInput
{
public:
  /// walls: rows name one particle, id2, which touches a wall, whose place is read in any case; otherwise two, id1 and id2. Arrays are
  /// read if they are there: `force`, or else the sum of `force_normal` and `force_tangential`; `torque`, `contact_point`, `delta`.
  /// Throws Error if ids are missing or arrays have other numbers; Cancelled; what read_ends throws.
  ContactInput(
    const ContactSource& source, bool walls, const ContactArrays& wanted, Progress& progress);
  ContactInput(const ContactInput&) = delete;
  void operator=(const ContactInput&) = delete;

  const ContactRows& rows() const { return view_; }

private:
  void read_ends(const ContactSource& source);
  void read_forces(const LineRows& rows, const ContactArrays& wanted);

  std::array<std::vector<std::int64_t>, 2> ids_;
  std::vector<double> ends_;
  std::vector<double> force_;
  std::vector<double> tangential_;
  std::vector<double> torque_;
  std::vector<double> point_;
  std::vector<double> overlap_;
  ContactRows view_;
};

/// The contacts of two inputs.
struct ContactInputs
{
  /// Throws what ContactInput throws.
  ContactInputs(const ContactSources& sources, const ContactArrays& wanted, Progress& progress);

  std::array<std::optional<ContactInput>, 2> each;
  std::vector<ContactRows> rows; ///< of those that are there
};
}
#endif
