// SPDX-License-Identifier: BSD-3-Clause
// Particles and contacts made for tests, and the sums of sum_contacts as plain numbers.
#ifndef granular_tests_contacts_made_contacts_h
#define granular_tests_contacts_made_contacts_h

#include "granular/contacts/contact_sums.h"

#include "../support/error_of.h"
#include "../support/thread_ranks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace made
{
using granular::Box;
using granular::ContactRows;
using granular::ContactSums;
using granular::ContactSumsRequest;
using granular::LeverArm;
using granular::Vector3;
using Id = std::int64_t;
using Six = std::array<double, 6>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct Particle
{
  Id id = 0;
  Vector3 x = {};
  double radius = 0.5;
  unsigned char ghost = 0;
};

/// A row of a file: between two particles, or of the particle id2 with a wall.
struct Touch
{
  Id id1 = 0;
  Id id2 = 0;
  Vector3 from = {};
  Vector3 to = {};
  Vector3 force = {}; ///< on id1, of a wall on id2
  Vector3 tangential = {};
  Vector3 torque = {};
  Vector3 point = {};
  double overlap = 0;
};

/// The arrays that the rows of a file have.
struct Known
{
  bool ends = true;
  bool force = true;
  bool tangential = false;
  bool torque = false;
  bool point = false;
  bool overlap = false;
};

struct Scene
{
  std::vector<Particle> particles;
  std::vector<Touch> pairs;
  std::vector<Touch> walls;
  std::optional<Box> box = {};
  Known known = {};
  bool radii = true;
};

inline Box periodic_box(const Vector3& lo, const Vector3& hi, const char* boundary = "pp pp pp")
{
  Box box = Box::from_bounds(lo, hi);
  box.boundary = boundary;
  return box;
}

/// The arrays of some rows.
class Rows
{
public:
  Rows(const std::vector<Touch>& touches, const Known& known, bool walls)
  {
    for (const Touch& touch : touches)
    {
      if (!walls)
      {
        id1_.push_back(touch.id1);
      }
      id2_.push_back(touch.id2);
      add(ends_, touch.from, known.ends);
      add(ends_, touch.to, known.ends);
      add(force_, touch.force, known.force);
      add(tangential_, touch.tangential, known.tangential);
      add(torque_, touch.torque, known.torque);
      add(point_, touch.point, known.point);
      if (known.overlap)
      {
        overlap_.push_back(touch.overlap);
      }
    }
  }

  ContactRows view() const
  {
    return { id2_.size(), id1_, id2_, ends_, force_, tangential_, torque_, point_, overlap_ };
  }

private:
  static void add(std::vector<double>& to, const Vector3& value, bool known)
  {
    to.insert(to.end(), value.begin(), known ? value.end() : value.begin());
  }

  std::vector<Id> id1_, id2_;
  std::vector<double> ends_, force_, tangential_, torque_, point_, overlap_;
};

/// The arrays of some particles.
class Frame
{
public:
  Frame(const std::vector<Particle>& particles, const Scene& scene)
  {
    for (const Particle& particle : particles)
    {
      ids_.push_back(particle.id);
      points_.insert(points_.end(), particle.x.begin(), particle.x.end());
      radii_.push_back(particle.radius);
      ghosts_.push_back(particle.ghost);
    }
    view_.rows = std::ssize(ids_);
    view_.has_box = scene.box.has_value();
    view_.header.box = scene.box.value_or(Box());
    view_.ghosts = ghosts_.data();
    using granular::ValueType;
    view_.points = granular::view_rows("points", ValueType::Float64, points_.data(), 3);
    view_.arrays = { granular::view_rows("id", ValueType::Int64, ids_.data()) };
    if (scene.radii)
    {
      view_.arrays.push_back(granular::view_rows("radius", ValueType::Float64, radii_.data()));
    }
  }

  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  const granular::FrameView& view() const { return view_; }

private:
  std::vector<Id> ids_;
  std::vector<double> points_, radii_;
  std::vector<unsigned char> ghosts_;
  granular::FrameView view_;
};

/// The sums for a particle.
struct Sums
{
  std::int32_t coordination = 0;
  Vector3 force = {};
  Vector3 torque = {};
  Six fabric = {};
  Six stress = {};
  Vector3 principal = {};
  double von_mises = 0;
  int rattler = 0;
  std::int32_t backbone = 0;
};

/// The numbers of a particle as bits: -0 is not 0, and nan is nan.
inline std::vector<std::uint64_t> bits_of(const Sums& sums)
{
  std::vector<std::uint64_t> bits = { static_cast<std::uint64_t>(sums.coordination),
    static_cast<std::uint64_t>(sums.rattler), static_cast<std::uint64_t>(sums.backbone),
    std::bit_cast<std::uint64_t>(sums.von_mises) };
  const auto add = [&](const auto& values)
  {
    for (const double value : values)
    {
      bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
  };
  add(sums.force);
  add(sums.torque);
  add(sums.fabric);
  add(sums.stress);
  add(sums.principal);
  return bits;
}

struct Found
{
  std::vector<Sums> particles;                 ///< in the order of the scene
  std::array<std::vector<double>, 2> friction; ///< of pairs and walls, in their order
  std::array<std::int64_t, 7> counts = {};     ///< see counts_of
};

inline std::array<std::int64_t, 7> counts_of(const ContactSums& sums)
{
  return { sums.particles, sums.contacts, sums.rattling, sums.bearing, sums.missing, sums.broken,
    sums.repeated };
}

/// Grains whose numbers differ in any bit.
inline int count_different(const std::vector<Sums>& a, const std::vector<Sums>& b)
{
  int different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    different += bits_of(a[i]) == bits_of(b[i]) ? 0 : 1;
  }
  return different;
}

/// A request of everything.
inline ContactSumsRequest everything()
{
  ContactSumsRequest request;
  request.principal_stress = true;
  request.von_mises = true;
  request.friction = true;
  request.least_contacts = 2;
  return request;
}

/// Copies the numbers of one row out of an array; those of an array that was not made stay.
template <class To, class Value>
void take(const granular::Block& block, std::size_t row, std::size_t width, To* to, Value)
{
  const auto* const from = static_cast<const Value*>(block.data());
  for (std::size_t i = 0; from && i < width; ++i)
  {
    to[i] = static_cast<To>(from[width * row + i]);
  }
}

/// Stores the sums of a rank's particles, whose places in the scene are listed.
inline void store(const ContactSums& sums, const std::vector<std::size_t>& places, Found& found)
{
  for (std::size_t row = 0; row < places.size(); ++row)
  {
    Sums& to = found.particles[places[row]];
    take(sums.coordination, row, 1, &to.coordination, std::int32_t());
    take(sums.force, row, 3, to.force.data(), double());
    take(sums.torque, row, 3, to.torque.data(), double());
    take(sums.fabric, row, 6, to.fabric.data(), double());
    take(sums.stress, row, 6, to.stress.data(), double());
    take(sums.principal_stress, row, 3, to.principal.data(), double());
    take(sums.von_mises, row, 1, &to.von_mises, double());
    using Byte = unsigned char;
    take(sums.rattlers, row, 1, &to.rattler, Byte());
    take(sums.backbone, row, 1, &to.backbone, std::int32_t());
  }
  found.counts = counts_of(sums);
}

/// The rank of one of many things.
using Place = std::function<int(std::size_t i, int ranks)>;

inline int on_first(std::size_t, int)
{
  return 0;
}

inline int on_last(std::size_t, int ranks)
{
  return ranks - 1;
}

inline int in_turn(std::size_t i, int ranks)
{
  return static_cast<int>(i % static_cast<std::size_t>(ranks));
}

inline int anywhere(std::size_t i, int ranks)
{
  return static_cast<int>((i * 0x9e3779b97f4a7c15 >> 40) % static_cast<std::size_t>(ranks));
}

template <class Thing>
std::vector<Thing> part_of(const std::vector<Thing>& all, const Place& place,
  const granular::Communicator& ranks, std::vector<std::size_t>* places = nullptr)
{
  std::vector<Thing> part;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (place(i, ranks.size()) == ranks.rank())
    {
      part.push_back(all[i]);
      if (places)
      {
        places->push_back(i);
      }
    }
  }
  return part;
}

