// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularLocalReader
 * @brief   Reads `dump local` files: contacts and bonds.
 *
 * Reads the text files of `dump local` of LIGGGHTS and LAMMPS with any word for their rows (ENTRIES, or that of `dump_modify label`),
 * with and without a box, and with one file per rank (`%`), where only the first file has a header. vtkGranularSeriesReader tells which
 * frames there are. vtkGranularDataFileReader reads the bonds of data files.
 *
 * Output port 0 holds lines (vtkPolyData), one cell per row with two points of its own, if the columns give the ends; otherwise it is
 * empty. Output port 1 holds the rows as a table (vtkTable), from which vtkGranularLocalJoin makes lines by the ids of particles.
 * SetPreset and SetColumnMap define the meaning of the columns, which become arrays of the cells and of the table:
 * - `id1` and `id2`, the particles at the ends, are vtkTypeInt64Array; `btype` and `periodic` are vtkTypeInt32Array; others are double;
 * - three columns x, y, z of a vector become one array: `force`, `torque`, `v1` and so on;
 * - `length` is the length of the drawn line, over all its parts if it is split, or `length_2` if the file has a column `length`;
 * - `position1` and `position2` are the ends as the file has them; unlike the other arrays, they are off by default;
 * - `row` and `part`, if lines are split: the number of the row in the frame, from 0 (vtkTypeInt64Array), and the number of the part,
 *   0 at the first end (vtkTypeInt32Array);
 * - columns of the file that are named `row` or `part` become `row_2` and `part_2` then.
 *
 * Output port 2 holds the simulation box (vtkUnstructuredGrid), one hexahedron, if the file has one.
 *
 * All outputs carry the field data of vtkGranularDumpReader: PointOrigin, Columns, timestep, and the box if the file has one. A
 * pipeline may ask for any piece of any number. The pieces hold each row once.
 */

#ifndef vtkGranularLocalReader_h
#define vtkGranularLocalReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

#include <string> // for std::string

class vtkPolyData;
class vtkTable;
class vtkUnstructuredGrid;

class VTKGRANULAR_EXPORT vtkGranularLocalReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularLocalReader* New();
  vtkTypeMacro(vtkGranularLocalReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the lines.
   */
  vtkPolyData* GetOutput();

  /**
   * Returns the rows.
   */
  vtkTable* GetRows();

  /**
   * Returns the simulation box as one cell.
   */
  vtkUnstructuredGrid* GetBox();

  enum PresetType
  {
    AUTOMATIC = 0,
    AS_NAMED = 1,
    BOND_IDS = 2,
    BOND_TYPE_IDS = 3,
    BONDS = 4,
    BONDS_FORCE = 5,
    BONDS_FORCE_TORQUE = 6,
    CONTACTS = 7,
    CONTACTS_FORCE = 8,
    WALL_CONTACTS = 9,
    WALL_CONTACTS_FORCE = 10,
    BOND_IDS_FORCE = 11,
    BOND_TYPE_IDS_FORCE = 12
  };

  enum PeriodicLinesType
  {
    MINIMUM_IMAGE = 0,
    SPLIT = 1,
    AS_WRITTEN = 2
  };

  ///@{
  /**
   * Sets the meaning of the columns, which files rarely tell: c_b[1] can be anything. AUTOMATIC, the default: by the names, or the
   * only preset that fits the values. AS_NAMED: by the names. Others: the columns of granular::local_presets in their order.
   */
  vtkGranularSetRangeMacro(Preset, int, AUTOMATIC, BOND_TYPE_IDS_FORCE);
  vtkGetMacro(Preset, int);
  ///@}

  ///@{
  /**
   * Sets the meaning of the columns in the words of the user, instead of Preset if it is not empty: see granular::name_columns.
   */
  vtkSetStdStringFromCharMacro(ColumnMap);
  vtkGetCharFromStdStringMacro(ColumnMap);
  ///@}

  ///@{
  /**
   * Sets how lines across periodic faces of the box are drawn. MINIMUM_IMAGE, the default: to the nearest image of the
   * second end; the line is short and may leave the box. SPLIT: from both ends to the faces, in parts. AS_WRITTEN: from
   * end to end, through the whole box.
   */
  vtkGranularSetRangeMacro(PeriodicLines, int, MINIMUM_IMAGE, AS_WRITTEN);
  vtkGetMacro(PeriodicLines, int);
  ///@}

  ///@{
  /**
   * Sets a point that is subtracted from all points, in double precision and before any rounding; for data far from the
   * origin. Any finite numbers; (0, 0, 0) by default.
   */
  vtkSetVector3Macro(PointOrigin, double);
  vtkGetVector3Macro(PointOrigin, double);
  ///@}

  /**
   * Returns true if the first 64 KiB, decompressed, are text of dump local (ITEM: NUMBER OF, but not ATOMS). Returns
   * false, without a message, for all other files, missing files and directories.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularLocalReader();
  ~vtkGranularLocalReader() override = default;

private:
  vtkGranularLocalReader(const vtkGranularLocalReader&) = delete;
  void operator=(const vtkGranularLocalReader&) = delete;

  int Preset = AUTOMATIC;
  std::string ColumnMap;
  int PeriodicLines = MINIMUM_IMAGE;
  double PointOrigin[3] = { 0, 0, 0 };

  struct Internals;
};

#endif
