// SPDX-License-Identifier: BSD-3-Clause
// Kills this process at a chosen call of the system. A program that has dying_calls.cpp among its sources calls that in place of the
// system where it makes, locks, writes, synchronises, renames, removes and closes files, and so do the libraries that it uses.
#ifndef granular_tests_support_dying_calls_h
#define granular_tests_support_dying_calls_h

/// This process is killed (SIGKILL) at the call of this number from now on, counted from 1, before the call is made; where bytes
/// are written, after half of them.
void die_at_call(long number);

/// Returns how many calls are left until then.
long calls_before_death();
#endif
