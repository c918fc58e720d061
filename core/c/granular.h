/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * The C interface of vtk-granular: files of discrete-element simulations as arrays, and arrays as files.
 *
 *     granular_run* run = NULL;
 *     const char* pattern = "post/run_*.dump";
 *     if (granular_open(&pattern, 1, NULL, &run) != GRANULAR_OK)
 *       puts(granular_last_error()->message);
 *
 * A run is one or more files that are shown as one series of frames. A frame that was read holds arrays: positions, velocities, ids. All
 * functions return GRANULAR_OK or the kind of error, and granular_last_error() the message of the calling thread. None throws or prints.
 *
 * Null is an error where a pointer is needed, not a crash. Undefined: handles that were closed, released or never returned
 * by this library, pointers to less memory than the function needs, and strings that do not end.
 *
 * Threads: a run may be used by several threads at once; a frame and a writer by one at a time. Strings and arrays belong to
 * the library, and stay until the run or frame they come from is closed or released.
 */
/* clang-format off */
#ifndef GRANULAR_H
#define GRANULAR_H

#include <stddef.h>
#include <stdint.h>

#ifndef GRANULAR_API
#define GRANULAR_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define GRANULAR_VERSION_MAJOR 0
#define GRANULAR_VERSION_MINOR 1
#define GRANULAR_VERSION_PATCH 0

/* An enum of the caller. In C++ any int is a value of it, so that the library may look at one that is none of its names. */
#ifdef __cplusplus
#define GRANULAR_ENUM(name) enum name : int
#else
#define GRANULAR_ENUM(name) enum name
#endif

/* ---- errors ---------------------------------------------------------------------------------- */

/* The result of a function. */
typedef enum granular_status
{
  GRANULAR_OK = 0,
  GRANULAR_IO_ERROR = 1,     /* the system refused an operation, or a file changed meanwhile */
  GRANULAR_FORMAT_ERROR = 2, /* the bytes contradict the format */
  GRANULAR_LIMIT_ERROR = 3,  /* larger than a documented limit */
  GRANULAR_UNSUPPORTED = 4,  /* legal, but not supported */
  GRANULAR_BAD_ARGUMENT = 5, /* what the caller gave cannot be used: null, no such frame or array */
  GRANULAR_CANCELLED = 6,    /* the progress function asked to stop */
  GRANULAR_NO_MEMORY = 7,
  GRANULAR_OTHER_ERROR = 8   /* an error of this library */
} granular_status;

/* An error, or a remark, which is no error, such as a frame that was left out. Strings are never null. */
typedef struct granular_error
{
  granular_status status; /* GRANULAR_OK of a remark */
  const char* message; /* "path:line: column 'name': expected ..., got ..." */
  const char* text;    /* the message without the position */
  const char* path;    /* empty if there is none */
  int64_t line;        /* of a text file, from 1; 0: not known */
  int64_t byte;        /* of a binary file, from 0; -1: not known */
  const char* column;  /* as the file spells it; empty if there is none */
  int system_error;    /* errno where the system refused an operation; 0: something else */
  const char* topic;   /* remarks of one topic say the same of many frames: the first one is enough; empty: each is new */
} granular_error;

/* Returns the error of the last function that failed on this thread; never null. Valid until the next failure. */
GRANULAR_API const granular_error* granular_last_error(void);

/* Returns "0.1.0", the version of the library that runs. */
GRANULAR_API const char* granular_version(void);

/* Called during long work with a fraction from 0 to 1, on the thread of the caller. Returns 0 to go on; any other value
 * stops the work with GRANULAR_CANCELLED. This function and the next one may end their thread, and may use any run, which
 * stays as it was until a refresh ends; to refresh the run at work is GRANULAR_BAD_ARGUMENT. */
typedef int (*granular_progress)(double fraction, void* user);

/* Called with each remark of a function, whose strings stay during the call. */
typedef void (*granular_notice)(const granular_error* remark, void* user);

/* ---- runs ------------------------------------------------------------------------------------ */

typedef struct granular_run granular_run;

