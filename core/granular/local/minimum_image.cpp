// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/minimum_image.h"
