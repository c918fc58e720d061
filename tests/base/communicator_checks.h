// SPDX-License-Identifier: BSD-3-Clause
// What every communicator must do, called on all of its ranks.
#ifndef granular_tests_base_communicator_checks_h
#define granular_tests_base_communicator_checks_h

#include "granular/base/communicator.h"

void check_broadcast(granular::Communicator& ranks);
void check_all_gather(granular::Communicator& ranks);
void check_sum(granular::Communicator& ranks);
void check_exchange(granular::Communicator& ranks);
void check_agree(granular::Communicator& ranks);

#endif
