// SPDX-License-Identifier: BSD-3-Clause
// Pieces, one after the other, are the whole, to the bit; threads change nothing.
#include "../support/packings.h"

#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;

struct Part
{
  const char* name;
  std::function<void(PackingRequest&)> choose;
};

const Part parts[] = {
  { "random", [](PackingRequest& request) { request.boundary = "p f p"; } },
  { "random, two sizes, tilted",
    [](PackingRequest& request)
    {
      request.particles = 0;
      request.box = tilted_box({}, { 35, 30, 40 }, { 10, 5, -7 });
      request.boundary = "p p p";
      request.radii = two_radii(0.4, 0.8, 0.2);
    } },
  { "random, few", [](PackingRequest& request) { request.particles = 5; } },
  { "random, none but one", [](PackingRequest& request) { request.particles = 1; } },
  { "random, thin",
    [](PackingRequest& request)
    {
      request.box = tilted_box({}, { 400, 3, 300 });
      request.boundary = "p p f";
    } },
  { "simple cubic", [](PackingRequest& r) { r.arrangement = Arrangement::SimpleCubic; } },
  { "face-centred cubic",
    [](PackingRequest& r) { r.arrangement = Arrangement::FaceCentredCubic; } },
  { "chain", [](PackingRequest& r) { r.arrangement = Arrangement::Chain; } },
};

PackingRequest request_of(const Part& part)
{
  PackingRequest request;
  request.particles = 6000;
  request.radii = one_radius(0.5);
  request.speed = 1;
  part.choose(request);
  return request;
}

void append(Grains& all, const Grains& piece)
{
  all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
  all.radius.insert(all.radius.end(), piece.radius.begin(), piece.radius.end());
  all.id.insert(all.id.end(), piece.id.begin(), piece.id.end());
  all.type.insert(all.type.end(), piece.type.begin(), piece.type.end());
  all.v.insert(all.v.end(), piece.v.begin(), piece.v.end());
}
}

TEST(PackingPieces, AreTheWhole)
{
  for (const Part& part : parts)
  {
    PackingRequest request = request_of(part);
    const Grains whole(request);
    for (const int pieces : { 2, 3, 7, 33 })
    {
      request.pieces = pieces;
      request.piece = 0;
      Grains joined(request);
      for (request.piece = 1; request.piece < pieces; ++request.piece)
      {
        const Grains piece(request);
        const double share = static_cast<double>(whole.size()) / pieces;
        EXPECT_LE(std::abs(static_cast<double>(piece.size()) - share), 1);
        EXPECT_EQ(piece.frame.header.rows, whole.frame.rows);
        append(joined, piece);
      }
      EXPECT_TRUE(joined.points == whole.points) << part.name << ", " << pieces << " pieces";
      EXPECT_TRUE(joined.radius == whole.radius) << part.name << ", " << pieces << " pieces";
      EXPECT_TRUE(joined.id == whole.id) << part.name << ", " << pieces << " pieces";
      EXPECT_TRUE(joined.type == whole.type) << part.name << ", " << pieces << " pieces";
      EXPECT_TRUE(joined.v == whole.v) << part.name << ", " << pieces << " pieces";
    }
  }
}

TEST(PackingPieces, ThreadsChangeNothing)
{
  for (const Part& part : parts)
  {
    PackingRequest request = request_of(part);
    const std::string one = Grains(request).bytes();
    for (const int threads : { 2, 5 })
    {
      request.threads = threads;
      EXPECT_TRUE(Grains(request).bytes() == one) << part.name << ", " << threads << " threads";
    }
  }
}

TEST(PackingPieces, RangesAreThoseOfTheValues)
{
  PackingRequest request = request_of(parts[1]);
  request.ranges = true;
  request.threads = 3;
  request.pieces = 2;
  const Grains particles(request);
  granular::ValueRange points(3);
  points.add(particles.points.data()->data(), particles.size());
  EXPECT_EQ(particles.frame.points_range.components(), points.components());
  for (const granular::TableArray& array : particles.frame.arrays)
  {
    ASSERT_TRUE(array.range.known()) << array.info.name;
    if (array.info.name == "radius")
    {
      EXPECT_EQ(array.range.components()[0], (granular::ValueRange::Bounds{ 0.4, 0.8 }));
    }
    if (array.info.name == "id")
    {
      EXPECT_EQ(array.range.components()[0][1], static_cast<double>(particles.size()));
    }
  }
}

TEST(PackingPieces, ProgressGoesOnAndCanStop)
{
  struct Watch : granular::Progress
  {
    bool report(double fraction) override
    {
      reported.push_back(fraction);
      return reported.size() != stop_at;
    }
    std::vector<double> reported;
    std::size_t stop_at = 0;
  };
  for (const Part& part : { parts[0], parts[5] })
  {
    const PackingRequest request = request_of(part);
    Watch whole;
    granular::make_packing(request, whole);
    EXPECT_TRUE(std::is_sorted(whole.reported.begin(), whole.reported.end()));
    EXPECT_EQ(whole.reported.front(), 0);
    EXPECT_EQ(whole.reported.back(), 1);
    ASSERT_GT(whole.reported.size(), 4u);
    for (std::size_t at = 1; at <= whole.reported.size(); ++at)
    {
      Watch stopped;
      stopped.stop_at = at;
      EXPECT_THROW(granular::make_packing(request, stopped), granular::Cancelled) << at;
    }
  }
}
