// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_sum_ends_h
#define granular_contacts_sum_ends_h

#include "granular/common/progress.h"
#include "granular/contacts/contact_sums.h"
#include "granular/contacts/contact_terms.h"
#include "granular/parallel/executor.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// Ends of contacts.
class EndSource
{
public:
  virtual ~EndSource() = default;

  /// Returns the particles of all ends, or negative numbers.
  virtual std::span<const std::int64_t> places() const noexcept = 0;

  /// Makes the terms of some ends. May be called from any thread.
  virtual void read(std::span<const std::size_t> ends, EndTerms* terms) const noexcept = 0;
};

/// Sums the ends of each particle. rows: particles. Memory comes from the pool of the request. Throws Cancelled,
/// std::bad_alloc.
ContactSums sum_ends(const EndSource& source, std::int64_t rows, const ContactTerms& terms,
  const ContactSumsRequest& request, const Executor& executor, Progress& progress);
}
#endif
