// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/local_join.h"

#include "granular/geometry/positions.h"
#include "granular/lines/lines.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"
#include "granular/particles/known_arrays.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace granular
{
namespace
{
std::span<double> doubles_in(const Block& block)
{
  return { static_cast<double*>(block.data()), block.bytes() / sizeof(double) };
}

class LocalJoiner
{
public:
  LocalJoiner(FrameView& particles, const LineRows& rows, const LocalJoinRequest& request,
    Communicator& ranks, PartialProgress& progress)
    : particles_(particles)
    , rows_(rows)
    , request_(request)
    , ranks_(ranks)
    , progress_(progress)
    , all_rows_(rows.count())
    , rest_known_(rows.has(request.equilibrium_length_array))
  {
    const double rest = request.equilibrium_length;
    if (!(rest >= 0 && rest <= std::numeric_limits<double>::max()))
    {
      throw Error("expected an EquilibriumLength of 0 or more, got " + to_text(rest));
    }
  }

  LocalJoin join()
  {
    JoinRequest wanted;
    this->share_facts(wanted);
    this->share_box();
    const std::vector<std::int64_t> id1 = rows_.read_ids("id1", progress_);
    const std::vector<std::int64_t> id2 = rows_.read_ids("id2", progress_);
    progress_.set_part(0, 0.6);
    joined_ = join_lines(particles_, id1, id2, wanted, ranks_, progress_);
    progress_.set_part(0.6, 0.95);
    this->draw();
    this->find_elongations();
    this->count_misfits();
    remarks_ = { this->find_example(id1, id2), request_.timesteps };
    for (std::int64_t* count : { &all_rows_, &misfits_, &without_rest_ })
    {
      ranks_.sum({ count, 1 });
    }
    for (std::string& remark : remarks_)
    {
      const std::vector<std::string> said = ranks_.all_gather(remark);
      const auto first = std::ranges::find_if(said, [](const auto& text) { return !text.empty(); });
      remark = first == said.end() ? std::string() : *first;
    }
    this->find_cells();
    made_.rows = joined_.rows;
    std::ranges::move(joined_.arrays, std::back_inserter(made_.arrays));
    return std::move(made_);
  }

  Notices notices() const
  {
    Notices told;
    const auto tell = [&](bool holds, const char* topic, const std::string& text)
    {
      if (holds)
      {
        told.emplace_back(Where{}, text, topic);
      }
    };
    const std::string of_rows = " of " + std::to_string(all_rows_) + " lines ";
    tell(all_rows_ == 0 && rows_.lack_places(), "no places",
      "the input Lines has no lines, as its file does not say where these are: take the rows, the "
      "second output of the reader");
    tell(joined_.missing > 0, "missing",
      std::to_string(joined_.missing) + of_rows +
        "are left out: no particle has the id of an end, as in " + remarks_[0]);
    tell(joined_.repeated > 0, "repeated",
      std::to_string(joined_.repeated) +
        " particles have the id of another one: lines go to the first");
    tell(without_rest_ > 0, "no rest",
      std::to_string(without_rest_) + of_rows +
        "have an equilibrium length of 0: their elongation and strain are nan");
    tell(misfits_ > 0, "misfits",
      std::to_string(misfits_) + of_rows +
        "are not as long as their array dist says: box or timestep are not those of the particles");
    tell(!remarks_[1].empty(), "timesteps", remarks_[1]);
    const bool whole = particles_.has_box || request_.periodic_lines == PeriodicLines::AsWritten;
    tell(!whole && all_rows_ > joined_.missing, "no box",
      "neither the particles nor the lines have a box in their field data (BoxOrigin, "
      "BoxVectors): lines are as written");
    return told;
  }

private:
  /// Shares the facts that all must know alike, also those who have no particles or no rows, and then perhaps no arrays: the names that
  /// "*" stands for, whether there are equilibrium lengths, and where the rows of each begin.
  void share_facts(JoinRequest& wanted)
  {
    wanted.threads = request_.threads;
    wanted.means = share_names(request_.averages, particles_, ranks_);
    wanted.differences = share_names(request_.differences, particles_, ranks_);
    std::int64_t with = rest_known_ ? 1 : 0;
    ranks_.sum({ &with, 1 });
    rest_known_ = with > 0;
    const std::vector<std::int64_t> counts = gather(ranks_, all_rows_);
    made_.first_row =
      std::accumulate(counts.begin(), counts.begin() + ranks_.rank(), request_.first_row);
  }

  /// Takes the box of the lines where the particles have lost theirs.
  void share_box()
  {
    if (particles_.has_box)
    {
      return;
    }
    FrameView lines;
    lines.rows = rows_.count();
    lines.has_box = rows_.cells().has_box;
    lines.header.box = rows_.cells().header.box;
    share_header(lines, ranks_);
    made_.box_of_lines = lines.has_box;
    particles_.has_box = lines.has_box;
    std::swap(particles_.header.box, lines.header.box);
  }

  /// Draws the lines. Scaled points: they are made where the particles are, and then scaled as these were.
  void draw()
  {
    const bool scaled = particles_.coordinates == Coordinates::Scaled;
    const Box box = particles_.has_box ? particles_.header.box : Box{};
    Request wanted;
    wanted.periodic_lines = request_.periodic_lines;
    if (particles_.coordinates == Coordinates::Unwrapped &&
      wanted.periodic_lines == PeriodicLines::Split)
    {
      wanted.periodic_lines = PeriodicLines::MinimumImage;
    }
    wanted.point_origin = scaled ? Vector3{} : particles_.point_origin;
    wanted.threads = request_.threads;
    Lines& lines = made_.lines =
      make_lines(doubles_in(joined_.first), doubles_in(joined_.second), box, wanted, progress_);
    if (scaled && lines.count > 0)
    {
      check_volume(box);
      convert_positions(plan_form(Coordinates::Absolute, ColumnRole::ScaledPosition), box,
        particles_.point_origin, {}, doubles_in(lines.points));
    }
  }

  /// The numbers of the rows that were joined.
  std::vector<double> read_numbers(const std::string& name) const
  {
    if (joined_.count == 0)
    {
      return {};
    }
    std::vector<double> own;
    const std::span<const double> all = rows_.read_tuples(name, 1, own);
    return joined_.rows.empty() ? std::vector<double>(all.begin(), all.end())
                                : pick(all, joined_.rows);
  }

  void find_elongations()
  {
    std::vector<double> rest;
    if (rest_known_)
    {
      rest = this->read_numbers(request_.equilibrium_length_array);
    }
    else if (request_.equilibrium_length > 0)
    {
      rest.assign(static_cast<std::size_t>(joined_.count), request_.equilibrium_length);
    }
    else
    {
      return;
    }
    const std::span<const double> lengths = doubles_in(made_.lines.lengths);
    std::vector<double> elongations;
    std::vector<double> strains;
    for (std::size_t i = 0; i < rest.size(); ++i)
    {
      const double length = std::abs(rest[i]);
      without_rest_ += length == 0 ? 1 : 0;
      const double elongation =
        length == 0 ? std::numeric_limits<double>::quiet_NaN() : lengths[i] - length;
      elongations.push_back(elongation);
      strains.push_back(elongation / length);
    }
    made_.arrays.push_back({ "elongation", 1, block_of(elongations) });
    made_.arrays.push_back({ "strain", 1, block_of(strains) });
  }

  void count_misfits()
  {
    if (request_.periodic_lines != PeriodicLines::AsWritten && rows_.has_numbers("dist"))
    {
      misfits_ = granular::count_misfits(doubles_in(made_.lines.lengths),
        this->read_numbers("dist"), doubles_in(joined_.first), doubles_in(joined_.second));
    }
  }

  /// The ids of the first row that was left out; empty if none was.
  std::string find_example(
    const std::vector<std::int64_t>& id1, const std::vector<std::int64_t>& id2) const
  {
    const std::vector<std::int64_t>& found = joined_.rows;
    if (joined_.count == static_cast<std::int64_t>(id1.size()))
    {
      return {};
    }
    std::size_t row = 0;
    while (row < found.size() && found[row] == static_cast<std::int64_t>(row))
    {
      ++row;
    }
    return std::to_string(id1[row]) + " and " + std::to_string(id2[row]);
  }

  void find_cells()
  {
    const std::vector<std::int64_t>& parts = made_.lines.rows;
    const bool same = parts.empty() && joined_.rows.empty() && rows_.are_all_cells() &&
      made_.lines.count == rows_.count();
    for (std::int64_t part = 0; !same && part < made_.lines.count; ++part)
    {
      const std::int64_t line = parts.empty() ? part : parts[static_cast<std::size_t>(part)];
      made_.cells.push_back(
        rows_.cell_of(joined_.rows.empty() ? line : joined_.rows[static_cast<std::size_t>(line)]));
    }
  }

  FrameView& particles_;
  const LineRows& rows_;
  const LocalJoinRequest& request_;
  Communicator& ranks_;
  PartialProgress& progress_;
  LocalJoin made_;
  JoinedLines joined_;
  std::int64_t all_rows_;              ///< in the end of all ranks, like those that follow
  std::int64_t misfits_ = 0;           ///< lines that are not as long as their array dist says
  std::int64_t without_rest_ = 0;      ///< lines whose equilibrium length is 0
  std::array<std::string, 2> remarks_; ///< ids that were not found, timesteps that differ; or empty
  bool rest_known_;
};
}

LocalJoin join_local(FrameView& particles, const LineRows& rows, const LocalJoinRequest& request,
  Communicator& ranks, Notices& notices, PartialProgress& progress)
{
  LocalJoiner joiner(particles, rows, request, ranks, progress);
  LocalJoin made = joiner.join();
  std::ranges::move(joiner.notices(), std::back_inserter(notices));
  return made;
}
}
