// SPDX-License-Identifier: BSD-3-Clause
#include "bits.h"

#include "../averages/made_particles.h"

#include "granular/averages/time_average.h"
#include "granular/geometry/positions.h"
#include "granular/grid/process_grid.h"
#include "granular/packing/packing.h"
#include "granular/packing/packing_plan.h"

#include <cstdint>
#include <random>
#include <sstream>
#include <vector>

using namespace granular;

namespace
{
class BitLines
{
public:
  void add(const std::string& name, const void* data, std::size_t bytes)
  {
    std::uint64_t hash = 0xcbf29ce484222325; // FNV-1a
    for (std::size_t i = 0; i < bytes; ++i)
    {
      hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3;
    }
    text_ << name << " " << std::hex << hash << "\n";
  }

  void add(const std::string& name, const std::vector<double>& values)
  {
    this->add(name, values.data(), values.size() * sizeof(double));
  }

  void add(const std::string& name, const EulerCells& cells)
  {
    for (const EulerArray& array : euler_arrays())
    {
      this->add(name + " " + std::string(array.name), cells.*array.values);
    }
  }

  std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
};

/// Numbers in [lo, lo + length), both of few bits, so that making them rounds nothing.
class Numbers
{
public:
  double operator()(double lo, double length)
  {
    return lo + length * (static_cast<double>(random_() >> 34) * 0x1p-30);
  }

private:
  std::mt19937_64 random_{ 17 };
};

std::vector<Particle> some_particles(Numbers& numbers)
{
  std::vector<Particle> particles(400);
  for (Particle& particle : particles)
  {
    particle.x = { numbers(-1.5, 3), numbers(-1, 5), numbers(2, 1) };
    particle.v = { numbers(-1, 2), numbers(0, 2), numbers(8, 1) };
    particle.radius = numbers(0.03125, 0.25);
    particle.mass = numbers(0, 1);
    for (double& value : particle.stress)
    {
      value = numbers(-1, 2);
    }
  }
  return particles;
}

void add_averages(BitLines& lines)
{
  Numbers numbers;
  const Box box = periodic_box({ -1, 0, 2 }, { 1, 3, 3 }, "pp pp ff");
  for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
  {
    for (const std::int64_t count : { 3, 10, 40 })
    {
      EulerAverageRequest request =
        request_for({ { -1, 0, 2 }, { 1, 3, 3 }, { count, count + 1, count / 2 } }, weights);
      request.arrays.stress = "c_stress";
      request.keep_sums = true;
      TimeAverage time;
      for (int frame = 0; frame < 2; ++frame)
      {
        const EulerAverages averages =
          average(Grains(some_particles(numbers)).frame(&box), request);
        lines.add("average in " + std::to_string(count) + " cells", averages.cells);
        time.add(averages);
      }
      lines.add("average over time", time.cells());
    }
  }
}

void add_packings(BitLines& lines)
{
  const Box tilted = Box::from_tilted_bounds({ 0, 0, 0 }, { 13, 12, 11 }, 0.7, -1.3, 1.1);
  for (const bool is_tilted : { false, true })
  {
    for (const Arrangement arrangement : { Arrangement::Random, Arrangement::SimpleCubic,
           Arrangement::FaceCentredCubic, Arrangement::Chain })
    {
      PackingRequest request;
      request.arrangement = arrangement;
      request.particles = arrangement == Arrangement::Chain ? 9 : 300;
      request.speed = 0.3;
      request.radii.first = 0.4375;
      request.spacing = arrangement == Arrangement::Random ? 1 : 1.1;
      if (is_tilted)
      {
        request.box = tilted;
        request.boundary = "pp pp pp";
        request.particles = arrangement == Arrangement::Chain ? 9 : 0;
      }
      Progress progress;
      const PackingPlan plan(request, progress);
      const Table frame = make_packing(plan, progress);
      const std::string name = std::string(is_tilted ? "tilted packing " : "packing ") +
        std::to_string(static_cast<int>(arrangement));
      lines.add(name, frame.points.data(), frame.points.bytes());
      for (const TableArray& array : frame.arrays)
      {
        lines.add(name + " " + array.info.name, array.block.data(), array.block.bytes());
      }
      const GrainBonds bonds = make_bonds(plan, 1.3, progress);
      lines.add(name + " lengths of bonds", bonds.equilibrium_length.data(),
        bonds.equilibrium_length.bytes());
      lines.add(name + " bonds", bonds.points.data(), bonds.points.bytes());
    }
  }
}

void add_positions(BitLines& lines)
{
  Numbers numbers;
  const std::vector<Box> boxes = { Box::from_bounds({ -1e6, 0, 2 }, { -1e6 + 0.1, 3, 2.7 }),
    Box::from_tilted_bounds({ 0, 0, 0 }, { 3, 3, 3 }, 0.7, -0.3, 0.1),
    Box::from_vectors(
      { 1e3, 2, 3 }, { Vector3{ 1.1, 0.2, -0.3 }, { 0.4, 1.7, 0.1 }, { -0.2, 0.3, 1.3 } }) };
  for (const Box& box : boxes)
  {
    for (const char* columns : { "x y z ix iy iz", "xs ys zs ix iy iz", "xu yu zu ix iy iz" })
    {
      for (const Coordinates wanted :
        { Coordinates::Absolute, Coordinates::Unwrapped, Coordinates::Scaled })
      {
        std::vector<std::string> names;
        std::istringstream words(columns);
        for (std::string word; words >> word;)
        {
          names.push_back(word);
        }
        Notices notices;
        const PositionPlan plan = plan_positions(ColumnSchema(names), box, wanted, {}, notices);
        std::vector<double> points(3 * 500);
        std::vector<double> images(points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          points[i] = numbers(-0.5, 2);
          images[i] = std::floor(numbers(-100, 200));
        }
        convert_positions(plan, box, { 0.1, 0.2, 0.3 },
          plan.images[0] >= 0 ? std::span<const double>(images) : std::span<const double>(),
          points);
        lines.add(std::string(columns) + " as " + to_string(wanted), points);
      }
    }
  }
}

void add_process_grids(BitLines& lines)
{
  for (int n = 1; n < 200; ++n)
  {
    GridRequest request;
    request.lo = { 0.1, -1e3, 0.3 };
    request.hi = { 1.7, 1e3 / 3, 2.9 };
    request.grid = { n, 7 * n % 31 + 1, 2 };
    for (const std::vector<double>& cuts : make_process_grid(request).cuts)
    {
      lines.add("cuts of " + std::to_string(n), cuts);
    }
  }
}
}

std::string result_bits()
{
  BitLines lines;
  add_averages(lines);
  add_packings(lines);
  add_positions(lines);
  add_process_grids(lines);
  return lines.text();
}
