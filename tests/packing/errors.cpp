// SPDX-License-Identifier: BSD-3-Clause
// What cannot be is refused, in words that say what can.
#include "../support/packings.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Wrong
{
  std::function<void(PackingRequest&)> make;
  const char* text;
};

const Wrong wrongs[] = {
  { [](PackingRequest& r) { r.radii = one_radius(0); },
    "expected a finite radius greater than 0, got 0.000000" },
  { [](PackingRequest& r) { r.radii = one_radius(-0.5); },
    "expected a finite radius greater than 0, got -0.500000" },
  { [](PackingRequest& r) { r.radii = one_radius(nan); },
    "expected a finite radius greater than 0, got nan" },
  { [](PackingRequest& r) { r.radii = two_radii(0.5, infinity, 0.5); },
    "expected a finite radius greater than 0, got inf" },
  { [](PackingRequest& r) { r.radii = two_radii(0.5, 0.4, 1.5); },
    "expected a share of the second radius from 0 to 1, got 1.500000" },
  { [](PackingRequest& r) { r.radii = two_radii(0.01, 0.4, 0.5); },
    "expected radii of which the largest is at most 20 times the smallest, got 40.000000 times" },
  { [](PackingRequest& r) { r.particles = -1; },
    "expected a number of grains from 0 to 10^12, got -1.000000" },
  { [](PackingRequest& r) { r.particles = 0; },
    "expected a number of grains or a box, got neither" },
  { [](PackingRequest& r) { r.solid_fraction = 0; },
    "expected a solid fraction greater than 0 and at most 0.74, got 0.000000" },
  { [](PackingRequest& r) { r.solid_fraction = nan; },
    "expected a solid fraction greater than 0 and at most 0.74, got nan" },
  { [](PackingRequest& r) { r.spacing = 0.9; },
    "expected a finite spacing of at least 1, got 0.900000" },
  { [](PackingRequest& r) { r.speed = -1; },
    "expected a finite speed of at least 0, got -1.000000" },
  { [](PackingRequest& r) { r.piece = 2; }, "expected a piece from 0 to 0, got 2.000000" },
  { [](PackingRequest& r) { r.boundary = "p p"; },
    "expected a boundary such as 'pp pp ff', of the letters p, f, s and m and p never with "
    "another, "
    "got 'p p'" },
  { [](PackingRequest& r) { r.boundary = "pf p p"; },
    "expected a boundary such as 'pp pp ff', of the letters p, f, s and m and p never with "
    "another, "
    "got 'pf p p'" },
  { [](PackingRequest& r) {
     r.box = tilted_box({}, { 10, 0, 10 });
   },
    "expected a box of three finite lengths greater than 0, got one that is flat or not finite" },
  { [](PackingRequest& r) {
     r.box = tilted_box({}, { 10, nan, 10 });
   },
    "expected a box of three finite lengths greater than 0, got one that is flat or not finite" },
  { [](PackingRequest& r) {
     r.box = tilted_box({ infinity, 0, 0 }, { 10, 10, 10 });
   },
    "expected a box of three finite lengths greater than 0, got one that is flat or not finite" },
  { [](PackingRequest& r) {
     r.box = tilted_box({}, { 10, 0.9, 10 });
   },
    "expected a box of at least the largest diameter, 1.000000, between any two opposite faces, "
    "got "
    "0.900000" },
  { [](PackingRequest& r) {
     r.box = tilted_box({ 1e15, 0, 0 }, { 10, 10, 10 });
   },
    "expected grains that coordinates of 1000000000000010.000000 can place, got a radius of "
    "0.500000" },
  { [](PackingRequest& r) {
     r.box = tilted_box({}, { 4, 4, 4 });
   },
    "expected a solid fraction of at most 0.74, got 0.818123" },
  { [](PackingRequest& r) {
     r.box = tilted_box({}, { 5, 5, 5 });
   },
    "no place was found for a random grain of radius 0.500000 when" },
  { [](PackingRequest& r)
    {
      r.particles = 5000;
      r.boundary = "p p p";
      r.solid_fraction = 0.45;
    },
    "no place was found for a random grain of radius 0.500000 when" },
  { [](PackingRequest& r) { r.particles = 10'000'001; },
    "expected at most 10^7 random grains, got 10000001.000000: a lattice, SimpleCubic or "
    "FaceCentredCubic, can have more" },
  { [](PackingRequest& r)
    {
      r.arrangement = Arrangement::Chain;
      r.boundary = "p p p";
      r.box = tilted_box({}, { 8, 4, 4 });
    },
    "expected at most 8 grains, which the box holds along its first vector, got 100" },
  { [](PackingRequest& r)
    {
      r.particles = 0;
      r.box = tilted_box({}, { 1.2, 1.2, 1.2 });
    },
    "expected a box that holds a grain at the solid fraction asked for, got 0.000000" },
  { [](PackingRequest& r)
    {
      r.arrangement = Arrangement::SimpleCubic;
      r.box = tilted_box({}, { 4, 4, 4 });
    },
    "expected at most 64 grains, which the box holds in this lattice, got 100" },
  { [](PackingRequest& r)
    {
      r.arrangement = Arrangement::FaceCentredCubic;
      r.boundary = "p p p";
      r.box = tilted_box({}, { 4, 1.2, 4 });
    },
    "expected a box that holds a cell of the face-centred cubic lattice, got one of height "
    "1.200000 "
    "along vector 2, where a cell needs 1.414214" },
};
}

TEST(PackingErrors, SayWhatCanBe)
{
  for (const Wrong& wrong : wrongs)
  {
    PackingRequest request;
    request.particles = 100;
    request.radii = one_radius(0.5);
    wrong.make(request);
    EXPECT_EQ(error_of(request).substr(0, std::string(wrong.text).size()), wrong.text);
  }
}
