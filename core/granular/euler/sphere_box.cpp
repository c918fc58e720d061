// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/sphere_box.h"
