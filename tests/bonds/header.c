/* SPDX-License-Identifier: BSD-3-Clause */
/* The header in C11. */
#include "granular_bonds.h"

int granular_bonds_in_c(void);
int granular_bonds_in_c(void)
{
  return granular_bonds_create(1, 0, NULL);
}