/// The sums of the part of a scene that this rank has. The lock is that of all ranks of this process, or null.
inline void sum_part(const Scene& scene, const ContactSumsRequest& request, const Place& particles,
  const Place& touches, granular::Communicator& ranks, Found& found, std::mutex* lock)
{
  std::vector<std::size_t> places;
  const Frame frame(part_of(scene.particles, particles, ranks, &places), scene);
  std::array<std::vector<std::size_t>, 2> rows;
  const Rows pairs(part_of(scene.pairs, touches, ranks, &rows[0]), scene.known, false);
  const Rows walls(part_of(scene.walls, touches, ranks, &rows[1]), scene.known, true);
  const std::array<ContactRows, 2> inputs = { pairs.view(), walls.view() };
  granular::Progress progress;
  const ContactSums sums = granular::sum_contacts(frame.view(), inputs, request, ranks, progress);
  const auto guard = lock ? std::unique_lock(*lock) : std::unique_lock<std::mutex>();
  store(sums, places, found);
  for (std::size_t input = 0; input < sums.friction.size(); ++input)
  {
    for (std::size_t row = 0; row < rows[input].size(); ++row)
    {
      take(sums.friction[input], row, 1, &found.friction[input][rows[input][row]], double());
    }
  }
}

inline Found empty_for(const Scene& scene)
{
  Found found;
  found.particles.resize(scene.particles.size());
  found.friction[0].resize(scene.pairs.size());
  found.friction[1].resize(scene.walls.size());
  return found;
}

inline Found sum_all(const Scene& scene, const ContactSumsRequest& request = everything())
{
  Found found = empty_for(scene);
  granular::SerialCommunicator alone;
  sum_part(scene, request, on_first, on_first, alone, found, nullptr);
  return found;
}

/// The same by threads that are ranks.
inline Found sum_spread(const Scene& scene, int size, const Place& particles, const Place& touches,
  const ContactSumsRequest& request = everything())
{
  Found found = empty_for(scene);
  std::mutex lock;
  run_ranks(size,
    [&](granular::Communicator& ranks)
    { sum_part(scene, request, particles, touches, ranks, found, &lock); });
  return found;
}
}
#endif
