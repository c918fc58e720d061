// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_cells_h
#define granular_grid_cells_h

#include "granular/frames/frame.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Cells with averages of the particles in them: structure of arrays, with the same number of cells in each. Empty cells are
/// 0 except for the centre.
struct EulerCells
{
  std::vector<double> centres;         ///< x y z of each cell [m]
  std::vector<double> velocities;      ///< u v w, weighted by mass [m/s]
  std::vector<double> volume_fraction; ///< of solids, 0 and more; overlaps count twice [-]
  std::vector<double> radius;          ///< mean over particles [m]
  std::vector<double> pressure;        ///< positive in compression [Pa]
  std::vector<double> normal_stress;   ///< xx yy zz, or empty: not known [Pa]
  std::vector<double> shear_stress;    ///< xy xz yz, or empty: not known [Pa]

  /// Returns the number of cells.
  std::int64_t count() const noexcept { return static_cast<std::int64_t>(volume_fraction.size()); }

  /// Makes all arrays, but for stresses, that long; new values are 0.
  void resize(std::int64_t cells);

  bool operator==(const EulerCells&) const = default;
};

/// Fields of cells beside EulerCells: structure of arrays, empty where nobody asked for it.
struct EulerFields
{
  std::vector<double> density;  ///< mass of particles over the volume of the cell [kg/m3]
  std::vector<double> momentum; ///< three, over the volume of the cell [kg/(m2 s)]
  std::vector<double>
    temperature; ///< mean square of velocity fluctuations along an axis, weighted by mass [m2/s2]
  std::vector<double> coordination; ///< ends of contacts over particles [-]
  std::vector<double> fabric;       ///< six, xx yy zz xy xz yz: mean product of contact normals [-]
  std::vector<double> kinetic_normal; ///< xx yy zz of velocity fluctuations [Pa]
  std::vector<double> kinetic_shear;  ///< xy xz yz [Pa]
  std::vector<double> contact_normal; ///< xx yy zz of contacts [Pa]
  std::vector<double> contact_shear;  ///< xy xz yz [Pa]

  bool operator==(const EulerFields&) const = default;
};

/// A field as outputs name it.
struct EulerField
{
  std::string_view name;
  int components;
  std::vector<double> EulerFields::*values;
};

inline constexpr EulerField euler_fields[] = {
  { "density", 1, &EulerFields::density },
  { "momentum", 3, &EulerFields::momentum },
  { "granular_temperature", 1, &EulerFields::temperature },
  { "coordination", 1, &EulerFields::coordination },
  { "fabric", 6, &EulerFields::fabric },
  { "sigma_kinetic", 3, &EulerFields::kinetic_normal },
  { "tau_kinetic", 3, &EulerFields::kinetic_shear },
  { "sigma_contact", 3, &EulerFields::contact_normal },
  { "tau_contact", 3, &EulerFields::contact_shear },
};

/// Which fields are made.
struct EulerFieldSet
{
  bool density = false;
  bool momentum = false;
  bool temperature = false;
  bool coordination = false; ///< needs contacts, as all below
  bool fabric = false;
};

/// An array of cells as files and outputs name it.
struct EulerArray
{
  std::string_view name;
  int components;
  std::vector<double> EulerCells::*values;
  bool optional; ///< may be empty
};

/// v_avg, volumefraction, radius, pressure as dump euler/vtk of LIGGGHTS writes them, in this order; then sigma (xx yy zz)
/// and tau (xy xz yz) of its fork PFM.
std::span<const EulerArray> euler_arrays() noexcept;

/// Values of cells under their names in the file: v_avg, volumefraction, ... (see euler_arrays), or others.
struct EulerValues
{
  std::string name;
  int components = 1;
  std::vector<double> values; ///< components for each cell
};

/// Cells of a frame as in the file. Numbers are the nearest doubles to the text, for any type that the file names; nan and infinities
/// are accepted.
struct EulerFrame
{
  std::int64_t cells = 0;
  std::vector<double> centres; ///< x y z of each; the middle of cells with faces
  std::vector<EulerValues> arrays;

  /// The faces of a rectilinear grid along each axis, as in the file; otherwise empty.
  std::vector<double> faces[3];

  std::optional<FrameHeader> header; ///< where the file has one, with the box and the units
};

/// The components of an array of a tensor, as outputs name them.
struct TensorArray
{
  std::string_view name;
  std::string_view components; ///< separated by blanks
};

inline constexpr TensorArray tensor_arrays[] = {
  { "sigma", "XX YY ZZ" },
  { "tau", "XY XZ YZ" },
  { "sigma_kinetic", "XX YY ZZ" },
  { "tau_kinetic", "XY XZ YZ" },
  { "sigma_contact", "XX YY ZZ" },
  { "tau_contact", "XY XZ YZ" },
  { "fabric", "XX YY ZZ XY XZ YZ" },
};

/// Returns cells with the names in files: v_avg, volumefraction, ..., and with more fields.
EulerFrame make_euler_frame(EulerCells&& cells, EulerFields&& fields);

/// The cells of all processes, with stresses where all processes that have cells have them, on rank 0; none on
/// others. Collective.
EulerCells gather_cells(const EulerCells& own, Communicator& ranks);
}
#endif
