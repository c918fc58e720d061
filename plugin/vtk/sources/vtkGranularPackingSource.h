// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularPackingSource
 * @brief   Makes particles that do not overlap, at random positions, on a lattice or in a chain, without a file.
 *
 * Output port 0 holds the particles (vtkPolyData, one vertex per particle), port 1 the box (vtkUnstructuredGrid, one hexahedron), with
 * the arrays and field data that vtkGranularDumpReader gives for a dump of timestep 0 with the columns id type x y z radius vx vy vz:
 * `id` (vtkTypeInt64Array from 1, and the pedigree ids), `type` (vtkTypeInt32Array), `radius`, `v` (3). A chain also has `mol`
 * (vtkTypeInt64Array), which is 1.
 *
 * Port 2 holds the bonds of BondFactor (vtkPolyData, one line per bond, with two points of its own), from a centre to the nearest image
 * of the other, and the same field data. Cell arrays are `id1` and the greater `id2` (vtkTypeInt64Array), `btype` (vtkTypeInt32Array,
 * 1), `equilibrium_length`, and `length`, which is equal.
 *
 * Particles lie entirely inside the box; along periodic axes only their centres do, and their periodic images do not overlap particles
 * either. Random particles do not touch; particles on lattices and in chains do at Spacing 1.
 *
 * Each particle depends only on the properties and its number, so any pieces, threads and ranks give the same ones. Each rank
 * places all random particles and keeps its own. Pieces hold equal
 * numbers of particles, in the order of their ids, and their bonds to greater ids, in the order of (id1, id2). Only piece 0 has the
 * box.
 */

#ifndef vtkGranularPackingSource_h
#define vtkGranularPackingSource_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkPolyData;

namespace vtkGranularPrivate
{
class VertexCache;
}

class VTKGRANULAR_EXPORT vtkGranularPackingSource : public vtkGranularAlgorithm
{
public:
  static vtkGranularPackingSource* New();
  vtkTypeMacro(vtkGranularPackingSource, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the particles.
   */
  vtkPolyData* GetOutput();

  enum ArrangementType
  {
    RANDOM = 0,
    SIMPLE_CUBIC = 1,
    FACE_CENTRED_CUBIC = 2,
    CHAIN = 4
  };

  enum RadiiType
  {
    ONE = 0,
    TWO = 1
  };

  ///@{
  /**
   * RANDOM, the default; or whole cells of a lattice along the box vectors, in the middle of the box; or a
   * CHAIN, one straight row of particles along the first box vector, which begins a radius inside the low face; one that
   * is longer than the box is an error. NumberOfGrains: 0, the default: as many as the box holds, in that arrangement or
   * at the solid fraction, and 1000 where no box is given; at most 10^7 random particles.
   */
  vtkSetMacro(Arrangement, int);
  vtkGetMacro(Arrangement, int);
  vtkSetMacro(NumberOfGrains, vtkTypeInt64);
  vtkGetMacro(NumberOfGrains, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * The box: its low corner, (0, 0, 0) by default; its lengths lx ly lz, greater than 0, or (0, 0, 0), the default: then
   * a box is made for the particles; its tilts xy xz yz, (0, 0, 0) by default, of a box whose lengths are given. The
   * box vectors are (lx, 0, 0), (xy, ly, 0) and (xz, yz, lz). In the unit of the radii.
   */
  vtkSetVector3Macro(BoxOrigin, double);
  vtkGetVector3Macro(BoxOrigin, double);
  vtkSetVector3Macro(BoxLengths, double);
  vtkGetVector3Macro(BoxLengths, double);
  vtkSetVector3Macro(BoxTilts, double);
  vtkGetVector3Macro(BoxTilts, double);
  ///@}

  ///@{
  /**
   * Sets the faces along the three box vectors: one or two of the letters p (periodic), f, s, m (particles stay inside)
   * each. "ff ff ff" by default.
   */
  vtkSetStdStringFromCharMacro(Boundary);
  vtkGetCharFromStdStringMacro(Boundary);
  ///@}

  ///@{
  /**
   * ONE: all particles have Radius. TWO, the default: a share of them, SecondShare, 0 to 1 and 0.3 by default,
   * has SecondRadius, and type 2. Radii are greater than 0, the larger at most 20 times the smaller; 0.003 and 0.005 by
   * default.
   */
  vtkSetMacro(Radii, int);
  vtkGetMacro(Radii, int);
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  vtkSetMacro(SecondRadius, double);
  vtkGetMacro(SecondRadius, double);
  vtkSetMacro(SecondShare, double);
  vtkGetMacro(SecondShare, double);
  ///@}

  ///@{
  /**
   * SolidFraction: volume of random particles by that of the box, where not both their number and the box are
   * given; greater than 0, 0.2 by default, and up to about 0.3 particles find their places. Spacing: distance
   * of nearest neighbours, of lattices and chains, by the largest diameter; at least 1, the default, where
   * they touch.
   */
  vtkSetMacro(SolidFraction, double);
  vtkGetMacro(SolidFraction, double);
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}

  /// 0, the default: no bonds. From 1 to 3: bonds between particles whose centres are no farther apart than this times
  /// the sum of their radii, within rounding; through periodic faces, too, but one at most for a pair. In
  /// a chain consecutive particles are bonded, whatever the factor.
  vtkSetMacro(BondFactor, double);
  vtkGetMacro(BondFactor, double);

  /// Speed: standard deviation of each component of the velocities, which are normally distributed around
  /// 0; at least 0, the default: particles at rest. Seed: another one gives other places, sizes and
  /// velocities; 1 by default.
  vtkSetMacro(Speed, double);
  vtkGetMacro(Speed, double);
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);

protected:
  vtkGranularPackingSource();
  ~vtkGranularPackingSource() override;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularPackingSource(const vtkGranularPackingSource&) = delete;
  void operator=(const vtkGranularPackingSource&) = delete;

  class Task;

  int Arrangement = RANDOM;
  vtkTypeInt64 NumberOfGrains = 0;
  double BoxOrigin[3] = { 0, 0, 0 };
  double BoxLengths[3] = { 0, 0, 0 };
  double BoxTilts[3] = { 0, 0, 0 };
  std::string Boundary = "ff ff ff";
  int Radii = TWO;
  double Radius = 0.003;
  double SecondRadius = 0.005;
  double SecondShare = 0.3;
  double SolidFraction = 0.2;
  double Spacing = 1;
  double BondFactor = 0;
  double Speed = 0;
  int Seed = 1;
  const std::unique_ptr<vtkGranularPrivate::VertexCache> Vertices; ///< of the request before
};

#endif
