// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularCompare
 * @brief   Compares the particles, and the contacts or bonds, of two frames: what has moved, changed, come and gone.
 *
 * Port 0 has the particles, a vtkPointSet with the point array `id`, or lines. Port 1, optional, has lines: cells of a
 * vtkPointSet, each a line, which name two particles in the cell arrays `id1` and `id2`. Ids are integers, in arrays of any
 * type. Particles set the time; the reference frame is read from both inputs and kept until an input changes. Ghost duplicates
 * are left out.
 *
 * Output 0 has the particles as vertices, with all their arrays and
 * - `change` (vtkTypeInt32Array): 0 kept, 1 new, 2 lost
 * - `displacement` [m]: three doubles, from the reference frame to the current one; nan for new and lost particles
 * - `A_difference`: current minus reference, double, see SetDifferences; nan for new and lost particles
 *
 * and, if there are lines,
 * - `fragment` (vtkTypeInt64Array): the smallest id of the particles that lines connect with this one, directly or through
 *   others; its own id without lines
 * - `fragment_size` (vtkTypeInt64Array): the number of particles in the fragment
 * - `fragment_mass` [kg]: double, the sum of their masses, correctly rounded; only where masses are known, see SetMassArray
 *
 * Lost particles come behind the others, where the reference frame has them, with the arrays that both frames have with the
 * same type and number of components. All other values of theirs are nan for floating point numbers, 0 for integers
 * (`fragment` and `fragment_size`, too), and empty texts.
 *
 * Output 1 has the lines of the current frame, and behind them the lost ones where they were, with the cell arrays of the
 * lines, `change`, and `age` (double): the time since the reference frame for kept lines, which is the least that they are old, 0
 * for new ones. Values that lost lines do not have are as above. Each line has points of its own; point arrays are not
 * passed. If port 0 has lines, output 0 has these lines instead of particles, and output 1 is empty.
 *
 * Lines are the same if they connect the same two particles, in any order. If a frame has several lines
 * between two particles, the k-th one is compared with the k-th one of the other frame.
 *
 * Displacements are those of unwrapped positions, each with the box of its own frame, if the points are unwrapped, or if there
 * is an integer array `image` with three counts and a box. Otherwise they are the shortest periodic image in the current box,
 * and a warning counts particles that moved more than a quarter of a period. Field data are those of the current frame.
 *
 * An id that repeats within a frame is an error, which names the id and both rows. A warning is repeated only after inputs or
 * properties have changed, or when it came back.
 */

#ifndef vtkGranularCompare_h
#define vtkGranularCompare_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkAlgorithmOutput;
class vtkPolyData;

namespace vtkGranularPrivate
{
class KeptFrames;
}

class VTKGRANULAR_EXPORT vtkGranularCompare : public vtkGranularAlgorithm
{
public:
  static vtkGranularCompare* New();
  vtkTypeMacro(vtkGranularCompare, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the particles, or the lines if port 0 has lines.
   */
  vtkPolyData* GetOutput();

  /**
   * Returns the lines of input port 1; empty without it.
   */
  vtkPolyData* GetLinesOutput();

  enum ReferenceType
  {
    FIRST = 0,
    PREVIOUS = 1,
    TIME = 2
  };

  /**
   * Sets the lines: input port 1, optional.
   */
  void SetLinesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

  ///@{
  /**
   * Sets the frame that the current one is compared with. FIRST, the default: the first frame, and of particles the first one that
   * has any. PREVIOUS: the frame before the current one; the first frame is compared with itself. TIME: the last frame at or before
   * ReferenceTime, or the first one. Inputs with one time or none are compared with themselves: all is kept.
   */
  vtkGranularSetRangeMacro(Reference, int, FIRST, TIME);
  vtkGetMacro(Reference, int);
  ///@}

  ///@{
  /**
   * Sets the time of the reference frame for TIME, in the unit of the input's times. A finite number, 0 by default.
   */
  vtkSetMacro(ReferenceTime, double);
  vtkGetMacro(ReferenceTime, double);
  ///@}

  ///@{
  /**
   * Sets the point arrays of the particles for which A_difference is made: names separated by blanks or commas; "*" stands
   * for all numeric arrays but id that both frames have with the same number of components. None by default.
   */
  vtkSetStdStringFromCharMacro(Differences);
  vtkGetCharFromStdStringMacro(Differences);
  ///@}

  ///@{
  /**
   * Sets the point array of the masses of particles ("mass" by default) [kg]. Without it masses are those of spheres by the
   * arrays density [kg/m3] and radius [m]; without these there is no fragment_mass.
   */
  vtkSetStdStringFromCharMacro(MassArray);
  vtkGetCharFromStdStringMacro(MassArray);
  ///@}

protected:
  vtkGranularCompare();
  ~vtkGranularCompare() override;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularCompare(const vtkGranularCompare&) = delete;
  void operator=(const vtkGranularCompare&) = delete;

  class Task;

  int Reference = FIRST;
  double ReferenceTime = 0;
  std::string Differences;
  std::string MassArray = "mass";
  const std::unique_ptr<vtkGranularPrivate::KeptFrames> Frames;
};

#endif
