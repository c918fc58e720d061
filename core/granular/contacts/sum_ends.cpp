// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/sum_ends.h"

#include "granular/common/simd.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/memory/block.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
/// Sums of so many terms, which are added fastest where their number is known in advance.
///
/// The ends are read in their order, some at a time, and the sums that they are added to are brought into the cache before.
/// Threads own blocks of particles in turn, and look through all ends.
template <std::size_t count>
class EndSums
{
public:
  /// rows: particles. Memory comes from the pool of the request.
  EndSums(const EndSource& source, std::int64_t rows, const ContactTerms& terms,
    const ContactSumsRequest& request, const Executor& executor)
    : source_(source)
    , places_(source.places)
    , rows_(static_cast<std::size_t>(rows))
    , terms_(terms)
    , executor_(executor)
    , most_records_(std::clamp(request.memory / sizeof(Record) / block_size, std::size_t{ 1 },
                      (rows_ + block_size - 1) / block_size + 1) *
        block_size)
    , memory_(std::min(rows_, most_records_) * sizeof(Record), request.pool)
  {
    const auto room = [&](bool wanted, std::size_t bytes)
    { return wanted ? Block(rows_ * bytes, request.pool) : Block(); };
    sums_.coordination = room(true, sizeof(std::int32_t));
    sums_.force = room(terms.force, 3 * sizeof(double));
    sums_.torque = room(terms.torque, 3 * sizeof(double));
    sums_.fabric = room(terms.fabric, 6 * sizeof(double));
    sums_.stress = room(terms.stress, 6 * sizeof(double));
    blocks_.resize(most_records_ / block_size);
  }

  ContactSums run(Progress& progress)
  {
    for (first_ = 0; first_ < rows_; first_ += most_records_)
    {
      records_ = { static_cast<Record*>(memory_.data()), std::min(rows_ - first_, most_records_) };
      PartialProgress parts(progress);
      const auto set_part = [&](double from, double to)
      {
        const auto before = static_cast<double>(first_);
        const auto own = static_cast<double>(records_.size());
        const auto all = static_cast<double>(rows_);
        parts.set_part((before + from * own) / all, (before + to * own) / all);
      };
      for (std::size_t i = 0; i < blocks_.size(); ++i)
      {
        blocks_[i] = { static_cast<std::uint32_t>(i % this->threads()), false };
      }
      set_part(0, 0.85);
      this->for_each_end([&](std::size_t from, std::size_t to, std::size_t thread)
        { this->add(from, to, thread); },
        parts);
      set_part(0.85, 1);
      this->sum_again(this->finish(parts));
    }
    return std::move(sums_);
  }

private:
  struct Record
  {
    Counted counted;
    RoundedSums<count> sums;
  };

  /// Some records that follow each other.
  struct RecordBlock
  {
    std::uint32_t owner; ///< the thread
    bool begun;          ///< the records are there
  };

  using Terms = std::array<double, EndTerms::most>;

  static constexpr std::size_t block_size = 256;

  static constexpr std::size_t ends_at_once = 32;

  /// Some ends, whose sums are on the way to the cache.
  struct Batch
  {
    std::size_t size;
    std::array<std::size_t, ends_at_once> ends;
    std::array<Record*, ends_at_once> records;
    std::array<EndTerms, ends_at_once> terms;
  };

  std::size_t threads() const noexcept { return static_cast<std::size_t>(executor_.threads()); }

  /// Calls visit(first end, end of the ends, thread) for all threads and some ends, then for some others.
  template <class Visit>
  void for_each_end(const Visit& visit, Progress& progress) const
  {
    constexpr std::size_t at_once = 1 << 20;
    PartialProgress parts(progress);
    for (std::size_t first = 0; first < places_.size(); first += at_once)
    {
      const std::size_t last = std::min(first + at_once, places_.size());
      const auto all = static_cast<double>(places_.size());
      parts.set_part(static_cast<double>(first) / all, static_cast<double>(last) / all);
      executor_.parallel_for(
        this->threads(), [&](std::size_t thread, std::size_t) { visit(first, last, thread); },
        parts);
    }
  }

  /// Returns the record of the particle of an end, which begins here if none of its block has; null if it is not in memory, or that of another thread.
  Record* find(std::size_t end, std::size_t thread) noexcept
  {
    const std::size_t at = static_cast<std::size_t>(places_[end]) - first_;
    if (at >= records_.size() || blocks_[at / block_size].owner != thread)
    {
      return nullptr;
    }
    this->begin(at / block_size);
    return &records_[at];
  }

  /// Not before they are needed: what then is in the cache stays there.
  void begin(std::size_t block) noexcept
  {
    if (!blocks_[block].begun)
    {
      blocks_[block].begun = true;
      const std::span all = records_.subspan(block * block_size);
      std::uninitialized_value_construct_n(all.data(), std::min(all.size(), block_size));
    }
  }

  void add(std::size_t from, std::size_t to, std::size_t thread)
  {
    Batch batch;
    while (from < to)
    {
      batch.size = 0;
      for (; from < to && batch.size < ends_at_once; ++from)
      {
        if (Record* const record = this->find(from, thread))
        {
          prefetch(record);
          batch.ends[batch.size] = from;
          batch.records[batch.size++] = record;
        }
      }
      source_.read(std::span(batch.ends).first(batch.size), batch.terms.data());
#if GRANULAR_X86
      if (avx2_)
      {
        add_avx2(batch);
        continue;
      }
#endif
      add_terms(batch);
    }
  }

#if GRANULAR_X86
  [[gnu::target("avx2")]] static void add_avx2(const Batch& batch) noexcept
  {
    add_terms(batch);
  }
#endif

