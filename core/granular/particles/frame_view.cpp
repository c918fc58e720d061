// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/frame_view.h"

#include "granular/common/error.h"
#include "granular/frames/header_archive.h"
#include "granular/parallel/trade.h"

#include <bit>
#include <utility>

namespace granular
{
namespace
{
bool same_box(const FrameView& a, const FrameView& b)
{
  const auto bits = [](const Twofold& value)
  { return std::bit_cast<std::uint64_t>(value.value()); }; // nan is nan
  const auto same = [&](const Twofold3& left, const Twofold3& right)
  { return std::ranges::equal(left, right, {}, bits, bits); };
  const Box& box = a.header.box;
  const Box& other = b.header.box;
  return a.has_box == b.has_box && a.coordinates == b.coordinates &&
    a.point_origin == b.point_origin && box.boundary == other.boundary &&
    same(box.origin, other.origin) && std::ranges::equal(box.vectors, other.vectors, same);
}
}

/// Facts that ranks tell each other of a frame.
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<FrameView>& frame)
{
  archive.number(frame.rows);
  archive.number(frame.has_box);
  pass(archive, frame.header);
  archive.number(frame.coordinates);
  archive.number(frame.point_origin);
}

ArrayView view_rows(std::string name, ValueType type, const void* values, int size)
{
  const std::size_t bytes = type == ValueType::Text ? sizeof(std::string) : size_of(type);
  const auto* value = static_cast<const char*>(values);
  ArrayView view{ std::move(name), type, {}, size };
  for (int i = 0; i < size; ++i)
  {
    view.components.push_back(value);
    value += values ? bytes : 0;
  }
  return view;
}

void share_header(FrameView& frame, Communicator& ranks)
{
  do_together(ranks,
    [&]
    {
      const std::vector<FrameView> known = gather(ranks, frame);
      const auto less = [](const FrameView& a, const FrameView& b)
      { return std::pair(a.rows > 0, a.has_box) < std::pair(b.rows > 0, b.has_box); };
      const FrameView& best = *std::ranges::max_element(known, less);
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