/* The kind of the files of a run. */
typedef GRANULAR_ENUM(granular_kind)
{
  GRANULAR_KIND_AUTOMATIC = -1,
  GRANULAR_KIND_DUMP = 0,         /* dump atom, dump custom: particles */
  GRANULAR_KIND_LOCAL = 1,        /* dump local: contacts and bonds */
  GRANULAR_KIND_RESTART = 2,      /* restart files of LIGGGHTS: particles, and bonds in table 1 */
  GRANULAR_KIND_DATA_FILE = 3,    /* data files: particles, and bonds in table 1 */
  GRANULAR_KIND_EULER = 4,        /* averaged cells */
  GRANULAR_KIND_DECOMPOSITION = 5, /* subdomains of ranks */
  GRANULAR_KIND_GRID = 6          /* dump grid: cells */
} granular_kind;

/* Sets *kind by the contents of a file; GRANULAR_KIND_AUTOMATIC for none of these kinds (granular_open says what it is), or no file. */
GRANULAR_API granular_status granular_find_kind(const char* path, granular_kind* kind);

/* Ranks that open and read together. all_gather is called with the same number of bytes on each rank, and stores those of all in `all`, in
 * the order of the ranks: MPI_Allgather(mine, bytes, MPI_BYTE, all, bytes, MPI_BYTE, comm). If it does not return 0, the run is lost. */
typedef struct granular_ranks
{
  int rank; /* of this process, from 0 to size - 1 */
  int size;
  int (*all_gather)(const void* mine, void* all, size_t bytes, void* user);
  void* user;
} granular_ranks;

/* Options of granular_open. granular_open_options_init sets the defaults; null strings are empty. */
typedef struct granular_open_options
{
  size_t size;              /* of this struct, for later versions */
  granular_kind kind; /* GRANULAR_KIND_AUTOMATIC (default): told apart by the contents of the first file */
  /* time of one timestep, greater than 0, in the unit of the run; by default 1, unless the files hold times */
  double timestep_size;
  /* columns of dumps that do not name them, binary or without headers: "id type x y z vx vy vz" */
  const char* column_names;
  /* order of the columns of contacts and bonds, by its name */
  const char* preset;
  /* names of the columns of contacts and bonds, one for each column; files without a header need it; of dumps as column_names */
  const char* column_map;
  /* atom style of data files that do not name it: "sphere", "hybrid sphere bond" */
  const char* atom_style;
  /* boundaries of the box in data files, which do not hold them: "p p f"; empty: axes that particles have crossed are periodic */
  const char* boundary;
  /* program that wrote the history of bonds in restart files, which says what its values are: 0 automatic (default), 1 numbered,
   * 2 with_bonds, 3 pfm, 4 flexible_fibers or 5 flexible_fibers_damage */
  int history_layout;
  /* meaning of a timestep in several files: pieces of one frame (merge), or a run that was restarted (last): 0 auto (default), 1
   * merge or 2 last */
  int repeated_steps;
  /* number of threads; 0 (default): one per core */
  int threads;
  granular_progress progress; /* may be null */
  granular_notice notice; void* user; /* notice may be null; user is for both */
  /* null (default): this process alone. Else all ranks open, refresh and read in the same order, each from one thread, and not in their
     functions for progress and notices. Errors and remarks are those of all; each rank reads a part of a frame, see pieces, but cells and
     subdomains whole. The struct is copied; what its user points to must exist until the run is closed */
  const granular_ranks* ranks;
} granular_open_options;
GRANULAR_API void granular_open_options_init(granular_open_options* options);

/* Opens a run and finds its frames, without reading them. paths: names or patterns of files, at least one. In patterns `*`
 * stands for the timestep and `%` for the rank, as in the dump command. options may be null. Sets *run. */
GRANULAR_API granular_status granular_open(const char* const* paths, size_t count,
  const granular_open_options* options, granular_run** run);

/* Closes a run. Null does nothing. Frames that were read stay. */
GRANULAR_API void granular_close(granular_run* run);

/* Looks for frames that were added, and for files that changed. What functions returned of this run before, counts and
 * strings, is no longer valid; after an error the run is as it was. The functions may be null. */
GRANULAR_API granular_status granular_refresh(granular_run* run, granular_progress progress, granular_notice notice, void* user);

/* Facts of a run. */
typedef struct granular_run_facts
{
  granular_kind kind;
  int64_t frames;
  int64_t files;
  int tables; /* 1, or 2 where there may be bonds */
} granular_run_facts;

GRANULAR_API granular_status granular_run_info(granular_run* run, granular_run_facts* facts);

