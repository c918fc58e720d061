// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/average.h"

#include "granular/averages/block_sums.h"
#include "granular/averages/line_cells.h"
#include "granular/averages/particle_loader.h"
#include "granular/contacts/find_ends.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace granular
{
namespace
{
constexpr std::size_t rows_of_chunk = 65536;

/// Bits below the largest possible term in which its terms still count, at least, and shares below 1.
constexpr int stress_bits = 192;
constexpr int share_bits = 64;

/// Places of the sums beside those of stresses.
constexpr std::size_t ends_lane = 6;
constexpr std::size_t contacts_lane = 7;

double largest_of(const Vector3& vector) noexcept
{
  return std::max({ std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2]) });
}

/// Terms of a contact that are summed.
struct Line
{
  Vector3 start;
  Vector3 branch;
  bool usable = false;
};

class ContactPasses
{
public:
  ContactPasses(const FoundEnds& contacts, const Box* box, const EulerAverageRequest& request,
    Communicator& ranks, const Executor& executor, Progress& progress, EulerAverages& averages)
    : contacts_(contacts)
    , request_(request)
    , ranks_(ranks)
    , executor_(executor)
    , progress_(progress)
    , averages_(averages)
    , cells_(request.grid, request.cells, box)
    , blocks_(request.grid, request.wanted, ranks, executor, progress_)
  {
  }

  void run()
  {
    progress_.set_part(0, 0.1);
    this->scan();
    this->make_room();
    progress_.set_part(0.1, 0.3);
    this->locate();
    const std::vector<BlockSums::Group> groups =
      blocks_.make_groups(std::max(stresses_.size(), normals_.size()));
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
      const BlockSums::Group& group = groups[i];
      const auto part_at = [&](double step)
      { return 0.3 + 0.7 * (static_cast<double>(i) + step) / static_cast<double>(groups.size()); };
      progress_.set_part(part_at(0), part_at(request_.fields.fabric ? 0.5 : 1));
      this->add(group, stresses_,
        [](const ContactEnds& ends, std::size_t row, const Line& line, SumScale::Terms& terms)
        {
          const auto& [x, y, z] = line.branch;
          const auto& [fx, fy, fz] = ends.force(row);
          const double sign = ends.is_wall() ? -1 : 1; // the branch of a wall begins at it
          const double counts = ends.counts(row);
          terms = { sign * x * fx, sign * y * fy, sign * z * fz, sign * x * fy, sign * x * fz,
            sign * y * fz, counts * (ends.is_wall() ? 1 : 2),
            line.branch == Vector3{} ? 0 : counts };
        });
      this->finish_stress(group);
      if (request_.fields.fabric)
      {
        progress_.set_part(part_at(0.5), part_at(1));
        this->add(group, normals_,
          [](const ContactEnds& ends, std::size_t row, const Line& line, SumScale::Terms& terms)
          {
            const auto& [x, y, z] = ContactEnds::normal(line.branch);
            const double counts = ends.counts(row);
            terms = { counts * x * x, counts * y * y, counts * z * z, counts * x * y,
              counts * x * z, counts * y * z, 0, 0 };
          });
        this->finish_normals(group);
      }
    }
  }

