// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularRestartReader
 * @brief   Reads restart files of LIGGGHTS: particles in full precision, and bonds with their history.
 *
 * Reads the files that `restart` and `write_restart` of LIGGGHTS and its forks write, of either byte order and any sizes of integers,
 * in one file or one per rank (`%`: the file with `base` in its name stands for all). Each file is a frame with the timestep of its
 * header: see vtkGranularSeriesReader. An incomplete file, such as one of two that a run writes in turn, is left out with a warning.
 * LAMMPS writes restart files in another format; the error tells how to make a data file of one.
 *
 * Output port 0 holds the particles (vtkPolyData) in the order of the file, with the arrays of a dump reader:
 * - `id`, `type`, `mask` (a bit for each group), `image` and `v` of all atom styles;
 * - the columns of the style: `radius`, `mass`, `density`, `omega` of granular and sphere, `mol` of bond/gran, and so on; of an
 *   unknown style only the above is read, with a warning;
 * - the values of fix property/atom, as `f_ID`. (If a fix was defined again during the run, the file does not tell fixes of the same
 *   size apart: their values may be exchanged.)
 *
 * Output port 1 holds the bonds as lines (vtkPolyData), each once, with the cell arrays `id1`, `id2`, `btype` and `length`, and the
 * history of the bond, named by SetHistoryLayout. If both particles hold a bond, `id1` is the lower id, and the history is that of its
 * copy: forces act on the particle id1. (Old programs store both copies with the same sign; then the file does not tell on which of
 * the two they act.) Bonds without one of their particles have no line.
 *
 * Output port 2 holds the simulation box as one hexahedron (vtkUnstructuredGrid).
 *
 * The selections have the arrays of the first and the last file: all on. Once some were switched off, arrays that come with another
 * HistoryLayout or other files are off. Arrays that only other files have are read unless one is off.
 *
 * The outputs carry the field data of vtkGranularDumpReader, and the first one `Groups`, the names of the bits of `mask`. A pipeline may
 * ask for any piece of any number. The pieces hold each particle and bond once, a bond with its particle id1. Each rank reads the whole
 * file if there are bonds.
 */

#ifndef vtkGranularRestartReader_h
#define vtkGranularRestartReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularRestartReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularRestartReader* New();
  vtkTypeMacro(vtkGranularRestartReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Returns the particles, and the bonds.
   */
  vtkPolyData* GetOutput();
  vtkPolyData* GetBonds();
  ///@}

  enum HistoryLayoutType
  {
    AUTOMATIC = 0,
    NUMBERED = 1,
    WITH_BONDS = 2,
    PFM = 3,
    FLEXIBLE_FIBERS = 4,
    FLEXIBLE_FIBERS_DAMAGE = 5
  };

  enum PeriodicLinesType
  {
    MINIMUM_IMAGE = 0,
    SPLIT = 1,
    AS_WRITTEN = 2
  };

  ///@{
  /**
   * Sets the program that wrote the history of bonds, which says what its values are: see granular::make_bond_schema. AUTOMATIC, the
   * default: the one with as many values. NUMBERED: history1, history2, ...
   */
  vtkGranularSetRangeMacro(HistoryLayout, int, AUTOMATIC, FLEXIBLE_FIBERS_DAMAGE);
  vtkGetMacro(HistoryLayout, int);
  ///@}

  ///@{
  /**
   * Sets how lines across periodic faces of the box are drawn. MINIMUM_IMAGE, the default: to the nearest image of the
   * second particle; the line is short and may leave the box. SPLIT: from both particles to the faces, in parts.
   * AS_WRITTEN: from end to end, through the whole box.
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
   * Returns true if the first bytes are those of a restart file of LIGGGHTS or LAMMPS. Returns false, without a message,
   * for all other files, missing files and directories.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularRestartReader();
  ~vtkGranularRestartReader() override = default;

private:
  vtkGranularRestartReader(const vtkGranularRestartReader&) = delete;
  void operator=(const vtkGranularRestartReader&) = delete;

  int HistoryLayout = AUTOMATIC;
  int PeriodicLines = MINIMUM_IMAGE;
  double PointOrigin[3] = { 0, 0, 0 };

  struct Internals;
};

#endif
