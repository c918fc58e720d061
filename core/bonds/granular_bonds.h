/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * Bonded particles of a simulation code, stored as the atom style bond/gran of LIGGGHTS' forks stores them, and packed for other
 * ranks and for restart files as its routines pack them. For C, C++11 and Fortran; the library needs nothing else.
 *
 *     granular_bonds* particles = NULL;
 *     const double x[3] = { 0, 0, 0 };
 *     if (granular_bonds_create(6, 12, &particles) != GRANULAR_BONDS_OK || granular_bonds_add(particles, 1, x, NULL) != 0)
 *       puts(granular_bonds_last_error());
 *
 * Functions return GRANULAR_BONDS_OK or the kind of error; granular_bonds_last_error() then has the message of the calling
 * thread. After an error the particles are unchanged, but for room, and outputs and buffers have any values. No function
 * throws or prints. Null where a pointer is needed is an error. Undefined: handles that were destroyed, and pointers to less
 * memory than a function needs. One thread at a time may use an object.
 */
/* clang-format off */
#ifndef GRANULAR_BONDS_H
#define GRANULAR_BONDS_H

#include <stddef.h>
#include <stdint.h>

#ifndef GRANULAR_BONDS_API
#define GRANULAR_BONDS_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C"
{
#endif

/* Results; the numbers are those of granular_status. */
enum
{
  GRANULAR_BONDS_OK = 0,
  GRANULAR_BONDS_FORMAT_ERROR = 2, /* a buffer or a record holds something else */
  GRANULAR_BONDS_LIMIT_ERROR = 3,  /* more bonds than there is room for, or a number that a format cannot hold */
  GRANULAR_BONDS_UNSUPPORTED = 4,  /* lists of special neighbours */
  GRANULAR_BONDS_BAD_ARGUMENT = 5, /* null, no such row, too small a buffer */
  GRANULAR_BONDS_NO_MEMORY = 7,
  GRANULAR_BONDS_OTHER_ERROR = 8   /* an error of this library */
};
typedef int granular_bonds_status;

/* Returns the message of the last function that failed on this thread: "expected ..., got ..."; never null. Valid until the
 * next failure. */
GRANULAR_BONDS_API const char* granular_bonds_last_error(void);

/* ---- particles ------------------------------------------------------------------------------- */

/* Particles in rows from 0. A particle holds at most B bonds; each has a type, the id of its partner, and n_h history values.
 * A bond is usually stored with both of its particles. Types and ids may have any value. */
typedef struct granular_bonds granular_bonds;

/* Makes an object without particles. B is at least 1, n_h at least 0, and B n_h at most 2^40. Sets *particles. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_create(
  int32_t most_bonds, int32_t history_values, granular_bonds** particles);

/* Frees an object. Null does nothing. */
GRANULAR_BONDS_API void granular_bonds_destroy(granular_bonds* particles);

/* Makes room for `capacity` particles; 0: for 10,000 more. Other functions that need room make half as much again, and at
 * least 10,000, so that each particle moves only a few times. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_grow(granular_bonds* particles, size_t capacity);

/* Sets the number of particles. New ones are at the origin, of type 0 and mask 1, and all else is 0. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_resize(granular_bonds* particles, size_t size);

/* Adds a particle without bonds: mask 1, all else is 0. Sets *row, if not null. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_add(
  granular_bonds* particles, int32_t type, const double x[3], size_t* row);

/* Adds a bond to a particle; n_h values of history. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_add_bond(
  granular_bonds* particles, size_t row, int32_t type, int64_t partner, const double* history);

/* Sets the number of bonds of a particle. Type, partner and history of new ones are 0. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_set_bonds(
  granular_bonds* particles, size_t row, int32_t bonds);

/* Removes a particle: the last one takes its row. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_remove(granular_bonds* particles, size_t row);

/* The arrays, with a row for each particle, to read and to write. They stay until the object has to grow. */
typedef struct granular_bonds_arrays
{
  size_t size;            /* particles */
  size_t capacity;        /* particles that there is room for */
  int32_t most_bonds;     /* B */
  int32_t history_values; /* n_h */
  double* x;       /* 3 a row; so are v, f, x_mol, v_mol and image */
  double* v;
  double* f;
  double* x_mol;   /* of the molecule that a particle belongs to */
  double* v_mol;
  int64_t* tag;
  int64_t* molecule;
  int32_t* type;
  int32_t* mask;   /* a bit for each group */
  int32_t* image;  /* crossings of the periodic box */
  const int32_t* bonds; /* number of bonds, 0 to B */
  int32_t* bond_types;  /* B a row, of which `bonds` count */
  int64_t* partners;    /* B a row */
  double* history;      /* B n_h a row: n_h values of the first bond, of the second, ... */
  size_t memory;    /* bytes that this object has allocated for arrays */
  size_t described; /* bytes as bond/gran estimates them: capacity (5 x 24 + 4 (4 + B) + 8 B n_h) */
} granular_bonds_arrays;

GRANULAR_BONDS_API granular_bonds_status granular_bonds_view(granular_bonds* particles, granular_bonds_arrays* arrays);

/* ---- messages to other ranks ----------------------------------------------------------------- */

/* The routines of the style, with the doubles for each particle by PFM, and by WITH-BONDS, Flexible_Fibers and SEAICE, which
 * have no x_mol and v_mol: add GRANULAR_BONDS_WITH_BONDS to the kind. */
enum
{
  GRANULAR_BONDS_COMM = 0,            /* 9, 3: x, x_mol, v_mol */
  GRANULAR_BONDS_COMM_VELOCITY = 1,   /* 12, 6: x, v, x_mol, v_mol */
  GRANULAR_BONDS_BORDER = 2,          /* 13, 7: x, tag, type, mask, molecule, x_mol, v_mol */
  GRANULAR_BONDS_BORDER_VELOCITY = 3, /* 16, 10: x, tag, type, mask, molecule, v, x_mol, v_mol */
  GRANULAR_BONDS_BORDER_HYBRID = 4,   /* 1: molecule, the part of this style in a hybrid */
  GRANULAR_BONDS_REVERSE = 5,         /* 3: f of a copy; unpacking adds it */
  GRANULAR_BONDS_EXCHANGE = 6, /* 22 + (2 + n_h) b, 16 + (2 + n_h) b: length, x, v, tag, type, mask, image, molecule, x_mol,
                                  v_mol, b, type and partner of each bond, history, three times 0 for special neighbours */
  GRANULAR_BONDS_WITH_BONDS = 16
};

/* The movement of copies across periodic faces. Of all zeros, or null: none, and doubles are copied bit by bit. x moves, x_mol
 * never, as in the programs. */
typedef struct granular_bonds_shift
{
  int counts[6];     /* boxes along x, y and z, and the parts that tilts add from yz, xz and xy: `pbc` */
  double lengths[3]; /* of the box */
  double tilts[3];   /* yz, xz, xy */
  int triclinic;     /* 1: tilts count, and borders are in units of the box: x moves by counts */
  double rates[6];   /* of the lengths and tilts of a changing box, in the order of counts; v moves, v_mol never */
  int32_t moving_groups; /* bits of the groups whose v moves; 0: of no particle */
} granular_bonds_shift;

/* Packs particles: `count` rows from `first` on or, if list is not null, `count` rows list[first], list[first + 1], ..., in any
 * order and possibly repeated. Ids up to 2^53 and types are sent as their values, larger ids and images by their bits. Sets
 * *doubles to those that are needed; buffer may be null to learn only this, else it has room for `room` doubles. shift is for
 * the first four kinds, and may be null. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_pack(const granular_bonds* particles, int kind, size_t first,
  size_t count, const int32_t* list, const granular_bonds_shift* shift, double* buffer, size_t room, size_t* doubles);

/* Unpacks all particles of a buffer into rows from `first` on, which is at most the number of particles: particles are added where
 * the buffer is longer. New particles are as after granular_bonds_add where nothing is sent. REVERSE adds to the forces of
 * existing rows from `first` on or, if list is not null, of rows list[first], ...; EXCHANGE adds particles behind the last
 * one, whose n_h must be that of this object, so first is the number of particles. Sets *count, if not null. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_unpack(granular_bonds* particles, int kind, size_t first,
  const int32_t* list, const double* buffer, size_t doubles, size_t* count);

/* ---- records of restart files ---------------------------------------------------------------- */

/* The format of numbers in a record; null stands for { 0, 0, 10 }. */
typedef struct granular_bonds_form
{
  int integers_as_bits; /* 1: tag, type and mask as the bits of 64-bit integers; 0: as values. Unpacking finds it */
  int image_as_bits;    /* 1: PFM; 0: WITH-BONDS, Flexible_Fibers */
  int image_bits;       /* of one count: 10 where ids have 4 bytes, 21 where they have 8 */
} granular_bonds_form;

/* Packs the record of a particle: 13 + 2 b, 1 + n_h b if n_h > 0, and the doubles of fixes. Sets *doubles to those that are
 * needed; buffer may be null to learn only this. A type below 1, an image count beyond its bits, and ids beyond 2^53 that are
 * written as values (molecule and partners always are) are GRANULAR_BONDS_LIMIT_ERROR. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_pack_record(const granular_bonds* particles, size_t row,
  const granular_bonds_form* form, const double* fixes, size_t fix_count, double* buffer, size_t room, size_t* doubles);

/* Adds the particle of the record at the beginning of a chunk. Sets *doubles to the length of the record, of which the last
 * fix_count are those of fixes: the record does not tell their number. n_h must be that of this object; records of particles
 * without bonds may have n_h or not. */
GRANULAR_BONDS_API granular_bonds_status granular_bonds_unpack_record(granular_bonds* particles,
  const granular_bonds_form* form, size_t fix_count, const double* chunk, size_t chunk_doubles, size_t* doubles);

#ifdef __cplusplus
}
#endif

#endif
