// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDataFileReader
 * @brief   Reads data files of LAMMPS and LIGGGHTS: particles, bonds and the box.
 *
 * Reads the text files of `read_data` and `write_data`, plain or compressed with gzip or Zstandard: the sections Atoms, Velocities,
 * Ellipsoids, Bonds, Masses, the labels of types, and what `fix property/atom` writes. A warning names other sections with rows, but
 * for coefficients. Each file is a frame; its timestep is the one in the title, or 0: see vtkGranularSeriesReader. Incomplete files
 * are left out with a warning.
 *
 * Output port 0 holds the particles (vtkPolyData) in the order of the section Atoms, with the arrays of a dump reader: `id`, `type`,
 * `image` where rows have image counts, and the columns of the atom style: `radius` (and `diameter`) and `density` of sphere, `mol`,
 * `q`, `ellipsoidflag`. Masses of types are the array `mass`, and labels of types the field data `TypeNames`. With velocities there
 * are also `v`, `omega` of sphere and `angmom` of ellipsoid. With the section Ellipsoids there are `shape`, the three diameters,
 * `quat`, w x y z, and where the file has exponents `blockiness`; particles without a row there have a shape of 0.
 *
 * Output port 1 holds the bonds as lines (vtkPolyData) with the cell arrays `bond_id`, `btype`, `id1`, `id2` and `length`. Bonds
 * without one of their particles are left out, with a warning unless Stride or RegionOfInterest left the particle out. Lines are in
 * absolute coordinates where Coordinates is SCALED.
 *
 * Output port 2 holds the simulation box as one hexahedron (vtkUnstructuredGrid). All outputs carry the field data of
 * vtkGranularDumpReader.
 *
 * The selections have the arrays of the first and the last file: all on, except coordinate columns.
 *
 * A pipeline may ask for any piece of any number. The pieces hold each particle and bond once, in the order of the whole.
 */

#ifndef vtkGranularDataFileReader_h
#define vtkGranularDataFileReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularParticleReader.h"

#include <string> // for std::string

class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularDataFileReader : public vtkGranularParticleReader
{
public:
  static vtkGranularDataFileReader* New();
  vtkTypeMacro(vtkGranularDataFileReader, vtkGranularParticleReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the bonds.
   */
  vtkPolyData* GetBonds();

  enum PeriodicLinesType
  {
    MINIMUM_IMAGE = 0,
    SPLIT = 1,
    AS_WRITTEN = 2
  };

  ///@{
  /**
   * Sets the atom style of LAMMPS or LIGGGHTS, which defines the columns, such as "sphere" or "hybrid sphere bond". Empty or
   * "automatic", the default: the style in the comment `Atoms # style`; without it the only style that fits all rows, with a
   * warning. If several styles fit, an error lists them.
   */
  vtkSetStdStringFromCharMacro(AtomStyle);
  vtkGetCharFromStdStringMacro(AtomStyle);
  ///@}

  ///@{
  /**
   * Sets the boundaries of the box, which data files do not contain: "p p f" or "pp pp ff", see granular::parse_boundary.
   * Empty, the default: axes along which a particle has an image count other than 0 are periodic.
   */
  vtkSetStdStringFromCharMacro(Boundary);
  vtkGetCharFromStdStringMacro(Boundary);
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

  /**
   * Returns true if the first bytes are a title and a header that counts atoms. Returns false, without a message, for all
   * other files, missing files and directories.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularDataFileReader();
  ~vtkGranularDataFileReader() override = default;

private:
  vtkGranularDataFileReader(const vtkGranularDataFileReader&) = delete;
  void operator=(const vtkGranularDataFileReader&) = delete;

  std::string AtomStyle;
  std::string Boundary;
  int PeriodicLines = MINIMUM_IMAGE;

  struct Internals;
};

#endif
