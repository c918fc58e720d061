// SPDX-License-Identifier: BSD-3-Clause
// Contacts of made particles, and their averages in cells.
#ifndef granular_tests_euler_made_touches_h
#define granular_tests_euler_made_touches_h

#include "made_particles.h"

#include "granular/averages/average.h"
#include "granular/contacts/find_ends.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

/// The contact of the particles id1 and id2, which are numbered from 1, or of id2 with a wall.
struct Touch
{
  std::int64_t id1 = 0;
  std::int64_t id2 = 0;
  granular::Vector3 from = {};
  granular::Vector3 to = {};
  granular::Vector3 force = {}; ///< on id1, of a wall on id2
};

inline granular::Vector3 branch_of(const Touch& touch)
{
  return { touch.to[0] - touch.from[0], touch.to[1] - touch.from[1], touch.to[2] - touch.from[2] };
}

/// Arrays of contacts as readers have them.
class Touches
{
public:
  explicit Touches(const std::vector<Touch>& touches, bool walls = false, bool forces = true)
  {
    for (const Touch& touch : touches)
    {
      if (!walls)
      {
        id1_.push_back(touch.id1);
      }
      id2_.push_back(touch.id2);
      ends_.insert(ends_.end(), touch.from.begin(), touch.from.end());
      ends_.insert(ends_.end(), touch.to.begin(), touch.to.end());
      force_.insert(
        force_.end(), touch.force.begin(), forces ? touch.force.end() : touch.force.begin());
    }
  }

  granular::ContactRows view() const
  {
    granular::ContactRows rows;
    rows.count = id2_.size();
    rows.id1 = id1_;
    rows.id2 = id2_;
    rows.ends = ends_;
    rows.force = force_;
    return rows;
  }

private:
  std::vector<std::int64_t> id1_, id2_;
  std::vector<double> ends_, force_;
};

/// A part of a scene: what one rank has of it.
struct Scene
{
  std::vector<Particle> particles;
  std::vector<std::int64_t> ids; ///< of the particles
  std::vector<Touch> pairs;
  std::vector<Touch> walls;
  bool forces = true;
};

/// A frame, and the contacts of it.
class SceneFrame
{
public:
  SceneFrame(const Scene& scene, const granular::Box* box)
    : particles_(scene.particles)
    , ids_(scene.ids)
    , pairs_(scene.pairs, false, scene.forces)
    , walls_(scene.walls, true, scene.forces)
    , rows_({ pairs_.view(), walls_.view() })
    , frame_(scene.particles.empty() ? granular::FrameView() : particles_.frame(box))
  {
    frame_.has_box = box != nullptr;
    frame_.header.box = box ? *box : granular::Box();
    if (!scene.particles.empty())
    {
      frame_.arrays.push_back(granular::view_rows("id", granular::ValueType::Int64, ids_.data()));
    }
  }
  SceneFrame(const SceneFrame&) = delete;
  SceneFrame& operator=(const SceneFrame&) = delete;

  const granular::FrameView& view() const { return frame_; }
  std::span<const granular::ContactRows> rows() const { return rows_; }

private:
  Grains particles_;
  std::vector<std::int64_t> ids_;
  Touches pairs_, walls_;
  std::array<granular::ContactRows, 2> rows_;
  granular::FrameView frame_;
};

/// How many contacts were found wanting.
struct Counted
{
  std::int64_t missing = 0;
  std::int64_t broken = 0;
};

inline granular::EulerAverages average_contacts_of(const Scene& scene, const granular::Box* box,
  const granular::EulerAverageRequest& request, granular::Communicator& ranks, int threads = 1,
  Counted* counted = nullptr, granular::ContactOptions options = {})
{
  const SceneFrame frame(scene, box);
  const granular::Executor executor(threads);
  granular::Progress progress;
  granular::PartialProgress part(progress);
  granular::Notices notices;
  granular::EulerAverages averages =
    granular::average_in_cells(frame.view(), request, ranks, executor, notices, progress);
  options.arm = granular::LeverArm::Half;
  const granular::FoundEnds ends(frame.view(), frame.rows(), "", options, ranks, executor, part);
  granular::average_contacts(ends, box, request, ranks, executor, progress, averages);
  if (counted)
  {
    *counted = { ends.missing(), ends.broken() };
  }
  return averages;
}

inline granular::EulerAverages average_contacts_of(const Scene& scene, const granular::Box* box,
  const granular::EulerAverageRequest& request, int threads = 1, Counted* counted = nullptr,
  const granular::ContactOptions& options = {})
{
  granular::SerialCommunicator alone;
  return average_contacts_of(scene, box, request, alone, threads, counted, options);
}

/// A request of all that contacts have.
inline granular::EulerAverageRequest request_of_contacts(const granular::EulerGrid& grid,
  granular::CellWeights weights, granular::KernelShape shape = granular::KernelShape::Gaussian,
  double width = 0.3, granular::KernelBounds bounds = granular::KernelBounds::None)
{
  granular::EulerAverageRequest request = request_for(grid, weights);
  request.cells.kernel = shape;
  request.cells.width = width;
  request.cells.bounds = bounds;
  request.tensors = true;
  request.keep_sums = true;
  request.fields = { true, true, true, true, true };
  return request;
}

/// Grains all over a box, and contacts between any two that are near each other, or so it is said.
inline Scene random_scene(std::size_t particles, std::size_t pairs, std::size_t walls,
  const granular::Vector3& lo, const granular::Vector3& hi, unsigned seed, double length = 0.5)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Scene scene;
  scene.particles = random_particles(particles, lo, hi, 0.2, seed + 1);
  scene.ids.resize(particles);
  std::iota(scene.ids.begin(), scene.ids.end(), std::int64_t{ 1 });
  for (std::size_t i = 0; i < pairs + walls; ++i)
  {
    Touch touch;
    touch.id1 = 1 + static_cast<std::int64_t>(random() % particles);
    touch.id2 = 1 + static_cast<std::int64_t>(random() % particles);
    for (std::size_t k = 0; k < 3; ++k)
    {
      touch.from[k] = lo[k] + (hi[k] - lo[k]) * unit(random);
      touch.to[k] =
        std::min(std::max(touch.from[k] + length * (2 * unit(random) - 1), lo[k]), hi[k]);
      touch.force[k] = std::pow(10, 3 * unit(random)) * (unit(random) - 0.5);
    }
    (i < pairs ? scene.pairs : scene.walls).push_back(touch);
  }
  return scene;
}

/// The scene with small particles at the ends of its lines, which a periodic box does not leave as they are drawn.
inline Scene with_ends(Scene scene)
{
  const auto particle_at = [&](const granular::Vector3& end)
  {
    scene.particles.push_back({ end, {}, 1e-3, 1e-3 });
    return scene.ids.emplace_back(static_cast<std::int64_t>(scene.particles.size()));
  };
  for (std::vector<Touch>* const touches : { &scene.pairs, &scene.walls })
  {
    for (Touch& touch : *touches)
    {
      touch.id1 = particle_at(touch.from);
      touch.id2 = particle_at(touch.to);
    }
  }
  return scene;
}
#endif