  [[gnu::always_inline]] static void add_terms(const Batch& batch) noexcept
  {
    for (std::size_t i = 0; i < batch.size; ++i)
    {
      Record& record = *batch.records[i];
      const EndTerms& added = batch.terms[i];
      record.counted.contacts += added.counted.contacts;
      record.counted.normals += added.counted.normals;
      record.sums.add(std::span(added.terms).template first<count>());
    }
  }

  static void prefetch(const Record* record) noexcept
  {
    const auto* const bytes = reinterpret_cast<const char*>(record);
    for (std::size_t byte = 0; byte < sizeof(Record); byte += 64)
    {
      __builtin_prefetch(bytes + byte, 1);
    }
  }

  /// Stores the sums. Returns true for the records of which it is not known how a sum is rounded; nothing if there are none.
  std::vector<bool> finish(Progress& progress)
  {
    std::vector<std::vector<std::size_t>> unsure((records_.size() + block_size - 1) / block_size);
    executor_.for_each_stretch(
      records_.size(), block_size,
      [&](std::size_t first, std::size_t size, std::size_t)
      {
        this->begin(first / block_size);
        Terms terms;
        for (std::size_t at = first; at < first + size; ++at)
        {
          bool sure = true;
          for (std::size_t i = 0; i < count; ++i)
          {
            sure = records_[at].sums.round(i, terms[i]) && sure;
          }
          if (!sure)
          {
            unsure[first / block_size].push_back(at);
          }
          this->store(at, terms.data());
        }
      },
      progress);
    std::vector<bool> all;
    for (const std::vector<std::size_t>& block : unsure)
    {
      for (const std::size_t at : block)
      {
        all.resize(records_.size());
        all[at] = true;
      }
    }
    return all;
  }

  /// Sums the ends of these records, which are few, exactly.
  void sum_again(const std::vector<bool>& unsure)
  {
    std::vector<std::pair<std::size_t, std::size_t>> found; // records, and an end of theirs
    for (std::size_t end = 0; !unsure.empty() && end < places_.size(); ++end)
    {
      const std::size_t at = static_cast<std::size_t>(places_[end]) - first_;
      if (at < records_.size() && unsure[at])
      {
        found.emplace_back(at, end);
      }
    }
    std::ranges::sort(found);
    std::vector<ExactSum> exact; // not on the stack, which may be small
    for (std::size_t i = 0; i < found.size();)
    {
      const std::size_t record = found[i].first;
      exact.assign(count, {});
      for (; i < found.size() && found[i].first == record; ++i)
      {
        EndTerms added;
        source_.read({ &found[i].second, 1 }, &added);
        for (std::size_t k = 0; k < count; ++k)
        {
          exact[k].add(added.terms[k]);
        }
      }
      Terms terms;
      std::ranges::transform(exact, terms.begin(), &ExactSum::rounded);
      this->store(record, terms.data());
    }
  }

  void store(std::size_t record, const double* terms)
  {
    const Counted& counted = records_[record].counted;
    const std::size_t row = first_ + record;
    static_cast<std::int32_t*>(sums_.coordination.data())[row] = counted.contacts;
    const auto take = [&](bool wanted, const Block& block, std::size_t width, double divisor)
    {
      double* const to = static_cast<double*>(block.data()) + width * row;
      for (std::size_t i = 0; wanted && i < width; ++i)
      {
        to[i] = *terms++ / divisor;
      }
    };
    take(terms_.force, sums_.force, 3, 1);
    take(terms_.torque, sums_.torque, 3, 1);
    take(terms_.fabric, sums_.fabric, 6, std::max(counted.normals, 1));
    take(terms_.stress, sums_.stress, 6, 1);
  }

  const EndSource& source_;
  std::span<const std::int64_t> places_;
  std::size_t rows_;
  ContactTerms terms_;
  const Executor& executor_;
  std::size_t most_records_; ///< in memory, for which all ends are looked through
  Block memory_;
  std::vector<RecordBlock> blocks_;
  std::size_t first_ = 0; ///< the particle of the first record
  std::span<Record> records_;
  bool avx2_ = best_simd() != Simd::Portable;
  ContactSums sums_;
};

template <std::size_t count>
ContactSums sum_terms(const EndSource& source, std::int64_t rows, const ContactTerms& terms,
  const ContactSumsRequest& request, const Executor& executor, Progress& progress)
{
  return EndSums<count>(source, rows, terms, request, executor).run(progress);
}
}

ContactSums sum_ends(const EndSource& source, std::int64_t rows, const ContactTerms& terms,
  const ContactSumsRequest& request, const Executor& executor, Progress& progress)
{
  constexpr auto sums = []<std::size_t... i>(std::index_sequence<i...>)
  {
    return std::array{ &sum_terms<3 * i>... };
  }
  (std::make_index_sequence<EndTerms::most / 3 + 1>{});
  return sums[terms.count / 3](source, rows, terms, request, executor, progress);
}
}
