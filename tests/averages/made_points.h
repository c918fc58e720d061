// SPDX-License-Identifier: BSD-3-Clause
// Averages of made particles and contacts at points.
#ifndef granular_tests_euler_made_points_h
#define granular_tests_euler_made_points_h

#include "made_touches.h"

#include "granular/averages/average.h"

#include <cstddef>
#include <random>
#include <vector>

inline granular::EulerAverages average_points_of(const Scene& scene,
  const std::vector<double>& points, const granular::Box* box,
  const granular::PointAverageRequest& request, granular::Communicator& ranks, int threads = 1)
{
  const SceneFrame frame(scene, box);
  const granular::Executor executor(threads);
  granular::Progress progress;
  granular::PartialProgress part(progress);
  granular::Notices notices;
  granular::ContactOptions options;
  options.arm = granular::LeverArm::Half;
  const granular::FoundEnds ends(frame.view(), frame.rows(), "", options, ranks, executor, part);
  return granular::average_at_points(
    frame.view(), points, &ends, request, ranks, executor, notices, progress);
}

inline granular::EulerAverages average_points_of(const Scene& scene,
  const std::vector<double>& points, const granular::Box* box,
  const granular::PointAverageRequest& request, int threads = 1)
{
  granular::SerialCommunicator alone;
  return average_points_of(scene, points, box, request, alone, threads);
}

/// A request of everything.
inline granular::PointAverageRequest request_at_points(granular::KernelShape shape, double width)
{
  granular::PointAverageRequest request;
  request.kernel = granular::Kernel(shape, width);
  request.tensors = true;
  request.fields = { true, true, true, true, true };
  return request;
}

/// All over a box, and beyond it.
inline std::vector<double> random_points(std::size_t count, const granular::Vector3& lo,
  const granular::Vector3& hi, unsigned seed, double beyond = 0)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> points;
  for (std::size_t i = 0; i < 3 * count; ++i)
  {
    const double edge = hi[i % 3] - lo[i % 3];
    points.push_back(lo[i % 3] + edge * ((1 + 2 * beyond) * unit(random) - beyond));
  }
  return points;
}
#endif
