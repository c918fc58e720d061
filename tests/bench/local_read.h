// SPDX-License-Identifier: BSD-3-Clause
#ifndef tests_bench_local_read_h
#define tests_bench_local_read_h

#include "bench.h"

namespace bench
{
/// Local data from a file in the page cache, against a dump of particles with the same rows.
void add_reading(const Size& size);
}
#endif