/* Facts of a frame that need no rows. */
typedef struct granular_frame_facts
{
  int64_t timestep;
  double time;      /* ITEM: TIME, or timestep x timestep_size */
  int64_t rows;     /* of the file; -1: not known before it is read */
  const char* path; /* of the file, or of its first piece */
} granular_frame_facts;

/* frame: from 0, or from the end: -1 is the last one. */
GRANULAR_API granular_status granular_frame_info(granular_run* run, int64_t frame, granular_frame_facts* facts);

/* Facts of a file of a run. */
typedef struct granular_file_facts
{
  const char* path;
  int64_t bytes;      /* on the disk */
  int64_t frames;     /* that are complete */
  int64_t repeated;   /* of these, whose timestep is that of an earlier one in this file */
  const char* defect; /* why the first frame that is not among them was left out, such as one that ends early; empty: none is known */
} granular_file_facts;

/* file: from 0, in the order of granular_find_files. */
GRANULAR_API granular_status granular_file_info(granular_run* run, int64_t file, granular_file_facts* facts);

/* Returns in *frame the last frame at or before a time, or 0. */
GRANULAR_API granular_status granular_find_frame(granular_run* run, double time, int64_t* frame);

/* Types of values. */
typedef GRANULAR_ENUM(granular_type)
{
  GRANULAR_INT8 = 0, GRANULAR_UINT8 = 1, GRANULAR_INT16 = 2, GRANULAR_UINT16 = 3, GRANULAR_INT32 = 4, GRANULAR_UINT32 = 5,
  GRANULAR_INT64 = 6, GRANULAR_UINT64 = 7, GRANULAR_FLOAT32 = 8, GRANULAR_FLOAT64 = 9,
  GRANULAR_TEXT = 10 /* int32 indices into a list of words */
} granular_type;

/* An array that a frame has in its file. */
typedef struct granular_array_facts
{
  const char* name;
  granular_type type; /* as far as known before the rows are read */
  int components;
  int is_usual; /* 0: read only if asked for by name, such as coordinates that make the points */
  const char* unit; /* SI unit under `units si`; "-" none; empty: not known */
  const char* meaning;
  const char* columns; /* that hold its components, separated by blanks: "vx vy vz"; of local data by their meaning; empty: there are none */
} granular_array_facts;

#define GRANULAR_EVERY_FRAME INT64_MIN /* as the number of a frame: all frames */

/* Returns in *count the number of arrays of a frame, or those of every frame, each name once, and fills the first `most` of them; arrays
 * may be null if most is 0. table: 0, or 1 for bonds. The points are not among them. With ranks, those of every frame are asked by all. */
GRANULAR_API granular_status granular_arrays(granular_run* run, int64_t frame, int table,
  granular_array_facts* arrays, size_t most, size_t* count);

/* ---- frames ---------------------------------------------------------------------------------- */

typedef struct granular_frame granular_frame;

/* The coordinates of points. */
typedef GRANULAR_ENUM(granular_coordinates)
{
  GRANULAR_ABSOLUTE = 0,
  GRANULAR_UNWRAPPED = 1, /* moved by whole boxes, by the image counts */
  GRANULAR_SCALED = 2     /* in units of the box vectors */
} granular_coordinates;

