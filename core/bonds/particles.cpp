// SPDX-License-Identifier: BSD-3-Clause
#include "particles.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t most_row_values = std::int64_t{ 1 } << 40;
constexpr std::size_t growth = 10000;

template <class T>
constexpr std::size_t element_bytes(T* granular_bonds_arrays::*) noexcept
{
  return sizeof(T);
}

/// Elements of an array as bytes. The numbers of bonds are constant for users alone.
template <class T>
void* bytes_at(const T* array, std::size_t element) noexcept
{
  return const_cast<T*>(array + element);
}
}

BondedParticles::BondedParticles(std::int32_t most_bonds, std::int32_t history_values)
{
  if (most_bonds < 1)
  {
    throw LimitError(
      "expected room for at least 1 bond a particle, got " + std::to_string(most_bonds));
  }
  if (history_values < 0)
  {
    throw LimitError(
      "expected at least 0 history values a bond, got " + std::to_string(history_values));
  }
  if (history_values > most_row_values / most_bonds)
  {
    throw LimitError("expected at most " + std::to_string(most_row_values) +
      " history values a particle, got " + std::to_string(most_bonds) + " times " +
      std::to_string(history_values));
  }
  arrays_.most_bonds = most_bonds;
  arrays_.history_values = history_values;
}

template <class Visit>
void BondedParticles::for_arrays(const Visit& visit) const
{
  const std::size_t bonds = this->most_bonds();
  const std::size_t widths[] = { 3, 3, 3, 3, 3, 1, 1, bonds, bonds * this->history_values(), 1, 1,
    3, 1, bonds };
  const std::size_t* width = widths;
  std::apply([&](auto... array) { (visit(array, *width++), ...); }, bond_arrays);
}

std::size_t BondedParticles::row_bytes() const noexcept
{
  std::size_t bytes = 0;
  this->for_arrays([&](auto array, std::size_t width) { bytes += width * element_bytes(array); });
  return bytes;
}

std::size_t BondedParticles::most_particles() const noexcept
{
  return static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()) / this->row_bytes();
}

void BondedParticles::expect_row(std::size_t row) const
{
  if (row >= arrays_.size)
  {
    throw BadBondArgument(
      "expected a particle below " + std::to_string(arrays_.size) + ", got " + std::to_string(row));
  }
}

void BondedParticles::grow(std::size_t capacity)
{
  const std::size_t most = this->most_particles();
  if (capacity == 0)
  {
    capacity = arrays_.capacity + growth;
  }
  if (capacity < arrays_.size || capacity > most)
  {
    throw LimitError("expected room for " + std::to_string(arrays_.size) + " to " +
      std::to_string(most) + " particles, got " + std::to_string(capacity));
  }
  // memory that is not touched before there are particles in it
  auto memory = std::make_unique_for_overwrite<std::byte[]>(capacity * this->row_bytes());
  granular_bonds_arrays grown = arrays_;
  std::byte* next = memory.get();
  this->for_arrays(
    [&](auto array, std::size_t width)
    {
      void* const to = next;
      grown.*array = static_cast<std::remove_reference_t<decltype(grown.*array)>>(to);
      const std::size_t bytes = width * element_bytes(array);
      if (arrays_.size > 0)
      {
        std::memcpy(to, arrays_.*array, bytes * arrays_.size);
      }
      next += bytes * capacity;
    });
  const std::size_t described =
    5 * 24 + 4 * (4 + this->most_bonds()) + 8 * this->most_bonds() * this->history_values();
  grown.capacity = capacity;
  grown.memory = capacity * this->row_bytes();
  grown.described = capacity * described;
  arrays_ = grown;
  memory_ = std::move(memory);
}

void BondedParticles::resize(std::size_t size, std::uint32_t written)
{
  const std::size_t old = arrays_.size;
  if (size > arrays_.capacity)
  {
    const std::size_t more = arrays_.capacity + std::max(growth, arrays_.capacity / 2);
    this->grow(std::max(size, std::min(more, this->most_particles())));
  }
  arrays_.size = size;
  if (size <= old)
  {
    return;
  }
  written |= set_of(BondField::Partners, BondField::History, BondField::BondTypes); // by set_bonds
  unsigned field = 0;
  this->for_arrays(
    [&](auto array, std::size_t width)
    {
      if ((written >> field++ & 1) == 0)
      {
        std::memset(
          bytes_at(arrays_.*array, old * width), 0, (size - old) * width * element_bytes(array));
      }
    });
  if ((written & set_of(BondField::Mask)) == 0)
  {
    std::fill(arrays_.mask + old, arrays_.mask + size, 1);
  }
}

std::size_t BondedParticles::add(std::int32_t type, const double* x)
{
  const std::array place = { x[0], x[1], x[2] }; // may be of this object, which grows
  const std::size_t row = arrays_.size;
  this->resize(row + 1);
  arrays_.type[row] = type;
  std::ranges::copy(place, arrays_.x + 3 * row);
  return row;
}

void BondedParticles::add_bond(
  std::size_t row, std::int32_t type, std::int64_t partner, const double* history)
{
  this->expect_row(row);
  const std::size_t bond = this->bonds(row);
  this->set_bonds(row, bond + 1);
  this->bond_types(row)[bond] = type;
  this->partners(row)[bond] = partner;
  const std::size_t values = this->history_values();
  std::copy_n(history, values, this->history(row) + bond * values);
}

void BondedParticles::set_bonds(std::size_t row, std::size_t count)
{
  this->expect_row(row);
  if (count > this->most_bonds())
  {
    throw LimitError("expected at most " + std::to_string(arrays_.most_bonds) +
      " bonds of particle " + std::to_string(row) + ", got " + std::to_string(count));
  }
  const std::size_t old = this->bonds(row);
  const_cast<std::int32_t*>(arrays_.bonds)[row] = static_cast<std::int32_t>(count);
  if (count > old)
  {
    const std::size_t more = count - old;
    std::fill_n(this->bond_types(row) + old, more, 0);
    std::fill_n(this->partners(row) + old, more, 0);
    const std::size_t values = this->history_values();
    std::fill_n(this->history(row) + old * values, more * values, 0.0);
  }
}

void BondedParticles::remove(std::size_t row)
{
  this->expect_row(row);
  const std::size_t last = arrays_.size - 1;
  this->for_arrays(
    [&](auto array, std::size_t width)
    {
      std::memmove(bytes_at(arrays_.*array, row * width), arrays_.*array + last * width,
        width * element_bytes(array));
    });
  arrays_.size = last;
}
}
