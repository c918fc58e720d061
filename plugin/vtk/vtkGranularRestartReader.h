// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularRestartReader
 * @brief   Reads the restart files of LIGGGHTS: particles in full precision, and bonds with their history.
 *
 * Reads what `restart` and `write_restart` of LIGGGHTS and its forks write, of either byte order and any sizes of integers, in one
 * file or in one a process (`%`: the file with `base` in its name stands for all). Each file is a frame, of the timestep in its
 * header: see vtkGranularSeriesReader. A file that is not complete, as one of two that a run writes in turn may be, is left
 * out with a warning. Restart files of LAMMPS have another format: an error says how to make a dump of one.
 *
 * Output port 0 holds the particles (vtkPolyData) in the order of the file, with the arrays that a dump reader gives them:
 * - `id`, `type`, `mask` (a bit for each group), `image` and `v` of all atom styles;
 * - what the style adds: `radius`, `mass`, `density`, `omega` of granular and sphere, `mol` of bond/gran, and so on; of a style that is not known
 *   only the above is read, with a warning;
 * - what fix property/atom stores, as `f_ID`. (Of fixes of the same size the file does not say which is which where one was defined
 *   again during the run: their values may be exchanged.)
 *
 * Output port 1 holds the bonds as lines (vtkPolyData), each once, between the particles that it holds together, with the arrays `id1`,
 * `id2`, `btype` and `length` of their cells, and the history of the bond, named as SetHistoryLayout says. `id1` is the lower id where both particles
 * hold the bond, and the history is that which its copy has: forces are those on the particle id1. (Old programs store both copies
 * with the same sign; then the file does not say on which of the two they act.) Bonds of which a particle is not there have no line.
 *
 * Output port 2 holds the simulation box as one hexahedron (vtkUnstructuredGrid).
 *
 * The outputs carry field data as those of vtkGranularDumpReader, and the first one `Groups`, the names of the bits of `mask`. A
 * pipeline may ask for any piece of any number: they hold each particle and bond once, a bond where its particle id1 is. Each process reads the
 * whole file where there are bonds.
 */

#ifndef vtkGranularRestartReader_h
#define vtkGranularRestartReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

#include <memory> // for std::unique_ptr

class vtkDataArraySelection;
class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularRestartReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularRestartReader* New();
  vtkTypeMacro(vtkGranularRestartReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The particles, and the bonds.
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
   * Which program wrote the history of bonds, which says what its values are. AUTOMATIC, the default: the one that has as many
   * values; for 13 PFM if the header of the file says so, else FLEXIBLE_FIBERS. NUMBERED: history1, history2, ... , which is also
   * what values are, with a warning, if their number is not that of the layout.
   * - WITH_BONDS, 12 values: force_normal, force_tangential, torque_normal, torque_tangential, three each;
   * - PFM, 13: these and initial_length, which the program keeps, but does not use;
   * - FLEXIBLE_FIBERS, 13 (until May 2021): these and equilibrium_length;
   * - FLEXIBLE_FIBERS_DAMAGE, 14 (later ones, SEAICE): these and damage, from 1 to 0 where the bond breaks.
   */
  void SetHistoryLayout(int layout);
  vtkGetMacro(HistoryLayout, int);
  ///@}

  ///@{
  /**
   * How bonds across the periodic faces of the box are drawn. MINIMUM_IMAGE, the default: to the nearest image of the second
   * particle, so that lines are short and leave the box. SPLIT: from both particles to the faces. AS_WRITTEN: from particle to
   * particle, through the whole box.
   */
  vtkSetClampMacro(PeriodicLines, int, MINIMUM_IMAGE, AS_WRITTEN);
  vtkGetMacro(PeriodicLines, int);
  ///@}

  ///@{
  /**
   * Subtracted from the points of all outputs, in double precision: for data far from the origin. Any finite numbers;
   * (0, 0, 0) by default.
   */
  vtkSetVector3Macro(PointOrigin, double);
  vtkGetVector3Macro(PointOrigin, double);
  ///@}

  ///@{
  /**
   * Which arrays of particles and of bonds are read. Filled by UpdateInformation() with those of the first and the last file: all on; where some were
   * switched off, others that come with another HistoryLayout or other files are off. Arrays that only other files have are read
   * where none is off.
   */
  virtual vtkDataArraySelection* GetPointDataArraySelection();
  virtual vtkDataArraySelection* GetCellDataArraySelection();
  ///@}

  /**
   * True if the first bytes are those of a restart file of LIGGGHTS or LAMMPS. False, silently, for all else, missing files and
   * directories included.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularRestartReader();
  ~vtkGranularRestartReader() override;

  void ForgetFrames() override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void InspectFrames(vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularRestartReader(const vtkGranularRestartReader&) = delete;
  void operator=(const vtkGranularRestartReader&) = delete;

  int HistoryLayout = AUTOMATIC;
  int PeriodicLines = MINIMUM_IMAGE;
  double PointOrigin[3] = { 0, 0, 0 };

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
