// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/cells.h"
