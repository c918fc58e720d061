// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/compare_frames.h"

#include "granular/averages/particle_loader.h"
#include "granular/grid/sphere_box.h"
#include "granular/lines/fetch_particles.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/pieces.h"
#include "granular/particles/known_arrays.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/compare_particles.h"
#include "granular/paths/fragments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

namespace granular
{
namespace
{
using Rows = std::vector<std::int64_t>;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The names of the arrays that both frames have alike.
std::vector<std::string> names_of_both(const KnownArrays& current, const KnownArrays& reference)
{
  const KnownArrays& known = current.has_particles ? current : reference;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < known.names.size(); ++i)
  {
    const auto other = std::ranges::find(reference.names, known.names[i]);
    const bool both = other != reference.names.end() &&
      reference.sizes[static_cast<std::size_t>(other - reference.names.begin())] == known.sizes[i];
    if (both || !reference.has_particles)
    {
      names.push_back(known.names[i]);
    }
  }
  return names;
}

/// Returns the masses of some rows: those of an array, otherwise of spheres by density and radius. Nothing if a rank with
/// particles has neither, or no rank has particles. Collective.
std::optional<std::vector<double>> read_masses(
  const FrameView& view, const std::string& name, const Rows& rows, Communicator& ranks)
{
  const auto [velocity, radius, mass, density, stress] =
    find_particle_sources(view, { "", "radius", name, "" });
  const bool known = mass || density;
  std::array<std::int64_t, 2> counts = { view.rows > 0 && known ? 1 : 0,
    view.rows > 0 && !known ? 1 : 0 };
  ranks.sum(counts);
  if (counts[0] == 0 || counts[1] > 0)
  {
    return {};
  }
  std::vector<double> masses(rows.size());
  if (mass)
  {
    load_rows({ &*mass, 1 }, rows, masses.data());
  }
  else if (density)
  {
    std::vector<double> radii(rows.size());
    load_rows({ &*density, 1 }, rows, masses.data());
    load_rows({ &*radius, 1 }, rows, radii.data());
    std::ranges::transform(
      masses, radii, masses.begin(), [](double each, double r) { return each * sphere_volume(r); });
  }
  return masses;
}

/// Picks the values at some places, and appends a value for each lost row.
template <class Value>
std::vector<Value> values_of_both(
  const Value* values, std::size_t size, const Rows& places, std::size_t lost, Value otherwise)
{
  std::vector<Value> both;
  both.reserve((places.size() + lost) * size);
  for (const std::int64_t place : places)
  {
    const Value* const first = values + static_cast<std::size_t>(place) * size;
    both.insert(both.end(), first, first + size);
  }
  both.resize(both.size() + lost * size, otherwise);
  return both;
}

struct Ends
{
  Rows id1;
  Rows id2;

  Ends(const LineRows& lines, Progress& progress)
    : id1(lines.read_ids("id1", progress))
    , id2(lines.read_ids("id2", progress))
  {
  }

  operator LineEnds() const { return { id1, id2 }; } // NOLINT(google-explicit-constructor)
};

/// The cells of some rows, several of a line that was split, and the row of each.
struct Cells
{
  Rows cells;
  Rows rows;

  Cells(const LineRows& lines, const Rows& of)
  {
    const Rows begins = lines.find_begins();
    const Rows ends = lines.find_ends();
    for (const std::int64_t row : of)
    {
      const auto at = static_cast<std::size_t>(row);
      for (std::int64_t cell = begins[at]; cell <= ends[at]; ++cell)
      {
        cells.push_back(cell);
        rows.push_back(row);
      }
    }
  }
};

/// A comparison in work.
class Comparison
{
public:
  Comparison(const ComparedInput& current, const ComparedInput& reference,
    const FrameCompareRequest& request, Communicator& ranks, PartialProgress& progress)
    : current_(current)
    , reference_(reference)
    , request_(request)
    , ranks_(ranks)
    , progress_(progress)
  {
  }

