// SPDX-License-Identifier: BSD-3-Clause
#include "communicator_checks.h"

#include "granular/common/progress.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <exception>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using granular::Communicator;

/// Bytes that tell where they come from and where they belong: any mix-up shows.
std::string pattern(std::size_t size, int from, int to)
{
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i)
  {
    bytes[i] = static_cast<char>(7 * from + 31 * to + static_cast<int>(i % 251));
  }
  return bytes;
}

/// What an agreement came to, as "kind: what it says".
std::string outcome(Communicator& ranks, const std::exception_ptr& failure)
{
  try
  {
    granular::agree(ranks, failure);
    return "nothing";
  }
  catch (const granular::Cancelled&)
  {
    return "cancelled";
  }
  catch (const granular::IoError& error)
  {
    return std::string("io: ") + error.what() + " [" +
      std::make_error_code(error.code()).message() + "]";
  }
  catch (const granular::FormatError& error)
  {
    return std::string("format: ") + error.what();
  }
  catch (const granular::LimitError& error)
  {
    return std::string("limit: ") + error.what();
  }
  catch (const granular::UnsupportedError& error)
  {
    return std::string("unsupported: ") + error.what();
  }
  catch (const granular::Error& error)
  {
    return std::string("error: ") + error.what();
  }
}

struct Kind
{
  std::exception_ptr failure;
  std::string before; ///< the rank is named
  std::string after;
};

std::vector<Kind> kinds()
{
  using std::make_exception_ptr;
  const granular::Where line{ "grains.dump", 12, -1, "x" };
  const granular::Where byte{ "grains.bin", 0, std::int64_t{ 1 } << 40, "" };
  return {
    { make_exception_ptr(granular::IoError(
        "cannot open", { "a b/gone.dump" }, std::errc::no_such_file_or_directory)),
      "io: a b/gone.dump: cannot open", " [No such file or directory]" },
    { make_exception_ptr(granular::FormatError("expected a number, got 'y'", line)),
      "format: grains.dump:12: column 'x': expected a number, got 'y'", "" },
    { make_exception_ptr(granular::LimitError("expected less, got more", byte)),
      "limit: grains.bin@1099511627776: expected less, got more", "" },
    { make_exception_ptr(granular::UnsupportedError("expected what is known, got bzip2")),
      "unsupported: expected what is known, got bzip2", "" },
    { make_exception_ptr(granular::Error("expected sense", line)),
      "error: grains.dump:12: column 'x': expected sense", "" },
    { make_exception_ptr(std::bad_alloc()), "limit: out of memory", "" },
    { make_exception_ptr(std::runtime_error("something else")), "error: something else", "" },
    { make_exception_ptr(3), "error: an exception of an unknown kind", "" },
  };
}

std::string told(const Kind& kind, int rank, int size)
{
  return kind.before + " (on rank " + std::to_string(rank) + " of " + std::to_string(size) + ")" +
    kind.after;
}
}

void check_broadcast(Communicator& ranks)
{
  for (int root = 0; root < ranks.size(); ++root)
  {
    for (const std::size_t size : std::vector<std::size_t>{ 0, 1, 8, 9, 1000 })
    {
      const bool is_root = ranks.rank() == root;
      std::string bytes = is_root ? pattern(size, root, 0) : std::string(77, 'x');
      ranks.broadcast(bytes, root);
      EXPECT_EQ(bytes, pattern(size, root, 0)) << root << ' ' << size;
    }
  }
}

void check_all_gather(Communicator& ranks)
{
  for (const std::size_t size : std::vector<std::size_t>{ 0, 1, 3, 1000 })
  {
    // each of another size, and some of none
    const auto size_of = [&](int rank) { return size * static_cast<std::size_t>(rank % 3); };
    const std::vector<std::string> all =
      ranks.all_gather(pattern(size_of(ranks.rank()), ranks.rank(), 0));
    ASSERT_EQ(all.size(), static_cast<std::size_t>(ranks.size()));
    for (int rank = 0; rank < ranks.size(); ++rank)
    {
      EXPECT_EQ(all[static_cast<std::size_t>(rank)], pattern(size_of(rank), rank, 0)) << size;
    }
  }
}

