// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/euler_grid.h"