  ComparedFrames compare()
  {
    if (current_.particles != nullptr)
    {
      this->compare_particles();
    }
    if (current_.lines != nullptr)
    {
      this->compare_lines();
    }
    if (current_.particles != nullptr)
    {
      this->add_arrays();
    }
    return std::move(result_);
  }

  void tell(Notices& notices)
  {
    std::array<std::int64_t, 2> sums = { kept_, ends_ ? std::ssize(ends_->id1) : 0 };
    ranks_.sum(sums);
    const auto tell = [&](bool holds, const char* topic, const std::string& text)
    {
      if (holds)
      {
        notices.push_back({ {}, text, topic });
      }
    };
    tell(compared_.far > 0, "far",
      std::to_string(compared_.far) +
        " particles moved more than a quarter of a period of the box: their displacement may be "
        "wrong by periods. Unwrapped points, or ix iy iz in the dump, make it exact");
    const bool boxless = current_.particles != nullptr && !compared_.unwrapped &&
      !current_.particles->has_box && !reference_.particles->has_box;
    tell(boxless && sums[0] > 0, "no box",
      "neither frame has a box in its field data (BoxOrigin, BoxVectors): displacements across "
      "periodic faces are those of the points");
    tell(unconnected_ > 0, "unconnected",
      std::to_string(unconnected_) + " of " + std::to_string(sums[1]) +
        " lines name a particle that is not there: they connect no fragments");
    const bool late =
      request_.reference == ReferenceFrame::First && request_.reference_number > 0 && sums[0] > 0;
    tell(late, "first frame",
      late ? "the first frame has no particles: the reference is the frame of time " +
          to_text(request_.times[request_.reference_number])
           : std::string());
    tell(current_.lines != nullptr && current_.lines->lack_places(), "no places",
      "the input Lines has no lines, as its file does not say where these are: draw the rows, the "
      "second output of the reader, with GranularLocalJoin");
  }

private:
  /// The wanted part of some rows.
  Rows part_of(const Rows& rows) const
  {
    const auto [first, last] = range_of_piece(std::ssize(rows), request_.piece, request_.pieces);
    return { rows.begin() + first, rows.begin() + last };
  }

  void compare_particles()
  {
    const FrameView& now = *current_.particles;
    const FrameView& before = *reference_.particles;
    ParticleCompareRequest request;
    request.threads = request_.threads;
    request.differences = names_in(
      request_.differences, names_of_both(share_arrays(now, ranks_), share_arrays(before, ranks_)));
    progress_.set_part(0.1, 0.6);
    compared_ = granular::compare_particles(now, before, request, ranks_, progress_);
    for (std::int64_t row = 0; row < now.rows; ++row)
    {
      if (!now.is_duplicate(row))
      {
        own_.push_back(row);
        kept_ += compared_.changes[static_cast<std::size_t>(row)] == Change::Kept ? 1 : 0;
      }
    }
    result_.particles.rows = this->part_of(own_);
    result_.particles.lost = this->part_of(compared_.lost);
  }

  void compare_lines()
  {
    progress_.set_part(0.6, 0.7);
    ends_.emplace(*current_.lines, progress_);
    const Ends before(*reference_.lines, progress_);
    const LineChanges changes = granular::compare_lines(*ends_, before, ranks_);
    Rows all(changes.current.size());
    std::iota(all.begin(), all.end(), std::int64_t{ 0 });
    Rows lost;
    for (std::size_t row = 0; row < changes.reference.size(); ++row)
    {
      if (changes.reference[row] == Change::Lost)
      {
        lost.push_back(static_cast<std::int64_t>(row));
      }
    }
    Cells now(*current_.lines, this->part_of(all));
    ComparedRows& lines = result_.lines;
    lines.lost = Cells(*reference_.lines, this->part_of(lost)).cells;
    const auto both =
      values_of_both(changes.current.data(), 1, now.rows, lines.lost.size(), Change::Lost);
    lines.rows = std::move(now.cells);
    add_array(lines.made, "change", ValueType::Int32, 1, block_of(both));
    // lines that were kept are as old as the reference frame, at least
    const std::vector<double>& times = request_.times;
    const double passed =
      times.empty() ? 0 : times[request_.shown] - times[request_.reference_number];
    std::vector<double> ages(both.size());
    std::ranges::transform(both, ages.begin(),
      [&](Change change) {
        return change == Change::Kept ? passed : change == Change::New ? 0 : none;
      });
    add_array(lines.made, "age", ValueType::Float64, 1, block_of(ages));
  }

