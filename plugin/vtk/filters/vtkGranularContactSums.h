// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularContactSums
 * @brief   Sums the contacts of each particle: coordination, force, torque, fabric, stress.
 *
 * Port 0 has the particles, a vtkPointSet with the point array `id`. Port 1 has contacts between particles, port 2 contacts with
 * walls; at least one of them. Contacts are lines, or rows of a vtkTable.
 * Rows of port 1 name two particles in `id1` and `id2`, rows of port 2 one in `id2`; there a line goes from the point that is touched
 * to the centre, as compute wall/gran/local of LIGGGHTS has it. Cell arrays that count: `force` on the first particle, of walls on the
 * particle (without it `force_normal` and `force_tangential`), `torque` on the same particle, `contact_point`, `delta` (overlap).
 * Rows without forces give coordination and fabric alone.
 *
 * The particles get, as selected (see GetArraySelection):
 * - `coordination`: number of contacts that count (see SetMinimumForce), vtkTypeInt32
 * - `contact_force` [N] and `contact_torque` [N m]: sums over all contacts
 * - `fabric`: mean of n_a n_b over the contacts that count, n along the line; xx yy zz xy xz yz, trace 1, or 0 without contacts
 * - `contact_stress`: sum of l_a f_b [N m], xx yy zz xy xz yz, l from the centre to where the force f on the particle acts (see
 *   SetLeverArm): stress times volume with the sign of `compute stress/atom` of LAMMPS, negative in compression. Over all particles it is
 *   the sum of branch_a force_b over the contacts.
 * - `principal_stress` (three, the largest first) and `von_mises` [Pa]: of contact_stress over the volume of the sphere
 * - `rattler` and `coordination_without_rattlers`: see SetRattlerContacts
 *
 * The second output has the lines of port 1 with `mobilised_friction`, if that is selected; otherwise it is empty.
 * Field data: `mean_coordination`, `mean_coordination_without_rattlers`.
 *
 * Sums are correctly rounded: the results are the same, bit for bit, for any order of particles and contacts, threads and ranks.
 * Particles and contacts may be on different ranks. Contacts that name a particle which is not there count for the other one, and are
 * counted in a warning; rows without lines count for its coordination and force alone. Contacts with a number that is not finite are
 * left out, with a warning. Lines go from particle to particle by the shortest way through the periodic faces of the particles' box, as
 * rows do, however they are drawn. Without that box they are as drawn, and the shortest in their own box.
 */

#ifndef vtkGranularContactSums_h
#define vtkGranularContactSums_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <string> // for std::string

class vtkAlgorithmOutput;
class vtkDataArraySelection;
class vtkPolyData;

class VTKGRANULAR_EXPORT vtkGranularContactSums : public vtkGranularAlgorithm
{
public:
  static vtkGranularContactSums* New();
  vtkTypeMacro(vtkGranularContactSums, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the particles.
   */
  vtkPolyData* GetOutput();

  /**
   * Returns the lines with `mobilised_friction`; empty if it is not selected.
   */
  vtkPolyData* GetLinesOutput();

  enum LeverArmType
  {
    CONTACT_POINT = 0,
    HALF_BRANCH = 1
  };

  ///@{
  /**
   * Sets the contacts between particles, and those with walls: input ports 1 and 2, both optional.
   */
  void SetLinesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetWallsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }
  ///@}

  /**
   * Returns the selection of the arrays that are made. Those that are off cost nothing. Off by default are
   * `principal_stress`, `von_mises`, `rattler`, `coordination_without_rattlers` and `mobilised_friction`.
   */
  virtual vtkDataArraySelection* GetArraySelection() { return this->ArraySelection; }

  ///@{
  /**
   * Turns an array of GetArraySelection on or off, or all off.
   */
  void SetArrayStatus(const char* name, int status);
  void ClearArrays();
  ///@}

  ///@{
  /**
   * Sets where forces act. CONTACT_POINT, the default: at the array `contact_point`; without it at that part of the line which
   * the radii give, r1 / (r1 + r2); without radii at half the line. HALF_BRANCH: at half the line, as compute stress/atom has it.
   * Contacts with walls always act at the wall.
   */
  vtkGranularSetRangeMacro(LeverArm, int, CONTACT_POINT, HALF_BRANCH);
  vtkGetMacro(LeverArm, int);
  ///@}

  ///@{
  /**
   * Sets the force [N] and the overlap [m] from which on a contact counts for `coordination`, `fabric` and rattlers. The overlap
   * is `delta`, or the sum of the radii minus the length. 0 and more; 0, the default: all count.
   */
  vtkSetMacro(MinimumForce, double);
  vtkGetMacro(MinimumForce, double);
  vtkSetMacro(MinimumOverlap, double);
  vtkGetMacro(MinimumOverlap, double);
  ///@}

  ///@{
  /**
   * Sets the number of contacts below which a particle is a rattler, which bears nothing. Contacts with rattlers do not count
   * for others, until none is left: `coordination_without_rattlers`. At least 1; 2 by default: particles with one contact bear
   * nothing (C. Thornton, Geotechnique 50, 2000); 4 for spheres without friction.
   */
  vtkGranularSetRangeMacro(RattlerContacts, int, 1, VTK_INT_MAX);
  vtkGetMacro(RattlerContacts, int);
  ///@}

  ///@{
  /**
   * Sets the coefficient of friction, above 0; 1 by default: `mobilised_friction` is the tangential force over the product of
   * the coefficient and the normal force; 1: the contact slides.
   */
  vtkSetMacro(FrictionCoefficient, double);
  vtkGetMacro(FrictionCoefficient, double);
  ///@}

  ///@{
  /**
   * Sets the point array of radii ("radius" by default) [m].
   */
  vtkSetStdStringFromCharMacro(RadiusArray);
  vtkGetCharFromStdStringMacro(RadiusArray);
  ///@}

protected:
  vtkGranularContactSums();
  ~vtkGranularContactSums() override;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularContactSums(const vtkGranularContactSums&) = delete;
  void operator=(const vtkGranularContactSums&) = delete;

  class Task;

  int LeverArm = CONTACT_POINT;
  double MinimumForce = 0;
  double MinimumOverlap = 0;
  int RattlerContacts = 2;
  double FrictionCoefficient = 1;
  std::string RadiusArray = "radius";
  vtkDataArraySelection* const ArraySelection;
};

#endif
