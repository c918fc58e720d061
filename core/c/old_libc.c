/* SPDX-License-Identifier: BSD-3-Clause */
/* For GRANULAR_PORTABLE: names that libstdc++ and a new C library's headers ask for, and an old C library lacks. */

/* False: libstdc++ counts references atomically even where there is one thread. */
char __libc_single_threaded = 0;

/* The first exp and pow of glibc have the values of those of 2.29, and set errno as well. The linker's --wrap leads here. */
#ifdef __x86_64__
#define FIRST "GLIBC_2.2.5"
#else
#define FIRST "GLIBC_2.17" /* aarch64 */
#endif
__asm__(".symver first_exp, exp@" FIRST);
__asm__(".symver first_pow, pow@" FIRST);
double first_exp(double x);
double first_pow(double x, double y);
double __wrap_exp(double x);
double __wrap_pow(double x, double y);

double __wrap_exp(double x)
{
  return first_exp(x);
}

double __wrap_pow(double x, double y)
{
  return first_pow(x, y);
}
