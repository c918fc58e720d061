/* SPDX-License-Identifier: BSD-3-Clause */
/* For GRANULAR_PORTABLE: names that libstdc++ and a new C library's headers ask for, and an old C library lacks. */

/* False: libstdc++ counts references atomically even where there is one thread. */
char __libc_single_threaded = 0;

/* The first pow of glibc has the values of the one of 2.29, and sets errno as well. The linker's --wrap=pow leads here. */
#ifdef __x86_64__
__asm__(".symver first_pow, pow@GLIBC_2.2.5");
#else
__asm__(".symver first_pow, pow@GLIBC_2.17"); /* aarch64 */
#endif
double first_pow(double x, double y);
double __wrap_pow(double x, double y);

double __wrap_pow(double x, double y)
{
  return first_pow(x, y);
}
