// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_columns_known_columns_h
#define granular_columns_known_columns_h

#include "granular/columns/column.h"

namespace granular
{
// Names of the columns that `dump atom` and `dump custom` of LIGGGHTS (2.3 to 4.0, PFM) and LAMMPS print. Vectors are
// named as in the files of LIGGGHTS' own `dump custom/vtk`. A name with a '*' follows the names that it would also
// match.
inline constexpr KnownColumn known_column_table[] = {
  // clang-format off
  // name              type                role                                array         i  n  unit      meaning
  { "id",              ValueType::Int64,   ColumnRole::Id,                      "",           0, 1, "-",      "number of the particle, unique in the run" },
  { "type",            ValueType::Int32,   ColumnRole::Other,                   "",           0, 1, "-",      "type of the particle, from 1" },
  { "mask",            ValueType::Int32,   ColumnRole::Other,                   "",           0, 1, "-",      "bits of the groups of the particle" },
  { "mol",             ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "-",      "number of the molecule or agglomerate" },
  { "id_multisphere",  ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "-",      "number of the multisphere body" },
  { "proc",            ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "-",      "process that owns the particle" },
  { "procp1",          ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "-",      "process that owns the particle, plus 1" },
  { "thread",          ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "-",      "thread that owns the particle" },
  { "spin",            ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "-",      "electron spin: -1, 0, 1, 2 or 3" },
  { "element",         ValueType::Text,    ColumnRole::Other,                   "",           0, 1, "-",      "name the user gave to the type" },
  { "typelabel",       ValueType::Text,    ColumnRole::Other,                   "",           0, 1, "-",      "label of the type" },
  { "x",               ValueType::Float64, ColumnRole::Position,                "",           0, 1, "m",      "coordinate, in the box" },
  { "y",               ValueType::Float64, ColumnRole::Position,                "",           1, 1, "m",      "coordinate, in the box" },
  { "z",               ValueType::Float64, ColumnRole::Position,                "",           2, 1, "m",      "coordinate, in the box" },
  { "xs",              ValueType::Float64, ColumnRole::ScaledPosition,          "",           0, 1, "-",      "coordinate in units of the box vectors" },
  { "ys",              ValueType::Float64, ColumnRole::ScaledPosition,          "",           1, 1, "-",      "coordinate in units of the box vectors" },
  { "zs",              ValueType::Float64, ColumnRole::ScaledPosition,          "",           2, 1, "-",      "coordinate in units of the box vectors" },
  { "xu",              ValueType::Float64, ColumnRole::UnwrappedPosition,       "",           0, 1, "m",      "coordinate, as if never wrapped" },
  { "yu",              ValueType::Float64, ColumnRole::UnwrappedPosition,       "",           1, 1, "m",      "coordinate, as if never wrapped" },
  { "zu",              ValueType::Float64, ColumnRole::UnwrappedPosition,       "",           2, 1, "m",      "coordinate, as if never wrapped" },
  { "xsu",             ValueType::Float64, ColumnRole::ScaledUnwrappedPosition, "",           0, 1, "-",      "scaled coordinate plus image count" },
  { "ysu",             ValueType::Float64, ColumnRole::ScaledUnwrappedPosition, "",           1, 1, "-",      "scaled coordinate plus image count" },
  { "zsu",             ValueType::Float64, ColumnRole::ScaledUnwrappedPosition, "",           2, 1, "-",      "scaled coordinate plus image count" },
  { "ix",              ValueType::Int32,   ColumnRole::Image,                   "image",      0, 3, "-",      "how often the box was crossed" },
  { "iy",              ValueType::Int32,   ColumnRole::Image,                   "image",      1, 3, "-",      "how often the box was crossed" },
  { "iz",              ValueType::Int32,   ColumnRole::Image,                   "image",      2, 3, "-",      "how often the box was crossed" },
  { "vx",              ValueType::Float64, ColumnRole::Other,                   "v",          0, 3, "m/s",    "velocity" },
  { "vy",              ValueType::Float64, ColumnRole::Other,                   "v",          1, 3, "m/s",    "velocity" },
  { "vz",              ValueType::Float64, ColumnRole::Other,                   "v",          2, 3, "m/s",    "velocity" },
  { "fx",              ValueType::Float64, ColumnRole::Other,                   "f",          0, 3, "N",      "force" },
  { "fy",              ValueType::Float64, ColumnRole::Other,                   "f",          1, 3, "N",      "force" },
  { "fz",              ValueType::Float64, ColumnRole::Other,                   "f",          2, 3, "N",      "force" },
  { "omegax",          ValueType::Float64, ColumnRole::Other,                   "omega",      0, 3, "1/s",    "angular velocity" },
  { "omegay",          ValueType::Float64, ColumnRole::Other,                   "omega",      1, 3, "1/s",    "angular velocity" },
  { "omegaz",          ValueType::Float64, ColumnRole::Other,                   "omega",      2, 3, "1/s",    "angular velocity" },
  { "angmomx",         ValueType::Float64, ColumnRole::Other,                   "angmom",     0, 3, "kg m2/s","angular momentum" },
  { "angmomy",         ValueType::Float64, ColumnRole::Other,                   "angmom",     1, 3, "kg m2/s","angular momentum" },
  { "angmomz",         ValueType::Float64, ColumnRole::Other,                   "angmom",     2, 3, "kg m2/s","angular momentum" },
  { "tqx",             ValueType::Float64, ColumnRole::Other,                   "tq",         0, 3, "N m",    "torque" },
  { "tqy",             ValueType::Float64, ColumnRole::Other,                   "tq",         1, 3, "N m",    "torque" },
  { "tqz",             ValueType::Float64, ColumnRole::Other,                   "tq",         2, 3, "N m",    "torque" },
  { "mux",             ValueType::Float64, ColumnRole::Other,                   "mu",         0, 3, "C m",    "dipole moment" },
  { "muy",             ValueType::Float64, ColumnRole::Other,                   "mu",         1, 3, "C m",    "dipole moment" },
  { "muz",             ValueType::Float64, ColumnRole::Other,                   "mu",         2, 3, "C m",    "dipole moment" },
  { "quat1",           ValueType::Float64, ColumnRole::Other,                   "quat",       0, 4, "-",      "orientation as a quaternion w, x, y, z" },
  { "quat2",           ValueType::Float64, ColumnRole::Other,                   "quat",       1, 4, "-",      "orientation as a quaternion w, x, y, z" },
  { "quat3",           ValueType::Float64, ColumnRole::Other,                   "quat",       2, 4, "-",      "orientation as a quaternion w, x, y, z" },
  { "quat4",           ValueType::Float64, ColumnRole::Other,                   "quat",       3, 4, "-",      "orientation as a quaternion w, x, y, z" },
  { "shapex",          ValueType::Float64, ColumnRole::Other,                   "shape",      0, 3, "m",      "half axes of a superquadric" },
  { "shapey",          ValueType::Float64, ColumnRole::Other,                   "shape",      1, 3, "m",      "half axes of a superquadric" },
  { "shapez",          ValueType::Float64, ColumnRole::Other,                   "shape",      2, 3, "m",      "half axes of a superquadric" },
  { "radius",          ValueType::Float64, ColumnRole::Radius,                  "",           0, 1, "m",      "radius" },
  { "diameter",        ValueType::Float64, ColumnRole::Diameter,                "",           0, 1, "m",      "diameter" },
  { "mass",            ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "kg",     "mass" },
  { "density",         ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "kg/m3",  "density" },
  { "rho",             ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "kg/m3",  "density of smoothed-particle hydrodynamics" },
  { "p",               ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "Pa",     "pressure of smoothed-particle hydrodynamics" },
  { "q",               ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "C",      "charge" },
  { "mu",              ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "C m",    "magnitude of the dipole moment" },
  { "eradius",         ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "m",      "electron radius" },
  { "ervel",           ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "m/s",    "electron radial velocity" },
  { "erforce",         ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "N",      "electron radial force" },
  { "blockiness1",     ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "-",      "exponent of a superquadric" },
  { "blockiness2",     ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "-",      "exponent of a superquadric" },
  { "roundness1",      ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "-",      "exponent of a superquadric, older name" },
  { "roundness2",      ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "-",      "exponent of a superquadric, older name" },
  { "inertiax",        ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "kg m2",  "principal moment of inertia" },
  { "inertiay",        ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "kg m2",  "principal moment of inertia" },
  { "inertiaz",        ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "kg m2",  "principal moment of inertia" },
  { "i_*",             ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "",       "integer property the user added" },
  { "i2_*",            ValueType::Int64,   ColumnRole::Other,                   "",           0, 1, "",       "integer array the user added" },
  { "d_*",             ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "",       "property the user added" },
  { "d2_*",            ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "",       "array the user added" },
  { "c_*",             ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "",       "result of a compute" },
  { "f_*",             ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "",       "result of a fix" },
  { "v_*",             ValueType::Float64, ColumnRole::Other,                   "",           0, 1, "",       "value of a variable" },
  // clang-format on
};
}
#endif
