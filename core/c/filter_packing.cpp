// SPDX-License-Identifier: BSD-3-Clause
// GranularPackingSource.
#include "filter.h"

#include "granular/packing/packing.h"

namespace granular_c
{
using namespace granular;

Frames apply_packing(FilterTask& task)
{
  Settings& settings = task.settings;
  PackingRequest request;
  request.arrangement = arrangement_of(settings.integer("Arrangement", 0));
  request.corner = settings.numbers<3>("BoxOrigin", {});
  request.box = find_box(
    request.corner, settings.numbers<3>("BoxLengths", {}), settings.numbers<3>("BoxTilts", {}));
  request.particles = settings.integer("NumberOfGrains", 0);
  if (request.particles == 0 && !request.box)
  {
    request.particles = particles_without_box;
  }
  request.boundary = settings.text("Boundary", "ff ff ff");
  request.radii.kind = radii_of(settings.integer("Radii", 1));
  request.radii.first = settings.number("Radius", 0.003);
  request.radii.second = settings.number("SecondRadius", 0.005);
  request.radii.share = settings.number("SecondShare", 0.3);
  request.solid_fraction = settings.number("SolidFraction", 0.2);
  request.spacing = settings.number("Spacing", 1);
  request.speed = settings.number("Speed", 0);
  request.seed = static_cast<std::uint64_t>(settings.integer("Seed", 1));
  const double bond_factor = settings.number("BondFactor", 0);
  request.piece = task.piece;
  request.pieces = task.pieces;
  request.ranges = true;
  request.threads = task.threads;
  Tables made = make_packing(request, bond_factor, task.progress);
  Frames frames;
  frames.push_back(make_frame(RowKind::Particles, std::move(made.rows)));
  if (made.bonds.has_lines)
  {
    frames.push_back(make_frame(RowKind::Lines, std::move(made.bonds)));
  }
  return frames;
}
}
