// SPDX-License-Identifier: BSD-3-Clause
// The volume that a sphere and a cube have in common: its error for cubes of 1e-6 to 1e6 radii, against 113 bits and the
// bound that is promised; and what is lost by those who count points in the sphere instead.
#include "bench.h"

#include "../euler/exact_sphere_box.h"
#include "../euler/sphere_box_volume.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using granular::Vector3;

struct Pair
{
  Vector3 centre, lo, hi;
};

/// Unit spheres and cubes of this edge; each cube holds a point of the surface.
std::vector<Pair> make_pairs(double edge, std::size_t count)
{
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  std::vector<Pair> pairs(count);
  for (auto& [centre, lo, hi] : pairs)
  {
    Vector3 surface = { normal(random), normal(random), normal(random) };
    const double length = std::hypot(surface[0], surface[1], surface[2]);
    for (std::size_t k = 0; k < 3; ++k)
    {
      centre[k] = 2 * unit(random) - 1;
      lo[k] = centre[k] + surface[k] / length - edge * unit(random);
      hi[k] = lo[k] + edge;
    }
  }
  return pairs;
}

/// Of the smaller one of sphere and cube.
double smaller(double edge)
{
  return std::min(granular::sphere_volume(1), edge * edge * edge);
}

void errors(benchmark::State& state, double edge, std::size_t count)
{
  double largest = 0;
  double squares = 0;
  double bound = 0;
  for (auto _ : state)
  {
    const double start = now();
    for (const auto& [centre, lo, hi] : make_pairs(edge, count))
    {
      const ExactVolume exact = exact_sphere_box(centre, 1, lo, hi);
      const Quad found = sphere_box_volume(centre, 1, lo, hi);
      const Quad wrong = absolute(found - exact.value);
      if (wrong > exact.tolerance)
      {
        fail(state, "a volume is not what is promised");
        return;
      }
      const double error = static_cast<double>(wrong) / smaller(edge);
      largest = std::max(largest, error);
      squares += error * error;
      bound = std::max(bound, static_cast<double>(exact.tolerance) / smaller(edge));
    }
    state.SetIterationTime(now() - start);
  }
  tell(state, "error, largest", largest, "of the smaller");
  tell(state, "error, rms", std::sqrt(squares / static_cast<double>(count)), "of the smaller");
  tell(state, "promised", bound, "of the smaller");
}

/// Counts which of per_axis^3 points of a sphere lie in the cube: the points in the sphere of a regular grid around it.
class CountedPoints
{
public:
  explicit CountedPoints(int per_axis)
  {
    const auto place = [per_axis](int i) { return (2 * i + 1.0) / per_axis - 1; };
    for (int i = 0; i < per_axis; ++i)
    {
      for (int j = 0; j < per_axis; ++j)
      {
        for (int k = 0; k < per_axis; ++k)
        {
          const Vector3 x = { place(i), place(j), place(k) };
          if (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] <= 1)
          {
            points_.push_back(x);
          }
        }
      }
    }
  }

  double volume(const Pair& pair) const
  {
    const auto is_inside = [&pair](const Vector3& x)
    {
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double there = pair.centre[k] + x[k];
        inside = inside && there >= pair.lo[k] && there < pair.hi[k];
      }
      return inside;
    };
    const auto count = static_cast<double>(std::ranges::count_if(points_, is_inside));
    return granular::sphere_volume(1) * count / static_cast<double>(points_.size());
  }

  std::string name() const { return std::to_string(points_.size()) + " points"; }

private:
  std::vector<Vector3> points_;
};

void against_points(benchmark::State& state, double edge, std::size_t count)
{
  const std::vector<Pair> pairs = make_pairs(edge, count);
  std::vector<double> exact;
  for (const auto& [centre, lo, hi] : pairs)
  {
    exact.push_back(static_cast<double>(exact_sphere_box(centre, 1, lo, hi).value));
  }
  struct Way
  {
    std::string name;
    std::function<double(const Pair& pair)> volume;
    double largest = 0;
    double squares = 0;
  };
  std::vector<Way> ways;
  ways.push_back({ "exact",
    [](const Pair& pair) { return sphere_box_volume(pair.centre, 1, pair.lo, pair.hi); } });
  for (const int per_axis : { 3, 6, 12, 24 })
  {
    CountedPoints counted(per_axis);
    ways.push_back(
      { counted.name(), [counted](const Pair& pair) { return counted.volume(pair); } });
  }
  Rounds rounds;
  for (Way& way : ways)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const double error = std::abs(way.volume(pairs[i]) - exact[i]) / smaller(edge);
      way.largest = std::max(way.largest, error);
      way.squares += error * error;
    }
    rounds.add(way.name,
      [&way, &pairs]
      {
        double sum = 0;
        for (const Pair& pair : pairs)
        {
          sum += way.volume(pair);
        }
        benchmark::DoNotOptimize(sum);
        return true;
      });
  }
  if (!rounds.run_all(state, "", static_cast<double>(count)))
  {
    return;
  }
  for (const Way& way : ways)
  {
    tell(state, way.name, 1e9 * median(rounds.of(way.name)), "ns/volume");
    tell(state, way.name + ", error, largest", way.largest, "of the smaller");
    tell(state, way.name + ", error, rms", std::sqrt(way.squares / static_cast<double>(count)),
      "of the smaller");
  }
}
}

void add_benchmarks(const Size& size)
{
  const auto count = static_cast<std::size_t>(size.pick(2000, 50));
  for (int power = -6; power <= 6; ++power)
  {
    add("volumes/h/r = 1e" + std::to_string(power), 1,
      [=](benchmark::State& state) { errors(state, std::pow(10, power), count); });
  }
  add("volumes/one volume, h/r = 1", size.pick(7, 1),
    [=](benchmark::State& state) { against_points(state, 1, count); });
}
}