/* The wanted part of a frame. granular_request_init sets the defaults: all of it. */
typedef struct granular_request
{
  size_t size;               /* of this struct */
  int table;                 /* 0 (default), or 1 for bonds */
  const char* const* arrays; /* names; null (default): all usual ones */
  size_t array_count;
  int points; /* 1 (default); 0: no points, and coordinates are arrays like others */
  /* a box xlo, xhi, ylo, yhi, zlo, zhi in absolute coordinates, faces included: only particles in it are read; an axis with lo >
   * hi (default), or of 0 0, is not restricted; no NaN (dumps and data files) */
  double region[6];
  /* n keeps particles whose id is a multiple of n, or each n-th row without ids; 1 (default): all (dumps and data files) */
  int64_t stride;
  /* points in the box (absolute), moved by the image counts (unwrapped), or in units of the box (scaled): 0 absolute (default),
   * 1 unwrapped or 2 scaled (dumps and data files) */
  granular_coordinates coordinates;
  /* points as 64-bit or 32-bit floats: 0 double (default) or 1 single (dumps) */
  int single_precision;
  /* a point that is subtracted from the points before any rounding */
  double origin[3];
  /* rows in the order of their ids (dumps and data files) */
  int sort_by_id;
  /* contacts and bonds across periodic faces: to the nearest image, split at the faces into rows of their own, or from end to
   * end: 0 minimum_image (default), 1 split or 2 as_written (dumps of local data, restart files and data files) */
  int periodic_lines;
  /* part of the rows that is read, from 0 to pieces - 1 (dumps, dumps of local data, restart files and data files) */
  int piece;
  /* number of parts, which together are all rows; 0 (default): one for each rank, and the whole without ranks (dumps, dumps of
   * local data, restart files and data files) */
  int pieces;
  /* number of threads; 0 (default): one per core */
  int threads;
  granular_progress progress; /* may be null */
  granular_notice notice; void* user; /* notice may be null; user is for both */
  int ranges; /* 1: the ranges of points and arrays are found while they are read, where that costs little; 0 (default) */
  int take;   /* 1: arrays are made in memory that granular_take can give away, which copies only sorted rows; 0 (default) */
} granular_request;
GRANULAR_API void granular_request_init(granular_request* request);

/* Reads a frame into memory of the library. request may be null. Sets *out; release it. */
GRANULAR_API granular_status granular_read(granular_run* run, int64_t frame, const granular_request* request, granular_frame** out);

/* Memory of the caller for one array. */
typedef struct granular_destination
{
  const char* array;  /* its name, or "points" */
  granular_type type; /* numbers are converted to it; a number that does not fit is an error */
  void* data;         /* at any address */
  size_t values; /* for so many values there is room */
} granular_destination;

/* Reads a frame into memory of the caller: the arrays that the destinations name, and no others; request->arrays does not
 * count. Sets *rows, if not null. Too little room is GRANULAR_BAD_ARGUMENT, and *rows says how many rows there are. */
GRANULAR_API granular_status granular_read_into(granular_run* run, int64_t frame, const granular_request* request,
  const granular_destination* destinations, size_t count, int64_t* rows);

/* Frees a frame and its arrays. Null does nothing. An open run keeps the memory of frames of a dump for the next ones, up to 256 MiB. */
GRANULAR_API void granular_release(granular_frame* frame);

/* A simulation box: a corner, and the edges a, b, c one after the other; and the numbers of a dump's header, xlo xhi ylo yhi zlo
 * zhi xy xz yz, from which corner and edges of all but general triclinic boxes follow. */
typedef struct granular_box
{
  double bounds[9];
  int has_bounds; /* 1: bounds count, and nothing is rounded twice; 0: origin and vectors count, and bounds are rounded, or all 0 */
  double origin[3];
  double vectors[9];
  const char* boundary; /* "pp pp ff"; empty: not known */
} granular_box;

/* Sets corner and edges from the bounds; if has_bounds is 0 the bounds from corner and edges, where these allow it. Each is rounded once. */
GRANULAR_API granular_status granular_complete_box(granular_box* box);

/* The header of a frame. */
typedef struct granular_frame_header
{
  int64_t timestep;
  double time;
  int has_time; /* 1: ITEM: TIME; 0: time is timestep x timestep_size */
  int64_t rows;
  int has_box;
  granular_box box;
  granular_coordinates coordinates; /* of the points */
  double origin[3];                 /* subtracted from the points */
  const char* label;                /* ITEM: LABEL */
  const char* units;                /* ITEM: UNITS */
  const char* columns;              /* of the file, in its order and spelling */
  const int* digits;                /* the largest number of digits of each column in the first rows of a text; 0: none was seen */
  size_t digit_count;               /* one for each column, or 0 */
  const char* dialect;              /* "LIGGGHTS" or "LAMMPS"; empty: not known */
  size_t arrays;                    /* number of them */
  const char* row_label;            /* word for rows: ATOMS, ENTRIES */
  const char* shape_sizes;          /* what the array shape holds: "half axes" or "diameters"; empty: there is none */
  const char* const* groups;        /* of a restart file: their names */
  size_t group_count;
  const char* const* type_names;    /* of a data file with labels of types: the names of types from 1 on; empty: one has none */
  size_t type_name_count;
  int box_form;                     /* 0 along the axes, 1 tilted, 2 general: three edges of any direction */
  double box_corners[24];           /* as the points are, x y z each, at the ends of no edge, a, b, a b, c, a c, b c, a b c */
} granular_frame_header;

