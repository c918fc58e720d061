// SPDX-License-Identifier: BSD-3-Clause
// What the tests of packings share: a look at what was made, by other means than those that made it.
#ifndef granular_tests_support_packings_h
#define granular_tests_support_packings_h

#include "granular/packing/packing.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// What was made, and whether it is what was promised.
struct Grains
{
  explicit Grains(const granular::PackingRequest& request);

  /// In units of the box vectors.
  granular::Vector3 scaled(std::size_t particle) const;

  /// The least distance of two surfaces, in units of the sum of the radii, periodic images and a particle's
  /// own among them; below 0 where two overlap.
  double least_gap() const;

  /// The least distance of a surface to a face that is not periodic, in radii; of a centre to a periodic
  /// one, in heights. Below 0: something is outside.
  double least_inside() const;

  /// Volume of all particles by that of the box.
  double solid_fraction() const;

  /// All values, byte by byte.
  std::string bytes() const;

  std::size_t size() const { return static_cast<std::size_t>(frame.rows); }

  granular::Table frame;
  std::vector<granular::Vector3> points;
  std::vector<double> radius;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> type;
  std::vector<granular::Vector3> v;

  granular::Vector3 origin;
  std::array<granular::Vector3, 3> vectors;
  granular::Vector3 heights;
  double volume;
};

/// From a corner, lengths and tilts xy xz yz.
granular::Box tilted_box(const granular::Vector3& origin, const granular::Vector3& lengths,
  const granular::Vector3& tilts = {});

granular::RadiusChoice one_radius(double radius);
granular::RadiusChoice two_radii(double first, double second, double share);

/// The text of the error that a request ends with, or "".
std::string error_of(const granular::PackingRequest& request);
#endif