private:
  /// Shares of contacts in cells, some at a time.
  struct Batch
  {
    static constexpr std::size_t most_rows = 256;
    static constexpr std::size_t most_shares = 4096;

    std::vector<std::int64_t> rows = std::vector<std::int64_t>(most_rows);
    LineCells::Room room;
    std::vector<std::int64_t> cells;
    std::vector<SumScale::Terms> terms;
  };

  /// Largest numbers of a rank.
  struct Largest
  {
    double force = 0;
    double branch = 0;
    double weakest = std::numeric_limits<double>::infinity(); ///< force times branch above 0
    std::int64_t rows = 0;
  };

  Line load(std::int64_t contact) const noexcept
  {
    const auto [ends, row] = contacts_.at(contact);
    return ends.has_line(row) ? Line{ ends.first(row), ends.branch(row), true } : Line{};
  }

  void scan()
  {
    std::vector<Largest> largest(
      executor_.workers((contacts_.rows() + rows_of_chunk - 1) / rows_of_chunk));
    executor_.for_each_stretch(
      contacts_.rows(), rows_of_chunk,
      [&](std::size_t first, std::size_t count, std::size_t worker)
      {
        Largest& own = largest[worker];
        for (std::size_t i = first; i < first + count; ++i)
        {
          const Line line = this->load(static_cast<std::int64_t>(i));
          const auto [ends, row] = contacts_.at(static_cast<std::int64_t>(i));
          if (line.usable)
          {
            const double force = largest_of(ends.force(row));
            const double branch = largest_of(line.branch);
            const double product = force * branch;
            own.force = std::max(own.force, force);
            own.branch = std::max(own.branch, branch);
            own.weakest = product > 0 ? std::min(own.weakest, product) : own.weakest;
            ++own.rows;
          }
        }
      },
      progress_);
    Largest here;
    const auto include = [](Largest& all, const Largest& one)
    {
      all.force = std::max(all.force, one.force);
      all.branch = std::max(all.branch, one.branch);
      all.weakest = std::min(all.weakest, one.weakest);
      all.rows += one.rows;
    };
    for (const Largest& one : largest)
    {
      include(here, one);
    }
    Largest all;
    for (const Largest& one : gather(ranks_, here))
    {
      include(all, one);
    }
    const std::int64_t terms = all.rows * cells_.check(all.branch);
    Magnitudes products;
    const double product = all.force * all.branch;
    products.add(&product, 1);
    const int top = product > 0 ? products.range(0).top + 1 : 0;
    std::array<SumScale::Range, SumScale::lanes> ranges;
    // the weakest contact has all digits, also where a share of it is all there is
    const int least = std::isfinite(all.weakest) ? std::ilogb(all.weakest) - 53 - share_bits : top;
    ranges.fill({ top, std::min(top - stress_bits, least) });
    ranges[ends_lane] = { 2, -share_bits };
    ranges[contacts_lane] = { 1, -share_bits };
    stresses_ = SumScale(ranges, terms);
    ranges.fill({ 1, 1 - stress_bits });
    normals_ = SumScale(ranges, terms);
  }

  void make_room()
  {
    const auto cells = static_cast<std::size_t>(request_.wanted.count(request_.grid));
    EulerSums& sums = averages_.sums;
    averages_.make_contact_room(request_.wanted.count(request_.grid),
      request_.tensors && contacts_.have_forces(), request_.fields);
    const std::size_t kept = request_.keep_sums ? cells : 0;
    sums.ends.resize(kept);
    sums.contacts.resize(kept);
    sums.normals.resize(request_.fields.fabric ? 6 * kept : 0);
    counted_.resize(request_.fields.fabric ? cells : 0);
  }

  void locate()
  {
    const std::size_t chunks = (contacts_.rows() + rows_of_chunk - 1) / rows_of_chunk;
    std::vector<std::vector<BlockRows::Entry>> entries(chunks);
    executor_.for_each_stretch(
      contacts_.rows(), rows_of_chunk,
      [&](std::size_t first, std::size_t count, std::size_t)
      {
        std::vector<BlockRows::Entry>& own = entries[first / rows_of_chunk];
        for (std::size_t i = 0; i < count; ++i)
        {
          const Line line = this->load(static_cast<std::int64_t>(first + i));
          if (line.usable)
          {
            blocks_.add_entries(static_cast<std::uint32_t>(i), own,
              [&](const auto& visit) { cells_.each_range(line.start, line.branch, visit); });
          }
        }
      },
      progress_);
    blocks_.set_rows(
      BlockRows::sorted(entries, static_cast<std::int64_t>(rows_of_chunk), blocks_.blocks()));
  }

  template <class MakeTerms>
  void add(const BlockSums::Group& group, const SumScale& scale, const MakeTerms& make_terms)
  {
    std::vector<Batch> batches(executor_.workers(group.tasks()));
    blocks_.add(group, scale, batches,
      [&](const BlockSums::Part& part, std::size_t, Batch& batch, std::int64_t* sums)
      {
        const CellRange range = blocks_.range(part.block);
        for (std::int64_t first = part.first; first < part.last;)
        {
          const std::span<const std::int64_t> rows =
            blocks_.rows().rows(part.block, first, part.last, batch.rows);
          first += static_cast<std::int64_t>(rows.size());
          this->fill(rows, range, make_terms, batch,
            [&]
            {
              scale.add(batch.terms, batch.cells.data(), sums);
              batch.cells.clear();
              batch.terms.clear();
            });
        }
      });
  }

  /// Calls flush() whenever there are many shares, and at the end.
  template <class MakeTerms, class Flush>
  void fill(std::span<const std::int64_t> rows, const CellRange& range, const MakeTerms& make_terms,
    Batch& batch, const Flush& flush) const
  {
    for (const std::int64_t contact : rows)
    {
      const Line line = this->load(contact);
      const auto [ends, row] = contacts_.at(contact);
      SumScale::Terms whole;
      make_terms(ends, row, line, whole);
      cells_.each_share(line.start, line.branch, range, batch.room,
        [&](std::int64_t cell, double share)
        {
          SumScale::Terms& terms = batch.terms.emplace_back();
          std::ranges::transform(whole, terms.begin(), [&](double term) { return term * share; });
          batch.cells.push_back(cell);
          if (batch.cells.size() == Batch::most_shares)
          {
            flush();
          }
        });
    }
    flush();
  }

  void finish_stress(const BlockSums::Group& group)
  {
    EulerSums& sums_kept = averages_.sums;
    blocks_.each_wanted(group, stresses_,
      [&](std::size_t, std::size_t to, double volume, const SumScale::Terms& sums)
      {
        const double share = averages_.sums.share.empty() ? 0 : averages_.sums.share[to];
        averages_.store_contacts(to, sums.data(), share, volume);
        if (request_.keep_sums)
        {
          sums_kept.ends[to] = sums[ends_lane];
          sums_kept.contacts[to] = sums[contacts_lane];
        }
        if (!counted_.empty())
        {
          counted_[to] = sums[contacts_lane];
        }
      });
  }

  void finish_normals(const BlockSums::Group& group)
  {
    blocks_.each_wanted(group, normals_,
      [&](std::size_t, std::size_t to, double, const SumScale::Terms& sums)
      {
        averages_.store_fabric(to, sums.data(), counted_[to]);
        if (request_.keep_sums)
        {
          std::copy_n(sums.begin(), 6, averages_.sums.normals.data() + 6 * to);
        }
      });
  }

  const FoundEnds& contacts_;
  const EulerAverageRequest& request_;
  Communicator& ranks_;
  const Executor& executor_;
  PartialProgress progress_;
  EulerAverages& averages_;
  LineCells cells_;
  BlockSums blocks_;
  SumScale stresses_{ {}, 1 };
  SumScale normals_{ {}, 1 };
  std::vector<double> counted_; ///< contacts that have a normal, of the wanted cells
};
}

void average_contacts(const FoundEnds& contacts, const Box* box, const EulerAverageRequest& request,
  Communicator& ranks, const Executor& executor, Progress& progress, EulerAverages& averages)
{
  do_together(ranks,
    [&] { ContactPasses(contacts, box, request, ranks, executor, progress, averages).run(); });
}

void add_contact_stress(EulerCells& cells, EulerFields& fields)
{
  fields.kinetic_normal = cells.normal_stress;
  fields.kinetic_shear = cells.shear_stress;
  for (std::size_t cell = 0; 3 * cell < fields.contact_normal.size(); ++cell)
  {
    const double* const normal = fields.contact_normal.data() + 3 * cell;
    cells.pressure[cell] = 0 -
      ((cells.normal_stress[3 * cell] + normal[0]) +
        (cells.normal_stress[3 * cell + 1] + normal[1]) +
        (cells.normal_stress[3 * cell + 2] + normal[2])) /
        3;
    for (std::size_t k = 3 * cell; k < 3 * cell + 3; ++k)
    {
      cells.normal_stress[k] += fields.contact_normal[k];
      cells.shear_stress[k] += fields.contact_shear[k];
    }
  }
}
}
