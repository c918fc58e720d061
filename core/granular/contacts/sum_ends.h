// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_sum_ends_h
#define granular_contacts_sum_ends_h

#include "granular/common/progress.h"
#include "granular/contacts/contact_sums.h"
#include "granular/parallel/executor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace granular
{
/// Contacts that count, and those of them that have a normal.
struct Counted
{
  std::int32_t contacts = 0;
  std::int32_t normals = 0;
};

/// Terms that one end of a contact adds to the sums of its particle.
struct EndTerms
{
  static constexpr std::size_t most = 18;

  Counted counted;
  std::array<double, most> terms;
};

/// Sums over contacts that are wanted, and places of their terms among those of a contact.
struct ContactTerms
{
  explicit ContactTerms(const ContactSumsRequest& request, bool forces) noexcept
    : force(forces && request.force)
    , torque(forces && request.torque)
    , fabric(request.fabric)
    , stress(forces && (request.stress || request.principal_stress || request.von_mises))
    , count((force ? 3U : 0U) + (torque ? 3U : 0U) + (fabric ? 6U : 0U) + (stress ? 6U : 0U))
  {
  }

  /// Makes the terms of a contact for the particles at its ends; of an end that is null nobody wants them.
  void make(
    const ContactEnds& ends, std::size_t row, const std::array<EndTerms*, 2>& to) const noexcept
  {
    const double counts = ends.counts(row);
    if (count == 0)
    {
      for (EndTerms* const end : to)
      {
        if (end)
        {
          end->counted = { counts != 0 ? 1 : 0, 0 };
        }
      }
      return;
    }
    const bool line = (torque || fabric || stress) && ends.has_line(row);
    const Vector3 branch = line ? ends.branch(row) : Vector3{};
    const Vector3 normal = fabric ? ContactEnds::normal(branch) : Vector3{};
    const Counted counted = { counts != 0 ? 1 : 0, counts != 0 && normal != Vector3{} ? 1 : 0 };
    const EndLoad first = to[0] ? this->load_at(ends, row, 0, line, branch) : EndLoad{};
    const EndLoad second = to[1] ? this->load_at(ends, row, 1, line, branch) : EndLoad{};
    if (to[0])
    {
      this->write(counted, counts, normal, first, *to[0]);
    }
    if (to[1])
    {
      this->write(counted, counts, normal, second, *to[1]);
    }
  }

  bool force;
  bool torque;
  bool fabric;
  bool stress;
  std::size_t count;

private:
  /// The load of a contact on the particle at one end.
  struct EndLoad
  {
    Vector3 force;
    Vector3 arm;
    Vector3 torque;
  };

  EndLoad load_at(const ContactEnds& ends, std::size_t row, std::size_t end, bool line,
    const Vector3& branch) const noexcept
  {
    const Vector3 arm = line && (torque || stress) ? ends.arm(row, end, branch) : Vector3{};
    return { force || stress ? ends.force(row, end) : Vector3{}, arm,
      line && torque ? ends.torque(row, end, branch, arm) : Vector3{} };
  }

  void write(const Counted& counted, double counts, const Vector3& normal, const EndLoad& load,
    EndTerms& to) const noexcept
  {
    double* next = to.terms.data();
    to.counted = counted;
    if (force)
    {
      next = write(load.force, next);
    }
    if (torque)
    {
      next = write(load.torque, next);
    }
    if (fabric)
    {
      next = write_products(
        { counts * normal[0], counts * normal[1], counts * normal[2] }, normal, next);
    }
    if (stress)
    {
      write_products(load.arm, load.force, next);
    }
  }

  // value by value: a copy of what has just been written in parts would wait for all of them
  static double* write(const Vector3& a, double* to) noexcept
  {
    to[0] = a[0];
    to[1] = a[1];
    to[2] = a[2];
    return to + 3;
  }
  static double* write_products(const Vector3& a, const Vector3& b, double* to) noexcept
  {
    to[0] = a[0] * b[0];
    to[1] = a[1] * b[1];
    to[2] = a[2] * b[2];
    to[3] = a[0] * b[1];
    to[4] = a[0] * b[2];
    to[5] = a[1] * b[2];
    return to + 6;
  }
};

/// Ends of contacts.
struct EndSource
{
  std::span<const std::int64_t> places; ///< the particles of all ends, or negative numbers

  /// Makes the terms of some ends. May be called from any thread.
  std::function<void(std::span<const std::size_t> ends, EndTerms* terms)> read;
};

/// Sums the ends of each particle. rows: particles. Memory comes from the pool of the request. Throws Cancelled,
/// std::bad_alloc.
ContactSums sum_ends(const EndSource& source, std::int64_t rows, const ContactTerms& terms,
  const ContactSumsRequest& request, const Executor& executor, Progress& progress);
}
#endif