  template <class Value>
  void add(const std::string& name, ValueType type, int size, const Value* values,
    const Rows& places, Value otherwise)
  {
    ComparedRows& particles = result_.particles;
    add_array(particles.made, name, type, size,
      block_of(values_of_both(
        values, static_cast<std::size_t>(size), places, particles.lost.size(), otherwise)));
  }

  void add_arrays()
  {
    const Rows& rows = result_.particles.rows;
    this->add("change", ValueType::Int32, 1, compared_.changes.data(), rows, Change::Lost);
    const auto add_doubles = [&](const std::string& name, int size, const Block& block)
    {
      this->add(
        name, ValueType::Float64, size, static_cast<const double*>(block.data()), rows, none);
    };
    add_doubles("displacement", 3, compared_.displacements);
    for (const DifferenceArray& array : compared_.differences)
    {
      add_doubles(array.name, array.size, array.values);
    }
    if (ends_)
    {
      this->add_fragments();
    }
  }

  void add_fragments()
  {
    const FrameView& view = *current_.particles;
    progress_.set_part(0.7, 0.8);
    Rows ids;
    if (const ArrayView* array = view.find("id"))
    {
      const Ids all(*array, view.rows, Executor(), progress_);
      std::ranges::transform(own_, std::back_inserter(ids),
        [&](std::int64_t row) { return all.values()[static_cast<std::size_t>(row)]; });
    }
    const auto masses = read_masses(view, request_.mass_array, own_, ranks_);
    progress_.set_part(0.8, 0.9);
    progress_.step(0);
    const Fragments found =
      find_fragments(ids, masses ? std::optional(std::span<const double>(*masses)) : std::nullopt,
        ends_->id1, ends_->id2, ranks_);
    unconnected_ = found.missing;
    Rows places(own_.size());
    std::iota(places.begin(), places.end(), std::int64_t{ 0 });
    places = this->part_of(places);
    constexpr std::int64_t no_fragment = 0;
    this->add("fragment", ValueType::Int64, 1, found.labels.data(), places, no_fragment);
    this->add("fragment_size", ValueType::Int64, 1, found.sizes.data(), places, no_fragment);
    if (masses)
    {
      this->add("fragment_mass", ValueType::Float64, 1, found.masses.data(), places, none);
    }
  }

  const ComparedInput& current_;
  const ComparedInput& reference_;
  const FrameCompareRequest& request_;
  Communicator& ranks_;
  PartialProgress& progress_;
  Rows own_; ///< of the current particles, that are no duplicates
  ComparedParticles compared_;
  std::optional<Ends> ends_; ///< of the current lines
  std::int64_t kept_ = 0;
  std::int64_t unconnected_ = 0; ///< lines of all ranks without a particle at an end
  ComparedFrames result_;
};
}

std::size_t find_reference(
  const FrameCompareRequest& request, const std::function<std::size_t()>& find_first)
{
  if (request.reference == ReferenceFrame::Previous)
  {
    return request.shown > 0 ? request.shown - 1 : 0;
  }
  if (request.reference == ReferenceFrame::First)
  {
    return find_first ? find_first() : 0;
  }
  if (!std::isfinite(request.reference_time))
  {
    throw Error("expected a finite ReferenceTime, got " + to_text(request.reference_time));
  }
  const auto after =
    std::ranges::upper_bound(request.times, request.reference_time) - request.times.begin();
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
}

ComparedFrames compare_frames(const ComparedInput& current, const ComparedInput& reference,
  const FrameCompareRequest& request, Communicator& ranks, Notices& notices,
  PartialProgress& progress)
{
  return do_together(ranks,
    [&]
    {
      Comparison comparison(current, reference, request, ranks, progress);
      ComparedFrames compared = comparison.compare();
      comparison.tell(notices);
      return compared;
    });
}
}
