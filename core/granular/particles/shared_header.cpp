// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/shared_header.h"

#include "granular/common/error.h"
#include "granular/frames/header_archive.h"
#include "granular/parallel/gather.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
/// What a rank knows of a frame.
struct Known
{
  std::int64_t rows = 0;
  bool has_box = false;
  FrameHeader header = {};
  Coordinates coordinates = Coordinates::Absolute;
  Vector3 point_origin = {};
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<Known>& known)
{
  archive.number(known.rows);
  archive.number(known.has_box);
  pass(archive, known.header);
  archive.number(known.coordinates);
  archive.number(known.point_origin);
}

bool same_box(const Known& a, const Known& b)
{
  const auto values = [](const Box& box)
  {
    std::vector<double> all;
    for (const Twofold3& vector : { box.origin, box.vectors[0], box.vectors[1], box.vectors[2] })
    {
      for (const Twofold& value : vector)
      {
        all.push_back(value.value());
      }
    }
    return all;
  };
  const auto same_bits = [](const std::vector<double>& left, const std::vector<double>& right)
  { return std::memcmp(left.data(), right.data(), left.size() * sizeof(double)) == 0; };
  return a.has_box == b.has_box && a.coordinates == b.coordinates &&
    a.point_origin == b.point_origin && a.header.box.boundary == b.header.box.boundary &&
    same_bits(values(a.header.box), values(b.header.box)); // nan is nan
}
}

void share_header(FrameView& frame, Communicator& ranks)
{
  do_together(ranks,
    [&]
    {
      const std::vector<Known> known = gather(ranks,
        Known{ frame.rows, frame.has_box, frame.header, frame.coordinates, frame.point_origin });
      const auto less = [](const Known& a, const Known& b)
      { return std::pair(a.rows > 0, a.has_box) < std::pair(b.rows > 0, b.has_box); };
      const Known& best = *std::ranges::max_element(known, less);
      for (std::size_t i = 0; i < known.size(); ++i)
      {
        if (known[i].rows > 0 && !same_box(known[i], best))
        {
          throw Error("expected the same box and coordinates on all processes, got others on "
                      "process " +
            std::to_string(i));
        }
      }
      if (frame.rows == 0)
      {
        frame.has_box = best.has_box;
        frame.header = best.header;
        frame.coordinates = best.coordinates;
        frame.point_origin = best.point_origin;
      }
    });
}
}