void check_sum(Communicator& ranks)
{
  const std::int64_t size = ranks.size();
  std::vector<std::int64_t> none;
  ranks.sum(none);
  EXPECT_TRUE(none.empty());

  // beyond what a double holds
  const std::int64_t large = (std::int64_t{ 1 } << 60) + 1;
  std::vector<std::int64_t> values(100);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = ranks.rank() * static_cast<std::int64_t>(i);
  }
  values[99] = ranks.rank() == 0 ? large : -1;
  ranks.sum(values);
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
  {
    EXPECT_EQ(values[i], size * (size - 1) / 2 * static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(values[99], large - (size - 1));
}

void check_exchange(Communicator& ranks)
{
  for (const std::size_t unit : std::vector<std::size_t>{ 0, 1, 5, 1000 })
  {
    const auto size_of = [&](int from, int to)
    { return unit * static_cast<std::size_t>((from + 2 * to) % 4); };
    std::string from;
    std::string expected;
    std::vector<std::int64_t> from_bytes;
    std::vector<std::int64_t> to_bytes;
    for (int other = 0; other < ranks.size(); ++other)
    {
      const std::size_t out = size_of(ranks.rank(), other);
      const std::size_t in = size_of(other, ranks.rank());
      from += pattern(out, ranks.rank(), other);
      expected += pattern(in, other, ranks.rank());
      from_bytes.push_back(static_cast<std::int64_t>(out));
      to_bytes.push_back(static_cast<std::int64_t>(in));
    }
    std::string to(expected.size(), 'x');
    ranks.exchange(from.data(), from_bytes, to.data(), to_bytes);
    EXPECT_EQ(to, expected) << unit;
  }
}

void check_agree(Communicator& ranks)
{
  const int size = ranks.size();
  const auto cancelled = std::make_exception_ptr(granular::Cancelled{});
  EXPECT_EQ(outcome(ranks, nullptr), "nothing");
  const std::vector<Kind> all = kinds();
  for (int rank = 0; rank < size; ++rank)
  {
    const auto mine = [&](const std::exception_ptr& failure)
    { return ranks.rank() == rank ? failure : nullptr; };
    EXPECT_EQ(outcome(ranks, mine(cancelled)), "cancelled");
    for (const Kind& kind : all)
    {
      EXPECT_EQ(outcome(ranks, mine(kind.failure)), told(kind, rank, size));
      EXPECT_EQ(outcome(ranks, nullptr), "nothing") << "an error lasts";

      // all others were cancelled: that is not what matters
      EXPECT_EQ(
        outcome(ranks, ranks.rank() == rank ? kind.failure : cancelled), told(kind, rank, size));
    }

    // this rank and all that follow: the lowest is told
    const std::size_t own = static_cast<std::size_t>(ranks.rank()) % all.size();
    const std::size_t lowest = static_cast<std::size_t>(rank) % all.size();
    EXPECT_EQ(outcome(ranks, ranks.rank() >= rank ? all[own].failure : nullptr),
      told(all[lowest], rank, size));
  }
}

void check_send(Communicator& ranks)
{
  std::string bytes;
  EXPECT_THROW(ranks.send("x", ranks.rank()), std::logic_error);
  EXPECT_THROW(ranks.receive(bytes, ranks.rank()), std::logic_error);
  for (int from = 0; from < ranks.size(); ++from)
  {
    for (int to = 0; to < ranks.size(); ++to)
    {
      for (const std::size_t size : std::vector<std::size_t>{ 0, 1, 8, 9, 1000, 100'000 })
      {
        if (from == to)
        {
          continue;
        }
        if (ranks.rank() == from)
        {
          ranks.send(pattern(size, from, to), to);
          ranks.send("next", to); // the order stays
        }
        else if (ranks.rank() == to)
        {
          bytes = std::string(77, 'x');
          ranks.receive(bytes, from);
          EXPECT_TRUE(bytes == pattern(size, from, to)) << from << ' ' << to << ' ' << size;
          ranks.receive(bytes, from);
          EXPECT_EQ(bytes, "next");
        }
      }
    }
  }
}

void check_send_without_memory(Communicator& ranks)
{
#ifdef GRANULAR_TEST_SANITIZED
  return; // a sanitizer ends the program instead
#endif
  constexpr std::size_t too_much = std::size_t{ 1 } << 60; // bytes, which nobody looks at
  std::string bytes;
  for (int from = 1; from < ranks.size(); ++from)
  {
    if (ranks.rank() == from)
    {
      ranks.send({ bytes.data(), too_much }, 0);
      ranks.send("next", 0);
    }
    else if (ranks.rank() == 0)
    {
      EXPECT_THROW(ranks.receive(bytes, from), std::bad_alloc);
      ranks.receive(bytes, from);
      EXPECT_EQ(bytes, "next");
    }
  }
}
