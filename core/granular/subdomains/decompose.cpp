// SPDX-License-Identifier: BSD-3-Clause
#include "granular/subdomains/decompose.h"

#include "granular/parallel/executor.h"
#include "granular/particles/bounds.h"
#include "granular/particles/point_forms.h"
#include "granular/subdomains/count_particles.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace granular
{
namespace
{
/// The work of one call.
class Work
{
public:
  Work(const FrameView& particles, const DecomposeRequest& request, Communicator& ranks,
    Communicator& group, Notices& notices, Progress& progress)
    : view_(particles)
    , request_(request)
    , ranks_(ranks)
    , group_(group)
    , notices_(notices)
    , progress_(progress)
    , executor_(request.threads)
  {
  }

  Decomposed run()
  {
    switch (request_.mode)
    {
      case SubdomainsOf::Grid:
        this->count_in_grid();
        break;
      case SubdomainsOf::Owners:
        this->find_by_owner();
        break;
      case SubdomainsOf::Given:
        this->count_in_given();
        break;
      case SubdomainsOf::Ranks:
        this->find_by_rank();
        break;
    }
    found_.imbalance = imbalance_of(found_.all.subdomains, processes_);
    if (found_.outside > 0)
    {
      notices_.emplace_back(Where{},
        std::to_string(found_.outside) + " particles are outside of all subdomains, and in none",
        "outside");
    }
    return std::move(found_);
  }

private:
  std::vector<Subdomain>& all() { return found_.all.subdomains; }

  void set_outside(std::int64_t own)
  {
    group_.sum({ &own, 1 });
    found_.outside = own;
  }

  /// Adds up what all ranks counted.
  void set_counts(ParticleCounts counts)
  {
    group_.sum(counts.particles);
    this->set_outside(counts.outside);
    processes_ = static_cast<std::int64_t>(this->all().size());
    for (std::size_t i = 0; i < this->all().size(); ++i)
    {
      this->all()[i].particles = counts.particles[i];
    }
  }

  void count_in_grid()
  {
    const auto [lo, hi] = find_bounds(
      view_, request_.bounds, "the subdomains of its processes are tilted, too, and no voxels");
    const ProcessGrid grid = grid_in(request_.grid, lo, hi);
    found_.all.subdomains = grid.subdomains(0, grid.size());
    this->set_counts(granular::count_in_grid(view_, grid, executor_, progress_));
  }

  void count_in_given()
  {
    found_.all = gather_decomposition(request_.read_given(), group_);
    found_.all.has_particles = true;
    SubdomainChecks checks;
    checks.gap = Answer::None; // who is in one is outside, which is told
    check_subdomains(this->all(), checks, {}, notices_, progress_);
    this->set_counts(count_in_subdomains(view_, this->all(), executor_, progress_));
  }

  void find_by_owner()
  {
    ParticleBounds own;
    const ArrayView* const owners = view_.find(request_.owners);
    if (view_.rows > 0 && owners == nullptr)
    {
      throw Error(
        "expected a point array '" + request_.owners + "' with ranks of processes, got none");
    }
    if (view_.rows > 0)
    {
      own = bounds_by_process(view_, *owners, executor_, progress_);
    }
    this->all() = join_by_process(own.subdomains, group_);
    this->set_outside(own.outside);
    for (const Subdomain& subdomain : this->all())
    {
      processes_ = std::max(processes_, std::int64_t{ subdomain.rank } + 1);
    }
    processes_ = std::max(processes_, request_.grid.processes);
  }

  void find_by_rank()
  {
    ParticleBounds own = bounds_of_particles(view_, executor_, progress_);
    for (Subdomain& subdomain : own.subdomains)
    {
      subdomain.rank = ranks_.rank();
    }
    this->all() = join_by_process(own.subdomains, ranks_);
    processes_ = ranks_.size();
    this->set_outside(own.outside);
    SubdomainChecks checks;
    checks.overlap = Answer::Notice;
    checks.gap = Answer::None;
    check_subdomains(this->all(), checks, {}, notices_, progress_);
  }

  const FrameView& view_;
  const DecomposeRequest& request_;
  Communicator& ranks_;
  Communicator& group_;
  Notices& notices_;
  Progress& progress_;
  const Executor executor_;
  Decomposed found_;
  std::int64_t processes_ = 0; ///< of which some may have no particles, and no subdomain
};
}

Decomposed decompose(const FrameView& particles, const DecomposeRequest& request,
  Communicator& ranks, Communicator& group, Notices& notices, Progress& progress)
{
  return Work(particles, request, ranks, request.mode == SubdomainsOf::Ranks ? ranks : group,
    notices, progress)
    .run();
}

Decomposition Decomposed::part(const FrameView& particles, SubdomainsOf mode,
  std::pair<std::int64_t, std::int64_t> range, int rank) const
{
  Decomposition part{ {}, true, all.has_ranks };
  if (mode == SubdomainsOf::Ranks)
  {
    std::ranges::copy_if(all.subdomains, std::back_inserter(part.subdomains),
      [&](const Subdomain& subdomain) { return subdomain.rank == rank; });
  }
  else
  {
    part.subdomains.assign(
      all.subdomains.begin() + range.first, all.subdomains.begin() + range.second);
  }
  if (particles.coordinates != Coordinates::Scaled)
  {
    return part;
  }
  const Box& box = particles.header.box;
  if (box.tilted)
  {
    throw UnsupportedError("expected points that are not scaled, or a box along the "
                           "axes, got scaled points of a tilted box");
  }
  for (Subdomain& subdomain : part.subdomains)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      scale_aligned(box, axis, { &subdomain.lo[axis], 1 });
      scale_aligned(box, axis, { &subdomain.hi[axis], 1 });
    }
  }
  return part;
}

ProcessGrid grid_in(GridRequest request, const Vector3& lo, const Vector3& hi)
{
  request.lo = lo;
  request.hi = hi;
  return make_process_grid(request);
}
}
