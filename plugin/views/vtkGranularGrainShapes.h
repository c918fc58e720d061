// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainShapes_h
#define vtkGranularGrainShapes_h

#include <array>
#include <vector>

#include "vtkType.h"

class vtkDataArray;
class vtkDataSet;

/**
 * The shapes of particles that are no spheres, from the point arrays that dumps of LIGGGHTS and LAMMPS have:
 * - sizes: `shape`, or shapex shapey shapez; or, where there are rotations, a compute c_shape, c_s or c_diameter. They are half axes
 *   or diameters, as the field data ShapeSizes tell (HalfAxes or Diameters) or the user; without either, diameters of LAMMPS
 *   (field data Dialect) and half axes of others;
 * - rotations w x y z, which turn the particle's axes into those of the points: `quat`, quat1.., quatw.., or a compute c_q or c_quat;
 *   without them nothing is turned;
 * - exponents n1 along the particle's z and n2 across it, both at least 2: `blockiness`, blockiness1.., block1.., or c_block; without
 *   them 2 and 2, an ellipsoid.
 */
class vtkGranularGrainShapes
{
public:
  enum SizesAre
  {
    AsTheDataSay,
    HalfAxes,
    Diameters
  };

  vtkGranularGrainShapes(vtkDataSet* data, int sizes);

  /// The particles are not spheres.
  bool Any() const { return !this->Sizes.empty(); }

  struct Shape
  {
    std::array<double, 3> Axes; ///< half axes
    std::array<double, 4> Turn; ///< w x y z, of length 1
    std::array<double, 2> Powers;
    double Outer; ///< radius of a sphere around it
    double Inner; ///< radius of a sphere inside it
  };

  /// Returns the shape of a particle: a sphere of the given radius if one of its axes is not greater than 0. Needs Any().
  Shape Get(vtkIdType i, double radius) const;

private:
  using Arrays = std::vector<vtkDataArray*>;

  Arrays Sizes;
  Arrays Turns;
  Arrays Powers;
  double Factor = 1.0;
};

#endif
