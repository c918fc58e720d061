// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/contact_input.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace granular
{
ContactInput::ContactInput(
  const ContactSource& source, bool walls, const ContactArrays& wanted, Progress& progress)
{
  const LineRows& rows = *source.rows;
  view_.count = static_cast<std::size_t>(rows.count());
  if (rows.cells().has_box)
  {
    view_.box = rows.cells().header.box;
  }
  if (view_.count == 0)
  {
    return;
  }
  if (!walls)
  {
    view_.id1 = ids_[0] = rows.read_ids("id1", progress);
  }
  else if (rows.has("id1"))
  {
    throw Error("expected contacts with walls as Walls, got an array 'id1' of a second particle: "
                "contacts between particles are Lines");
  }
  view_.id2 = ids_[1] = rows.read_ids("id2", progress);
  this->read_ends(source);
  this->read_forces(rows, wanted);
  const auto read = [&](
                      bool is, const char* name, int numbers, std::vector<double>& own, auto member)
  {
    if (is && rows.has(name))
    {
      view_.*member = rows.read_tuples(name, numbers, own);
    }
  };
  read(wanted.tangential, "force_tangential", 3, tangential_, &ContactRows::tangential);
  read(wanted.torque, "torque", 3, torque_, &ContactRows::torque);
  const bool place = wanted.point || (walls && ends_.empty());
  read(place, "contact_point", 3, point_, &ContactRows::contact_point);
  read(wanted.overlap, "delta", 1, overlap_, &ContactRows::overlap);
}

/// A line that was split spans what its parts span one after the other.
void ContactInput::read_ends(const ContactSource& source)
{
  ends_ = source.read_ends();
  if (!ends_.empty() && !source.rows->are_all_cells())
  {
    const std::vector<double> cells = std::move(ends_);
    const std::vector<std::int64_t> begins = source.rows->find_begins();
    const std::vector<std::int64_t> lasts = source.rows->find_ends();
    ends_.clear();
    for (std::size_t row = 0; row < begins.size(); ++row)
    {
      const double* const first = cells.data() + 6 * begins[row];
      ends_.insert(ends_.end(), first, first + 6);
      double* const to = &ends_[6 * row + 3];
      for (std::int64_t cell = begins[row] + 1; cell <= lasts[row]; ++cell)
      {
        const double* const part = cells.data() + 6 * cell;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          to[axis] += part[3 + axis] - part[axis];
        }
      }
    }
  }
  view_.ends = ends_;
}

void ContactInput::read_forces(const LineRows& rows, const ContactArrays& wanted)
{
  if (wanted.force && rows.has("force"))
  {
    view_.force = rows.read_tuples("force", 3, force_);
  }
  else if (wanted.force && rows.has("force_normal"))
  {
    std::vector<double> own;
    const std::span<const double> normal = rows.read_tuples("force_normal", 3, own);
    force_.assign(normal.begin(), normal.end());
    if (rows.has("force_tangential"))
    {
      const std::span<const double> across = rows.read_tuples("force_tangential", 3, own);
      std::ranges::transform(force_, across, force_.begin(), std::plus<>());
    }
    else if (wanted.tangential)
    {
      throw Error("expected an array 'force_tangential' or 'force' of the contacts for "
                  "mobilised_friction, got 'force_normal' alone");
    }
    view_.force = force_;
  }
}

ContactInputs::ContactInputs(
  const ContactSources& sources, const ContactArrays& wanted, Progress& progress)
{
  for (std::size_t port = 0; port < sources.size(); ++port)
  {
    if (sources[port].rows != nullptr)
    {
      rows.push_back(each[port].emplace(sources[port], port == 1, wanted, progress).rows());
    }
  }
}
}
