// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularLocalWriter
 * @brief   Writes contacts and bonds in the format of `dump local` of LIGGGHTS and LAMMPS.
 *
 * Writes a row for each line of a vtkPolyData, with its cell arrays and its ends, or for each row of a vtkTable: the outputs of
 * vtkGranularLocalReader and vtkGranularLocalJoin, and the bonds of vtkGranularPackingSource. The file is text, compressed if the name
 * ends in `.gz` or `.zst`.
 *
 * Columns have names that vtkGranularLocalReader recognises: force becomes forcex forcey forcez, another array A of n components A[1]
 * .. A[n]. The ends of lines are x1 y1 z1 x2 y2 z2: the arrays position1 and position2 if present, otherwise the points, converted by
 * the field data Coordinates, PointOrigin, BoxOrigin and BoxVectors; unwrapped points are written as they are. The parts of a split
 * line, with the consecutive numbers 0, 1, ... in the cell array `part`, become one row, from the first point of the first part to the
 * last point of the last. Integers are written with all their digits, and so are whole numbers in id1 and id2. The file has a box only
 * if the field data have one. Ghost cells are left out.
 *
 * The bytes do not depend on the number of ranks and threads. vtkGranularWriter describes the rest.
 */

#ifndef vtkGranularLocalWriter_h
#define vtkGranularLocalWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularWriter.h"

#include <string> // for std::string

class VTKGRANULAR_EXPORT vtkGranularLocalWriter : public vtkGranularWriter
{
public:
  static vtkGranularLocalWriter* New();
  vtkTypeMacro(vtkGranularLocalWriter, vtkGranularWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum DialectType
  {
    LIGGGHTS = 0,
    LAMMPS = 1,
    AUTOMATIC = 2
  };

  ///@{
  /**
   * Sets the program whose bytes are written. LIGGGHTS: the box with six digits. LAMMPS: with 17 digits. AUTOMATIC, the
   * default: the program of the file that the input was read from (field data `Dialect`), otherwise LAMMPS.
   */
  vtkGranularSetChoiceMacro(Dialect, "LIGGGHTS", "LAMMPS", "Automatic");
  vtkGetMacro(Dialect, int);
  ///@}

  ///@{
  /**
   * Sets the word for a row, as `dump_modify label` does: one word that names no other section of the file, such as BONDS
   * or CONTACTS. "Automatic", the default, or empty: the word of the file that the input was read from (field data
   * `RowLabel`), otherwise ENTRIES.
   */
  vtkSetStdStringFromCharMacro(Label);
  vtkGetCharFromStdStringMacro(Label);
  ///@}

  ///@{
  /**
   * Sets the names of columns or arrays, separated by blanks. Empty, the default: the columns of the file that the input
   * was read from, then all new arrays except the cell arrays `length`, `row` and `part`, which belong to the lines.
   * Example: "id1 id2 btype x1 y1 z1 x2 y2 z2 force".
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

protected:
  vtkGranularLocalWriter() = default;
  ~vtkGranularLocalWriter() override = default;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Dialect = AUTOMATIC;
  std::string Label = "Automatic";
  std::string Columns;
  std::string NumberFormat = "Automatic";

private:
  vtkGranularLocalWriter(const vtkGranularLocalWriter&) = delete;
  void operator=(const vtkGranularLocalWriter&) = delete;
};

#endif
