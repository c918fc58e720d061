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
   * Which columns there are. ATOM: those of `dump atom`: id, type, coordinates and, with Image, the image
   * counts. CUSTOM, the default: Columns.
   */
  void SetStyle(int style);
  vtkGetMacro(Style, int);
  ///@}

  ///@{
  /**
   * Whose bytes are written. LIGGGHTS: the box with six digits, binary files without the names of their columns, a
   * blank at the end of each line of `dump custom`, and ITEM: LABEL where the input has one. LAMMPS: the box with 17 digits,
   * binary files of revision 2 with names. AUTOMATIC, the default: that of the file that the input was read from, by its
   * field data `Dialect`, else LAMMPS; LAMMPS also with WriteUnits or WriteTime, and for a binary file of a text, so that it names its
   * columns.
   */
  void SetDialect(int dialect);
  vtkGetMacro(Dialect, int);
  ///@}

  ///@{
  /**
   * Of ATOM: coordinates in units of the box vectors (xs ys zs), as `dump atom` has it, and else x y z. On by
   * default.
   */
  vtkSetMacro(Scaled, bool);
  vtkGetMacro(Scaled, bool);
  vtkBooleanMacro(Scaled, bool);
  ///@}

  ///@{
  /**
   * Of ATOM: the image counts ix iy iz, too. Off by default.
   */
  vtkSetMacro(Image, bool);
  vtkGetMacro(Image, bool);
  vtkBooleanMacro(Image, bool);
  ///@}

  ///@{
  /**
   * Of CUSTOM: names of columns, or of arrays, separated by blanks. Empty, the default: the columns of the
   * file that the input was read from, and those of all arrays that are new; without such a file id, type, x, y, z and
   * all arrays. Example: "id type xs ys zs v radius".
   */
  vtkSetStringMacro(Columns);
  vtkGetStringMacro(Columns);
  ///@}

  ///@{
  /**
   * How real numbers look in text. "Automatic", the default, loses nothing: a column that was read from a text dump has that file's
   * digits, and more only where a value has changed; other columns have as few digits as read back as the same number.
   * "%g" has six digits, "%.Ng" N from 1 to 17, "shortest" as few as read back as the same number.
   */
  vtkSetStringMacro(NumberFormat);
  vtkGetStringMacro(NumberFormat);
  ///@}

  ///@{
  /**
   * On: rows are in the order of their ids, over all processes; needs memory for a copy. Off by default: the
   * order of the points.
   */
  vtkSetMacro(SortById, bool);
  vtkGetMacro(SortById, bool);
  vtkBooleanMacro(SortById, bool);
  ///@}

  ///@{
  /**
   * Of LAMMPS: ITEM: UNITS in the first frame of a file, with Units, or with those of the input where that is
   * empty. Off by default.
   */
  vtkSetMacro(WriteUnits, bool);
  vtkGetMacro(WriteUnits, bool);
  vtkBooleanMacro(WriteUnits, bool);
  vtkSetStringMacro(Units);
  vtkGetStringMacro(Units);
  ///@}

  ///@{
  /**
   * Of LAMMPS: ITEM: TIME in each frame: the time that the file of the input gave, else that of the pipeline.
   * Off by default.
   */
  vtkSetMacro(WriteTime, bool);
  vtkGetMacro(WriteTime, bool);
  vtkBooleanMacro(WriteTime, bool);
  ///@}

  ///@{
  /**
   * The box: a corner, and its three edges one after the other, (Lx 0 0 xy Ly 0 xz yz Lz) for a tilted one. Edges
   * of 0, the default: the box of the input.
   */
  vtkSetVector3Macro(BoxOrigin, double);
  vtkGetVector3Macro(BoxOrigin, double);
  vtkSetVectorMacro(BoxVectors, double, 9);
  vtkGetVectorMacro(BoxVectors, double, 9);
  ///@}

  ///@{
  /**
   * The boundaries of the box as in dumps, "pp pp ff": p periodic, f fixed, s and m shrinking, the lower and the
   * upper face of each axis. Empty, the default: those of the input.
   */
  vtkSetStringMacro(Boundary);
  vtkGetStringMacro(Boundary);
  ///@}

protected:
  vtkGranularDumpWriter();
  ~vtkGranularDumpWriter() override;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Style = CUSTOM;
  int Dialect = AUTOMATIC;
  bool Scaled = true;
  bool Image = false;
  char* Columns = nullptr;
  char* NumberFormat = nullptr;
  bool SortById = false;
  bool WriteUnits = false;
  char* Units = nullptr;
  bool WriteTime = false;
  double BoxOrigin[3] = { 0, 0, 0 };
  double BoxVectors[9] = { 0, 0, 0, 0, 0, 0, 0, 0, 0 };
  char* Boundary = nullptr;

private:
  vtkGranularDumpWriter(const vtkGranularDumpWriter&) = delete;
  void operator=(const vtkGranularDumpWriter&) = delete;

  class File;
};

#endif
