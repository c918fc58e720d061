// SPDX-License-Identifier: BSD-3-Clause
// What dump atom of LIGGGHTS and LAMMPS writes, by fprintf and fwrite as they do, and by nothing of the core.
#ifndef granular_tests_support_reference_dump_h
#define granular_tests_support_reference_dump_h

#include "granular/geometry/box.h"

#include "quad.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// A box as the header has it: bounds around it, and its tilts.
struct ReferenceBox
{
  double lo[3] = {};
  double hi[3] = {};
  double xy = 0;
  double xz = 0;
  double yz = 0;
  bool tilted = false;
  const char* boundary = "pp pp pp";

  /// The corner, and the matrix of the vectors, which are its columns.
  std::array<Exact, 3> corner() const;
  std::array<std::array<Exact, 3>, 3> matrix() const;

  /// lambda with x = corner + H lambda, by back substitution.
  std::array<Exact, 3> scaled(const std::array<Exact, 3>& point) const;
};

struct ReferenceAtoms
{
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> types;
  std::vector<double> points;
  std::vector<std::int32_t> images; ///< may be empty
};

struct ReferenceForm
{
  bool scaled = true;
  bool image = false;
  bool binary = false;
  bool lammps = false;         ///< else LIGGGHTS
  std::int32_t chunk_rows = 0; ///< of a binary file; 0: all
};

/// The box as the core has it.
granular::Box box_of(const ReferenceBox& box);

std::string reference_dump(const ReferenceBox& box, const ReferenceAtoms& atoms,
  const ReferenceForm& form, std::int64_t timestep);

#endif
