/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * The filters and sources of vtk-granular for arrays of C: what granular.h reads and writes, they make of one another.
 *
 *     granular_task task;
 *     granular_task_init(&task);
 *     task.filter = "GranularPackingSource";
 *     granular_frame* results[GRANULAR_MOST_RESULTS];
 *     size_t count = 0;
 *     if (granular_apply(&task, results, GRANULAR_MOST_RESULTS, &count) != GRANULAR_OK)
 *       puts(granular_last_error()->message);
 *
 * Errors, threads, null and undefined behaviour: see granular.h.
 */
/* clang-format off */
#ifndef GRANULAR_FILTERS_H
#define GRANULAR_FILTERS_H

#include "granular.h"

#ifdef __cplusplus
extern "C"
{
#endif

/* The filters and sources, under the names that they have in ParaView, where docs/reference describes their properties. Inputs are in the
 * order of their ports, and results in the order of the outputs, without boxes, which are in the headers.
 *
 * GranularPackingSource  no input; results: particles; bonds as lines if BondFactor is not 0
 * GranularLocalJoin      inputs: particles; contacts or bonds with id1 and id2, as lines with "ends" or as rows. Results: lines, with
 *                        "input_row", the row of the input that each line is of (of this rank, from 0), and the arrays that the filter
 *                        makes, but none of the input; facts in one row: "box_of_lines", 1 where the box is that of the lines, and
 *                        "had_parts", 1 where the lines of the input were split
 * GranularDecompositionSource  no input; results: subdomains with lo, hi, nlocal, proc
 * GranularCompare        inputs: particles; contacts or bonds as lines, if there are any; and, asked for if no rank has particles with id,
 *                        the lines at the first input. Of each the shown frame, and that to compare with. Results: particles, and
 *                        lines, each with "input_row", the rows of the input (lines: cells) at the shown frame, then those at the other
 *                        frame, which are lost, and the arrays that the filter makes; facts in one row: "of_lines", 1 where lines are in
 *                        place of particles, and "reference", the number of the other frame
 * GranularTrajectories   inputs: particles, at many frames. Results: the points of the paths; and the paths, first those of one point,
 *                        with "first_point" and "end_point", the first point of each and the one behind its last
 * GranularHistory        inputs: particles, at many frames. Results: a row for each frame, of piece 0 alone
 * GranularDecomposition  inputs: particles; for the mode 2, subdomains with lo, hi and, if known, proc. Results: subdomains as above, in
 *                        the coordinates of the points; facts in one row: "imbalance", "outside"
 * GranularContactSums    inputs: particles; contacts between them, and contacts with walls, as rows or lines: one of these at least. Results:
 *                        rows with the sums and "input_row", the row of the particles that each is of; facts in one row; if
 *                        mobilised_friction is made, rows with it and "input_cell", the row of the contacts
 * GranularPointAverage   inputs: particles; contacts, and contacts with walls, or none; points of any kind. Results: rows with the averages,
 *                        one for each point
 * GranularEulerAverage   inputs: particles; contacts, and contacts with walls, or none; of each frame if TimeAverage is set, which takes as
 *                        many frames as the task has. Results: rows with "points", the centres of the cells (less the origin but for a profile), and the averages; facts in one
 *                        row: "lo", "spacing" and "counts" of the grid. Settings besides those of ParaView: CellRange, six numbers: the
 *                        wanted cells along x, y and z, from one index to that before the other; else each rank gets a part of all.
 *                        GridOnly: 1: only the facts; particles are asked for where the cells follow from their box or their sizes
 * GranularProfile        as GranularEulerAverage, in layers along the axis ProfileAxis
 * LeftOut, a setting of both averages, is what a reader of the particles left out, for a warning.
 */

/* A property by its name: a text, or numbers, such as that of a choice. Those that are not given have their defaults. */
typedef struct granular_setting
{
  const char* name;
  const char* text;      /* null: numbers */
  const double* numbers; /* null: a text */
  size_t count;          /* of the numbers */
} granular_setting;

/* As the timestep of an input: it is not known. */
#define GRANULAR_NO_TIMESTEP INT64_MIN

/* The array of an input that marks rows by bits, as vtkGhostType of VTK does: a GRANULAR_UINT8 for each row. Rows with bit 1 belong to
 * another rank, and are left out. */
#define GRANULAR_GHOSTS "vtkGhostType"

/* Sets *content to the rows of this rank at an input, or leaves it null if nothing is connected there. frame: 0, or the number of a frame
 * of filters over time. What content points to must stay until the same input is asked for again, of GranularCompare both frames of
 * each, or granular_apply returns. All
 * ranks are asked for the same inputs in the same order. Returns 0; any other value is an error of all ranks with the text in *failure,
 * or GRANULAR_CANCELLED if that is null. */
typedef int (*granular_input)(size_t port, size_t frame, const granular_content** content, const char** failure, void* user);

/* The wanted work. granular_task_init sets the defaults. */
typedef struct granular_task
{
  size_t size;        /* of this struct, for later versions */
  const char* filter; /* its name */
  const granular_setting* settings;
  size_t setting_count;
  granular_input input; /* null for sources */
  size_t frames;        /* of the inputs, for filters over time; 1 (default) */
  const double* times;  /* of these; null (default): none */
  size_t shown;         /* the number of the shown frame; 0 (default) */
  /* part of the results that this rank gets, from 0 to pieces - 1, and the number of parts; 0 pieces (default): one for each rank, and
     the whole without ranks. With ranks each asks for its own part, or all for parts of what each has whole at its inputs */
  int piece;
  int pieces;
  const granular_ranks* ranks; /* null (default): this process alone. Else all ranks do the same work together: see granular_open_options */
  int threads;                 /* 0 (default): one per core */
  granular_progress progress;  /* may be null */
  granular_notice notice; void* user; /* notice may be null: of ranks that work together the first one is told; user is for all functions */
} granular_task;

/* Returns an array that a filter can make, which the text of its setting "Arrays" can name beside others; its number is counted from 0, and
 * null is returned from the last one on. *on: 1 if it is made where nothing is set. */
GRANULAR_API const char* granular_made_array(const char* filter, size_t number, int* on);

GRANULAR_API void granular_task_init(granular_task* task);

/* The most results of a filter. */
#define GRANULAR_MOST_RESULTS 8

/* Does the work of a filter or source. Sets *count, and so many results: frames that were not read but made; release each. `most`: room
 * for results. */
GRANULAR_API granular_status granular_apply(const granular_task* task, granular_frame** results, size_t most, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
