// SPDX-License-Identifier: BSD-3-Clause
// Frame after frame of output arrays, each filled once: memory from a pool against fresh memory,
// and both against memory that was touched before.
#include "bench.h"

#include "granular/memory/block.h"
#include "granular/memory/block_pool.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <utility>

#include <malloc.h>

namespace bench
{
namespace
{
using granular::Block;
using granular::BlockPool;

/// Bytes a row of the arrays that 12 columns become: points, v, f, id, type and radius.
constexpr std::size_t widths[] = { 24, 24, 24, 8, 4, 8 };

/// Rows that a decoder takes at a time.
constexpr std::size_t batch_rows = 2048;

/// Memory and who frees it.
struct Memory
{
  void* data = nullptr;
  std::function<void(void*)> free;
};

/// Gives memory for an array; the rows as well, for who keeps it.
using Source = std::function<Memory(std::size_t bytes)>;

/// The arrays of a frame.
class Frame
{
public:
  Frame() = default;

  Frame(std::size_t rows, const Source& source)
    : rows_(rows)
  {
    for (const std::size_t width : widths)
    {
      arrays_.push_back(source(width * rows));
    }
  }

  Frame(Frame&& other) noexcept { *this = std::move(other); }

  Frame& operator=(Frame&& other) noexcept
  {
    std::swap(rows_, other.rows_);
    std::swap(arrays_, other.arrays_);
    return *this;
  }

  ~Frame()
  {
    for (const Memory& array : arrays_)
    {
      array.free(array.data);
    }
  }

  /// Every 4 bytes of an array another number, in the order in which rows are decoded.
  void fill(std::uint32_t seed)
  {
    for (std::size_t row = 0; row < rows_; row += batch_rows)
    {
      for (std::size_t i = 0; i < arrays_.size(); ++i)
      {
        const std::size_t words = widths[i] / 4;
        auto* const numbers = static_cast<std::uint32_t*>(arrays_[i].data);
        const std::size_t end = std::min(rows_, row + batch_rows) * words;
        for (std::size_t k = row * words; k < end; ++k)
        {
          numbers[k] = static_cast<std::uint32_t>(k) + seed;
        }
      }
    }
  }

  bool holds(std::uint32_t seed) const
  {
    for (std::size_t i = 0; i < arrays_.size(); ++i)
    {
      const auto* const numbers = static_cast<const std::uint32_t*>(arrays_[i].data);
      for (std::size_t k = 0; k < rows_ * widths[i] / 4; ++k)
      {
        if (numbers[k] != static_cast<std::uint32_t>(k) + seed)
        {
          return false;
        }
      }
    }
    return true;
  }

private:
  std::size_t rows_ = 0;
  std::vector<Memory> arrays_;
};

Memory malloc_memory(std::size_t bytes)
{
  void* const data = std::malloc(bytes);
  if (!data)
  {
    throw std::bad_alloc();
  }
  return { data, std::free };
}

/// Frames one after the other; the last one is held until the next is there, as a pipeline does.
class Run
{
public:
  Run(std::size_t rows, Source source, std::shared_ptr<BlockPool> pool = nullptr)
    : rows_(rows)
    , source_(std::move(source))
    , pool_(std::move(pool))
  {
  }

  void next()
  {
    if (pool_)
    {
      pool_->next_frame();
    }
    Frame frame(rows_, source_);
    frame.fill(++seed_);
    shown_ = std::move(frame);
  }

  bool check() const { return shown_.holds(seed_); }

  /// Page faults of a frame.
  double faults()
  {
    const std::int64_t before = page_faults();
    this->next();
    return static_cast<double>(page_faults() - before);
  }

private:
  std::size_t rows_;
  Source source_;
  std::shared_ptr<BlockPool> pool_;
  Frame shown_;
  std::uint32_t seed_ = 0;
};

Source block_source(const std::shared_ptr<BlockPool>& pool)
{
  return [pool](std::size_t bytes) { return Memory{ Block(bytes, pool).release(), Block::free }; };
}

/// Two sets of arrays in turns, never freed while it lives.
Source kept_source(std::size_t rows)
{
  std::vector<std::shared_ptr<void>> all;
  for (std::size_t i = 0; i < 2 * std::size(widths); ++i)
  {
    const std::size_t bytes = widths[i % std::size(widths)] * rows;
    all.emplace_back(Block(bytes).release(), Block::free);
  }
  return [all, next = std::size_t{ 0 }](std::size_t) mutable {
    return Memory{ all[next++ % all.size()].get(), [](void*) {} };
  };
}

void frames(benchmark::State& state, std::size_t rows, int repeats, bool tuned)
{
  // the thresholds that malloc starts with, or so high that nothing goes back to the system, as
  // MALLOC_MMAP_THRESHOLD_ and MALLOC_TRIM_THRESHOLD_ do it; left alone it moves them as it goes
  ::mallopt(M_MMAP_THRESHOLD, tuned ? 32 << 20 : 128 << 10);
  ::mallopt(M_TRIM_THRESHOLD, tuned ? 2'000'000'000 : 128 << 10);
  const auto pool = std::make_shared<BlockPool>(std::size_t{ 1 } << 32);
  std::pair<const char*, Run> runs[] = {
    { "touched", Run(rows, kept_source(rows)) },
    { "pool", Run(rows, block_source(pool), pool) },
    { "fresh", Run(rows, block_source(nullptr)) },
    { "malloc", Run(rows, malloc_memory) },
  };
  Rounds rounds;
  for (auto& [name, run] : runs)
  {
    for (int frame = 0; frame < 3; ++frame)
    {
      run.next();
      if (!run.check())
      {
        fail(state, std::string(name) + ": the arrays do not hold what was written");
        return;
      }
    }
    rounds.add(name,
      [&each = run]
      {
        each.next();
        return true;
      });
  }
  for (auto _ : state)
  {
    if (!rounds.run(static_cast<double>(rows), repeats))
    {
      return;
    }
    state.SetIterationTime(rounds.of("pool").back() * static_cast<double>(rows));
  }
  for (auto& [name, run] : runs)
  {
    tell(state, name, 1e9 * median(rounds.of(name)), "ns/row");
    tell(state, std::string(name) + " against touched",
      median_ratio(rounds.of(name), rounds.of("touched")), "1");
    tell(state, std::string(name) + ", page faults a frame", run.faults(), "1");
  }
  tell(state, "spread", spread_of_ratio(rounds.of("pool"), rounds.of("touched")), "1");
}
}

void add_benchmarks(const Size& size)
{
  const struct
  {
    const char* name;
    std::int64_t rows;
    int repeats;
  } cases[] = { { "10^4 rows", 10'000, 100 }, { "10^5 rows", 100'000, 10 },
    { "10^6 rows", size.pick(1'000'000, 300'000), 1 },
    { "3x10^6 rows", size.pick(3'000'000, 300'000), 1 } };
  for (const bool tuned : { false, true })
  {
    for (const auto& each : cases)
    {
      add(std::string("pool/") + each.name + (tuned ? ", malloc tuned" : ""), size.pick(31, 1),
        [each, tuned, repeats = static_cast<int>(size.pick(each.repeats, 1))](
          benchmark::State& state)
        { frames(state, static_cast<std::size_t>(each.rows), repeats, tuned); });
    }
  }
}
}
