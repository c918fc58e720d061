// SPDX-License-Identifier: BSD-3-Clause
// Smoothing kernels with 113 bits, from their definitions, and means over lines by quadrature.
#ifndef granular_tests_kernels_exact_kernel_h
#define granular_tests_kernels_exact_kernel_h

#include "granular/averages/smooth_cells.h"
#include "granular/geometry/box.h"

#include "../support/quad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using QuadVector = std::array<Quad, 3>;

inline Quad root_of(Quad square)
{
  if (!(square > 0))
  {
    return 0;
  }
  Quad root = static_cast<Quad>(std::sqrt(static_cast<long double>(square)));
  for (int i = 0; i < 2; ++i)
  {
    root = (root + square / root) / 2;
  }
  return root;
}

/// For x of a few at most.
inline Quad exponential(Quad x)
{
  constexpr int halvings = 10;
  const Quad small = x / (1 << halvings);
  Quad sum = 1;
  Quad term = 1;
  for (int n = 1; n < 20; ++n)
  {
    term *= small / n;
    sum += term;
  }
  for (int n = 0; n < halvings; ++n)
  {
    sum *= sum;
  }
  return sum;
}

inline int widths_of_support(granular::KernelShape shape)
{
  using granular::KernelShape;
  return shape == KernelShape::Gaussian ? 3 : shape == KernelShape::Lucy ? 2 : 1;
}

/// At the distance whose square is given.
inline Quad exact_value(granular::KernelShape shape, Quad width, Quad square)
{
  const int widths = widths_of_support(shape);
  if (!(square < widths * widths * width * width))
  {
    return 0;
  }
  if (shape == granular::KernelShape::Gaussian)
  {
    return exponential(-square / (2 * width * width));
  }
  const Quad q = root_of(square) / (2 * width);
  return shape == granular::KernelShape::Lucy ? (1 + 3 * q) * (1 - q) * (1 - q) * (1 - q) : 1;
}

inline QuadVector to_quad(const granular::Vector3& vector)
{
  return { vector[0], vector[1], vector[2] };
}

inline Quad product_of(const QuadVector& a, const QuadVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Places and weights of Gauss and Legendre in [-1, 1].
struct Quadrature
{
  static constexpr std::size_t size = 24;

  Quadrature()
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      Quad x = std::cos(3.14159265358979324 * (static_cast<double>(i) + 0.75) / (size + 0.5));
      Quad slope = 1;
      for (int step = 0; step < 8; ++step)
      {
        Quad before = 1; // polynomials of Legendre by their recurrence
        Quad value = x;
        for (int n = 2; n <= static_cast<int>(size); ++n)
        {
          const Quad next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
          before = value;
          value = next;
        }
        slope = static_cast<int>(size) * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      places[i] = x;
      weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }

  std::array<Quad, size> places;
  std::array<Quad, size> weights;
};

/// The mean over the line from -point, seen from the centre of the kernel, along the branch.
inline Quad exact_line_mean(
  granular::KernelShape shape, double width, const QuadVector& point, const QuadVector& branch)
{
  static const Quadrature gauss;
  const Quad w = width;
  const Quad square = product_of(branch, branch);
  if (square == 0)
  {
    return exact_value(shape, w, product_of(point, point));
  }
  const Quad foot = product_of(point, branch) / square;
  const Quad reach = w * widths_of_support(shape);
  const Quad height2 = product_of(point, point) - foot * foot * square;
  const Quad half = root_of((reach * reach - height2) / square);
  // at the foot the kernel of Lucy may have a kink
  std::vector<Quad> ends = { foot - half, foot, foot + half };
  for (Quad& end : ends)
  {
    end = std::clamp<Quad>(end, 0, 1);
  }
  Quad sum = 0;
  for (std::size_t side = 0; side < 2; ++side)
  {
    const Quad length = (ends[side + 1] - ends[side]) * root_of(square);
    const int panels = 1 + static_cast<int>(length / w * 2);
    const Quad panel = (ends[side + 1] - ends[side]) / panels;
    for (int n = 0; n < panels && panel > 0; ++n)
    {
      for (std::size_t i = 0; i < Quadrature::size; ++i)
      {
        const Quad s = ends[side] + panel * (n + (1 + gauss.places[i]) / 2) - foot;
        const Quad r2 = std::max<Quad>(height2, 0) + s * s * square;
        sum += gauss.weights[i] / 2 * panel *
          exact_value(shape, w, std::min(r2, reach * reach * (1 - static_cast<Quad>(0x1p-100))));
      }
    }
  }
  return sum;
}
#endif
