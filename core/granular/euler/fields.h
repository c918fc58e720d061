// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_fields_h
#define granular_euler_fields_h

#include <span>
#include <string_view>
#include <vector>

namespace granular
{
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
}
#endif
