// SPDX-License-Identifier: BSD-3-Clause
// What every communicator must do, called on all of its ranks.
#ifndef granular_tests_support_communicator_checks_h
#define granular_tests_support_communicator_checks_h

#include "granular/parallel/communicator.h"

#include <string>

void check_broadcast(granular::Communicator& ranks);
void check_all_gather(granular::Communicator& ranks);
void check_sum(granular::Communicator& ranks);
void check_exchange(granular::Communicator& ranks);
void check_agree(granular::Communicator& ranks);
void check_send(granular::Communicator& ranks);
void check_send_without_memory(granular::Communicator& ranks);

// In an empty folder of their own, the same for all ranks.
void check_open_together(granular::Communicator& ranks, const std::string& folder);
void check_open_together_fails(granular::Communicator& ranks, const std::string& folder);

/// Where rank 0 has a small disk; false where it has none.
bool check_full_disk(granular::Communicator& ranks, const std::string& folder);

/// Empties a folder, and makes it first, for all ranks.
void empty_folder(granular::Communicator& ranks, const std::string& folder);

/// What goes wrong when all open a file together, as what(); the same on all ranks.
std::string open_together_error(granular::Communicator& ranks, const std::string& path);

#endif
