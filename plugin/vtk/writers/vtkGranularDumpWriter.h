// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDumpWriter
 * @brief   Writes particle dumps in the formats of LIGGGHTS and LAMMPS.
 *
 * Writes the points of a vtkPointSet and their arrays like `dump atom` or `dump custom`. Files are text, or binary if the name ends in
 * `.bin` or `.lammpsbin`; text is compressed if the name ends in `.gz` or `.zst`.
 *
 * A vector becomes the columns from which the reader makes it: v becomes vx vy vz, image ix iy iz. An array A of n components without
 * such columns becomes A[1] .. A[n]. The points give x, xs, xu and xsu, which are converted by the field data of
 * vtkGranularDumpReader (Coordinates, PointOrigin, BoxOrigin, BoxVectors, BoxBounds, Boundary, timestep, time, units, label). Where a
 * reader kept a coordinate column as an array, its numbers are written as long as they match the point within rounding. Without a box,
 * the bounds of the particles become the box, with a warning. A missing id is the number of the point, a missing type is 1, missing
 * image counts are 0, each with a warning. Ghost duplicates are left out.
 *
 * The bytes do not depend on the number of ranks and threads. vtkGranularWriter describes the rest.
 */

#ifndef vtkGranularDumpWriter_h
#define vtkGranularDumpWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularWriter.h"

#include <string> // for std::string

class VTKGRANULAR_EXPORT vtkGranularDumpWriter : public vtkGranularWriter
{
public:
  static vtkGranularDumpWriter* New();
  vtkTypeMacro(vtkGranularDumpWriter, vtkGranularWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum StyleType
  {
    ATOM = 0,
    CUSTOM = 1
  };

  enum DialectType
  {
    LIGGGHTS = 0,
    LAMMPS = 1,
    AUTOMATIC = 2
  };

  ///@{
  /**
   * Sets the columns. ATOM: those of `dump atom`: id, type, coordinates and, with Image, the image counts. CUSTOM, the
   * default: see SetColumns.
   */
  vtkGranularSetChoiceMacro(Style, "Atom", "Custom");
  vtkGetMacro(Style, int);
  ///@}

  ///@{
  /**
   * Sets the program whose bytes are written. LIGGGHTS: the box with six digits, binary files without the names of their
   * columns, a blank at the end of each line of `dump custom`, and ITEM: LABEL if the input has one. LAMMPS: the box with
   * 17 digits, binary files of revision 2 with names. AUTOMATIC, the default: the program of the file that the input was
   * read from (field data `Dialect`), otherwise LAMMPS; LAMMPS also with WriteUnits or WriteTime, and for a binary file
   * made from text, which then names its columns.
   */
  vtkGranularSetChoiceMacro(Dialect, "LIGGGHTS", "LAMMPS", "Automatic");
  vtkGetMacro(Dialect, int);
  ///@}

  ///@{
  /**
   * On, the default: ATOM writes coordinates in units of the box vectors (xs ys zs), as `dump atom` does. Off: x y z.
   */
  vtkSetMacro(Scaled, bool);
  vtkGetMacro(Scaled, bool);
  vtkBooleanMacro(Scaled, bool);
  ///@}

  ///@{
  /**
   * On: ATOM also writes the image counts ix iy iz. Off by default.
   */
  vtkSetMacro(Image, bool);
  vtkGetMacro(Image, bool);
  vtkBooleanMacro(Image, bool);
  ///@}

  ///@{
  /**
   * Sets the names of columns or arrays for CUSTOM, separated by blanks. Empty, the default: the columns of the file that
   * the input was read from, then all new arrays; without such a file id, type, x, y, z and all arrays. Example: "id type
   * xs ys zs v radius".
   */
  vtkSetStdStringFromCharMacro(Columns);
  vtkGetCharFromStdStringMacro(Columns);
  ///@}

  ///@{
  /**
   * Sets the digits of real numbers in text. "Automatic", the default, loses nothing: a column that was read from a text
   * dump keeps that file's digits, and gets more only where a value has changed; other columns have the fewest digits that
   * read back as the same number. "%g" has six digits, "%.Ng" N from 1 to 17, "shortest" the fewest that read back as the
   * same number.
   */
  vtkSetStdStringFromCharMacro(NumberFormat);
  vtkGetCharFromStdStringMacro(NumberFormat);
  ///@}

  ///@{
  /**
   * On: rows are sorted by id, over all ranks; needs memory for a copy. Off, the default: the order of the points.
   */
  vtkSetMacro(SortById, bool);
  vtkGetMacro(SortById, bool);
  vtkBooleanMacro(SortById, bool);
  ///@}

  ///@{
  /**
   * On: LAMMPS files have ITEM: UNITS in their first frame, with the input's units. Off by default.
   */
  vtkSetMacro(WriteUnits, bool);
  vtkGetMacro(WriteUnits, bool);
  vtkBooleanMacro(WriteUnits, bool);
  ///@}

  ///@{
  /**
   * On: LAMMPS files have ITEM: TIME in each frame: the time from the input's file, otherwise that of the pipeline. Off by
   * default.
   */
  vtkSetMacro(WriteTime, bool);
  vtkGetMacro(WriteTime, bool);
  vtkBooleanMacro(WriteTime, bool);
  ///@}

  ///@{
  /**
   * Sets the box: a corner, and its three edges one after the other, (Lx 0 0 xy Ly 0 xz yz Lz) for a tilted one. Edges of
   * 0, the default: the box of the input.
   */
  vtkSetVector3Macro(BoxOrigin, double);
  vtkGetVector3Macro(BoxOrigin, double);
  vtkSetVectorMacro(BoxVectors, double, 9);
  vtkGetVectorMacro(BoxVectors, double, 9);
  ///@}

  ///@{
  /**
   * Sets the boundaries of the box as in dumps, "pp pp ff": p periodic, f fixed, s and m shrinking, for the lower and the
   * upper face of each axis. Empty, the default: those of the input.
   */
  vtkSetStdStringFromCharMacro(Boundary);
  vtkGetCharFromStdStringMacro(Boundary);
  ///@}

protected:
  vtkGranularDumpWriter() = default;
  ~vtkGranularDumpWriter() override = default;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Style = CUSTOM;
  int Dialect = AUTOMATIC;
  bool Scaled = true;
  bool Image = false;
  std::string Columns;
  std::string NumberFormat = "Automatic";
  bool SortById = false;
  bool WriteUnits = false;
  bool WriteTime = false;
  double BoxOrigin[3] = { 0, 0, 0 };
  double BoxVectors[9] = { 0, 0, 0, 0, 0, 0, 0, 0, 0 };
  std::string Boundary;

private:
  vtkGranularDumpWriter(const vtkGranularDumpWriter&) = delete;
  void operator=(const vtkGranularDumpWriter&) = delete;
};

#endif
