// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/regular_grids.h"