GRANULAR_API granular_status granular_header(const granular_frame* frame, granular_frame_header* header);

/* An array: rows x components values, row by row. */
typedef struct granular_array
{
  const char* name; /* "points": coordinates of particles and cells; "ends": x1 y1 z1 x2 y2 z2 of lines */
  granular_type type;
  int components;
  int64_t rows;
  const void* data;
  const char* const* words; /* of GRANULAR_TEXT; null for numbers */
  size_t word_count;
  const char* unit;
  const char* meaning;
  const char* columns; /* as in granular_array_facts; writers use neither this nor the range */
  const double* range; /* minimum and maximum of each component in the rows that were read, and of vectors then those of their
                          lengths; null: not asked for, or not known */
} granular_array;

/* Returns an array by its number, from 0, or by its name. */
GRANULAR_API granular_status granular_array_at(const granular_frame* frame, size_t number, granular_array* array);
GRANULAR_API granular_status granular_array_named(const granular_frame* frame, const char* name, granular_array* array);

/* Gives the memory of an array away, for free() of C (Windows: of msvcrt). Its data are null then. Without take it gives a copy. */
GRANULAR_API granular_status granular_take(granular_frame* frame, size_t number, void** data);

/* A regular grid of cells: its bounds, the edges of a cell, and the cells along each axis. Cell first + (k counts[1] + j) counts[0] + i of
 * the frame is its cell i, j, k. */
typedef struct granular_grid
{
  double lo[3], hi[3], spacing[3];
  int64_t counts[3], first;
} granular_grid;

/* Returns in *count the number of regular grids that the cells of a frame form, which was read with its points and without an origin, and
 * fills the first `most` of them. A frame of other cells is GRANULAR_UNSUPPORTED, and the message names the first one that does not fit. */
GRANULAR_API granular_status granular_grids(const granular_frame* frame, granular_notice notice, void* user, granular_grid* grids,
  size_t most, size_t* count);

/* ---- writing --------------------------------------------------------------------------------- */
typedef struct granular_writer granular_writer;

/* The format of a file to write. granular_format_init sets the defaults; null strings are empty. */
typedef struct granular_format
{
  size_t size; /* of this struct */
  /* "atom", "custom", "local", "euler", "decomposition"; empty (default): by the ending of the name, .bonds, .euler and
     .decomposition, else custom */
  const char* style;
  /* "LIGGGHTS" or "LAMMPS"; of decompositions "PUBLIC" or "INL"; of cells "LIGGGHTS" or "Wide"; empty (default) or "Automatic":
     that of the file that the frame comes from, else LAMMPS, INL, Wide */
  const char* dialect;
  const char* columns; /* names of columns or arrays, separated by blanks; empty (default): all */
  const char* numbers; /* "Automatic" (default), "%g", "%.1g" to "%.17g", "shortest" */
  const char* label;   /* word for rows of local data; empty: that of the file, else ENTRIES */
  int scaled;          /* style atom: 1 (default) xs ys zs, 0 x y z */
  int image;           /* style atom: 1 also ix iy iz */
  int sort_by_id;
  int write_units;            /* 1: ITEM: UNITS; LAMMPS only */
  int write_time;             /* 1: ITEM: TIME; LAMMPS only */
  int threads;                /* 0 (default): one per core */
  granular_progress progress; /* may be null */
  granular_notice notice; void* user; /* notice may be null; user is for both */
  /* 1: the file is on the disk before it has its name, and survives a loss of power; 0: the system writes it when it likes; 2
     (default): 1 for one file, 0 for a file of each frame */
  int durable;
} granular_format;
GRANULAR_API void granular_format_init(granular_format* format);

/* Begins a file under a temporary name. A name with `*` makes a file for each frame. Two frames of one timestep are an error.
 * Text is compressed if the name ends in .gz or .zst; .bin and .lammpsbin are binary. format may be null. Sets *writer.
 * A file of the run that a frame comes from, under any name, is replaced by granular_finish. A frame for it is an error if a
 * frame of that file is not complete, because a simulation may be writing it, or if other files have pieces of its frames. */
