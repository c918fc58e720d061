// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDumpReader
 * @brief   Reads particle dumps of LIGGGHTS and LAMMPS.
 *
 * Reads the files of `dump atom` and `dump custom`: text and binary, plain or compressed with gzip or Zstandard, with every header
 * since 2010, any box, and any columns in any order. Binary files may have either byte order. Binary files of LIGGGHTS, and of LAMMPS
 * before 2020, do not name their columns: see SetColumnNames. vtkGranularLocalReader reads `dump local`. vtkGranularSeriesReader tells
 * which frames there are.
 *
 * Output port 0 holds the particles (vtkPolyData), output port 1 the simulation box as one hexahedron (vtkUnstructuredGrid). Both are
 * relative to PointOrigin.
 *
 * Columns become point arrays:
 * - `id` is a vtkTypeInt64Array, and the pedigree ids; `type` is a vtkTypeInt32Array; other integer columns are vtkTypeInt64Array;
 *   `element` is a vtkStringArray; all other columns are double;
 * - vx vy vz become `v`; likewise f, omega, mu, angmom, tq, shape (3), quat (4), image (3 int32);
 * - c_ID[1] .. c_ID[n], complete and in this order, become `c_ID`; likewise f_, v_, i2_, d2_;
 * - `radius` is made from `diameter` if the file has no `radius`;
 * - every other column becomes an array of its own name. Coordinate columns (x, xs, xu, ...) become the points, and arrays only if
 *   selected.
 *
 * Both outputs carry field data: `Coordinates` (Absolute, Unwrapped or Scaled: the form of the points), `PointOrigin` (3), `BoxOrigin`
 * (3), `BoxVectors` (9: a, b, c), `BoxBounds` (the header's own numbers: xlo xhi ylo yhi zlo zhi, and xy xz yz of a tilted box),
 * `Boundary` (such as "pp pp ff"), `Columns` (in the file's order and spelling), `timestep` (int64), and, if the file has them,
 * `label`, `units` and `time`. `ParticlesLeftOut` names Stride or RegionOfInterest if they leave out particles.
 * GetPointDataArraySelection has the arrays of all frames: on, except coordinate columns.
 * The reader reads only the current frame, the arrays that are on, and the rows of Stride and RegionOfInterest.
 *
 * A pipeline may ask for any piece of any number, such as one per rank. The pieces hold each particle once, in the order of the whole.
 * In text, a particle belongs to the piece whose share of the bytes contains the start of its row. Pieces of binary dumps and of sorted
 * particles have equal numbers of rows. Only piece 0 has the box. SetController describes how the ranks of a parallel program read.
 */

#ifndef vtkGranularDumpReader_h
#define vtkGranularDumpReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularParticleReader.h"

#include <string> // for std::string

namespace vtkGranularPrivate
{
struct ReaderFrames;
}

class VTKGRANULAR_EXPORT vtkGranularDumpReader : public vtkGranularParticleReader
{
public:
  static vtkGranularDumpReader* New();
  vtkTypeMacro(vtkGranularDumpReader, vtkGranularParticleReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum VerticesType
  {
    NO_VERTICES = 0,
    POLY_VERTEX = 1,
    VERTEX = 2
  };

  ///@{
  /**
   * Sets the names of all columns, separated by blanks or commas, for binary files without names (LIGGGHTS, and LAMMPS
   * before 2020). Empty, the default: 5 or 8 columns are those of dump atom, and the box tells scaled from absolute
   * coordinates; frames where it does not, and those with other numbers of columns, cannot be read.
   */
  vtkSetStdStringFromCharMacro(ColumnNames);
  vtkGetCharFromStdStringMacro(ColumnNames);
  ///@}

  /**
   * Returns true if the first 64 KiB, decompressed, begin a dump of particles: text with ITEM: TIMESTEP, UNITS or TIME
   * and, if they reach so far, ITEM: NUMBER OF ATOMS; or a plausible binary header. Also true for files that no reader
   * takes and the error of an update names, such as logs and empty files. Returns false, without a message, for all other
   * files, missing files and directories.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * Sets the precision of the points: vtkAlgorithm::SINGLE_PRECISION (7 digits of the coordinate minus PointOrigin, half
   * the memory) or vtkAlgorithm::DOUBLE_PRECISION, the default.
   */
  vtkGranularSetRangeMacro(PointPrecision, int, SINGLE_PRECISION, DOUBLE_PRECISION);
  vtkGetMacro(PointPrecision, int);
  ///@}

  ///@{
  /**
   * Sets the cells: none, one with all points, or one per point. VERTEX, one per point, by default.
   */
  vtkGranularSetRangeMacro(Vertices, int, NO_VERTICES, VERTEX);
  vtkGetMacro(Vertices, int);
  ///@}

protected:
  vtkGranularDumpReader();
  ~vtkGranularDumpReader() override = default;

private:
  vtkGranularDumpReader(const vtkGranularDumpReader&) = delete;
  void operator=(const vtkGranularDumpReader&) = delete;

  std::string ColumnNames;
  int PointPrecision = DOUBLE_PRECISION;
  int Vertices = VERTEX;

  friend struct vtkGranularPrivate::ReaderFrames;
  struct Internals;
};

#endif
