// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_read_data_h
#define granular_formats_data_file_read_data_h

#include "granular/common/error.h"
#include "granular/formats/data_file/data_layout.h"
#include "granular/formats/data_file/section_rows.h"
#include "granular/formats/dump/read/dump_reader.h"
#include "granular/parallel/communicator.h"

#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The columns of a data file.
struct DataColumns
{
  std::vector<std::string> particles; ///< of the section Atoms
  std::vector<JoinedSection>
    joined = {};       ///< velocities, ellipsoids, and what fix property/atom wrote
  bool masses = false; ///< the masses of types are an array `mass`
};

/// Finds the columns: of the style that the user names, such as "sphere" or "hybrid sphere bond"; otherwise of the one in the
/// comment `Atoms # style`; otherwise of the only one that fits all rows, with a notice. asked: empty or "automatic" leaves the
/// choice to the file. Sections that are not read are named in a notice. The layout must outlive the columns. Throws FormatError
/// that lists the styles that would fit, and for rows of Ellipsoids of other than 8 or 10 words.
DataColumns find_data_columns(
  const DataLayout& layout, std::string_view asked, const std::string& path, Notices& notices);

/// Options by which a data file is understood.
struct DataOptions
{
  std::string atom_style = {}; ///< see find_data_columns
  std::string
    boundary = {}; ///< see parse_boundary; empty: axes that image counts say particles have crossed are periodic
};

/// Returns the columns that particles have in the end: those of the section Atoms, of the joined ones, and mass.
ColumnSchema make_particle_schema(const DataColumns& columns);

/// Returns the columns of the section Bonds: bond_id btype id1 id2.
ColumnSchema make_data_bond_schema();

/// Decodes a data file. Particles are decoded from the section Atoms, like read_dump, in double precision; rows of other sections join
/// them by ids, in any order. Labels of types become their numbers. Bonds without one of their particles are left out, with a notice
/// unless stride or region leave out particles. Lines are in absolute coordinates if points are scaled.
///
/// Collective: each rank decodes its share of the rows; request.piece must be the rank, request.pieces the number of
/// ranks. A single rank that wants one of several pieces decodes all rows and keeps its piece.
///
/// Throws FormatError with path, line and column, also for a particle without a velocity and an id with several rows; IoError;
/// LimitError; Cancelled; std::bad_alloc.
Tables read_data(const FramePiece& file, const DataOptions& options, const Request& request,
  Communicator& ranks, Notices& notices, Progress& progress);
}
#endif