GRANULAR_API granular_status granular_create(const char* path, const granular_format* format, granular_writer** writer);

/* A frame to write. granular_content_init sets the defaults. */
typedef struct granular_content
{
  size_t size; /* of this struct */
  int64_t timestep;
  double time;
  int has_time;
  const char* units;
  const granular_box* box; /* null: made from the bounds of the particles */
  int64_t rows;
  /* name, type, components, data and words count; fewer rows than those above are an error, unless they are 0. Data are aligned
     as their type needs. "points" has the positions of particles and cells, "ends" those of lines; subdomains have "lo", "hi" and,
     if known, "nlocal" and "proc". Two arrays of particles or lines with the same column, as c and c[1], are an error, and so are
     coordinates beside "points" */
  const granular_array* arrays;
  size_t array_count;
  /* null, or the header of the frame that the arrays come from: columns, digits, dialect, label, word for rows, coordinates and origin */
  const granular_frame_header* header;
} granular_content;
GRANULAR_API void granular_content_init(granular_content* content);

/* Adds a frame from arrays of the caller, which are read where they are. */
GRANULAR_API granular_status granular_write(granular_writer* writer, const granular_content* content);

/* Tells a writer that its arrays come from a run, whose files granular_finish may replace. */
GRANULAR_API granular_status granular_add_input(granular_writer* writer, granular_run* run);

/* Adds a frame that was read, with the digits, columns and dialect of its file. A piece is written as it is: in a file of its own. */
GRANULAR_API granular_status granular_write_frame(granular_writer* writer, const granular_frame* frame);

/* Gives the file its name and ends the writer. An error if a frame failed, whatever the reason, or if there was none. After an
 * error, the old file is untouched; the writer is gone in any case. */
GRANULAR_API granular_status granular_finish(granular_writer* writer);

/* Ends the writer without the file; the old one is untouched. Null does nothing. */
GRANULAR_API void granular_abandon(granular_writer* writer);

/* ---- files that a program writes itself ------------------------------------------------------ */
typedef struct granular_file granular_file;

/* Begins a file that a program writes in its own way, under the name of an empty temporary file in the folder of path. Sets *file;
 * close it. A symbolic link is followed. An error if something at path may not be replaced. */
GRANULAR_API granular_status granular_begin_file(const char* path, granular_file** file);

/* Returns the name to write to, which may also be replaced by a file of the same file system. */
GRANULAR_API const char* granular_file_name(const granular_file* file);

/* Completes a file and closes it, so that many can wait for their names. It gets the permissions, owner and group of the old file.
 * durable: 1 or 0, as in granular_format. */
GRANULAR_API granular_status granular_hold_file(granular_file* file, int durable);

/* Gives files their names in this order; completes those not held. None gets its name if another program has taken a file away. */
GRANULAR_API granular_status granular_finish_files(granular_file* const* files, size_t count, int durable);

/* Ends a file, and removes what has been written if granular_finish_files has not given it its name. Null does nothing. What a
 * killed program leaves is removed by the next granular_begin_file of the same path, with all whose names begin like that of
 * granular_file_name. A child made by fork removes nothing. */
GRANULAR_API void granular_close_file(granular_file* file);

/* ---- files ----------------------------------------------------------------------------------- */
typedef struct granular_names granular_names;
typedef struct granular_bytes granular_bytes;

/* Finds the files of a run by patterns, in the order of their numbers: see granular_open. Sets *names; free them. */
GRANULAR_API granular_status granular_find_files(const char* const* patterns, size_t count, granular_names** names);
GRANULAR_API size_t granular_name_count(const granular_names* names);
GRANULAR_API const char* granular_name_at(const granular_names* names, size_t number);
GRANULAR_API void granular_free_names(granular_names* names);

/* Opens any file, plain or packed by gzip or Zstandard, to read its content from the beginning. Sets *bytes; close them. */
GRANULAR_API granular_status granular_open_bytes(const char* path, granular_bytes** bytes);

/* Reads the next bytes: *got are fewer than most only at the end. There *is_cut is 1 if packed data end early, else 0. */
GRANULAR_API granular_status granular_read_bytes(granular_bytes* bytes, void* buffer, size_t most, size_t* got, int* is_cut);
GRANULAR_API void granular_close_bytes(granular_bytes* bytes);

#ifdef __cplusplus
}
#endif

#endif
