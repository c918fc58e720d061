// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/bonded_particles.h"

#include <algorithm>
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

/// Memory that is not touched before there are particles in it.
template <class T>
void allocate(std::unique_ptr<T[]>& array, std::size_t elements)
{
  array = elements > 0 ? std::make_unique_for_overwrite<T[]>(elements) : nullptr;
}

template <class T>
constexpr std::size_t element_bytes(const std::unique_ptr<T[]>&) noexcept
{
  return sizeof(T);
}

/// All bits zero, which is 0 of what is here. Of many bytes faster than a loop: what is overwritten is not read.
template <class T>
void fill_zero(T* to, std::size_t elements) noexcept
{
  static_assert(std::is_trivially_copyable_v<T>);
  std::memset(static_cast<void*>(to), 0, elements * sizeof(T));
}
}

BondedParticles::BondedParticles(std::int32_t most_bonds, std::int32_t history_values)
  : most_bonds_(most_bonds)
  , history_values_(history_values)
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
}

BondedParticles::BondedParticles(BondedParticles&& other) noexcept
  : most_bonds_(other.most_bonds_)
  , history_values_(other.history_values_)
  , size_(std::exchange(other.size_, 0))
  , capacity_(std::exchange(other.capacity_, 0))
  , arrays_(std::move(other.arrays_))
{
}

BondedParticles& BondedParticles::operator=(BondedParticles&& other) noexcept
{
  most_bonds_ = other.most_bonds_;
  history_values_ = other.history_values_;
  size_ = std::exchange(other.size_, 0); // of its own: 0, then what it was
  capacity_ = std::exchange(other.capacity_, 0);
  arrays_ = std::move(other.arrays_);
  return *this;
}

/// The one list of what there is: fields in the order of PackField, then bonds.
template <class Visit>
void BondedParticles::for_arrays(const Visit& visit) const
{
  for (const auto array : { &Arrays::x, &Arrays::v, &Arrays::f, &Arrays::x_mol, &Arrays::v_mol })
  {
    visit(array, 1);
  }
  visit(&Arrays::tag, 1);
  visit(&Arrays::type, 1);
  visit(&Arrays::mask, 1);
  visit(&Arrays::image, 1);
  visit(&Arrays::molecule, 1);
  visit(&Arrays::bonds, 1);
  visit(&Arrays::bond_types, this->width());
  visit(&Arrays::partners, this->width());
  visit(&Arrays::history, this->history_width());
}

std::size_t BondedParticles::row_bytes() const noexcept
{
  std::size_t bytes = 0;
  this->for_arrays(
    [&](auto array, std::size_t width) { bytes += width * element_bytes(arrays_.*array); });
  return bytes;
}

void BondedParticles::expect_particle(std::size_t i) const
{
  if (i >= size_)
  {
    throw LimitError(
      "expected a particle below " + std::to_string(size_) + ", got " + std::to_string(i));
  }
}

std::size_t BondedParticles::most_particles() const noexcept
{
  return static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()) / this->row_bytes();
}

void BondedParticles::grow(std::size_t capacity)
{
  const std::size_t most = this->most_particles();
  if (capacity == 0)
  {
    capacity = capacity_ + growth;
  }
  if (capacity < size_ || capacity > most)
  {
    throw LimitError("expected room for " + std::to_string(size_) + " to " + std::to_string(most) +
      " particles, got " + std::to_string(capacity));
  }
  Arrays grown;
  this->for_arrays(
    [&](auto array, std::size_t width)
    {
      allocate(grown.*array, capacity * width);
      std::copy_n((arrays_.*array).get(), size_ * width, (grown.*array).get());
    });
  arrays_ = std::move(grown);
  capacity_ = capacity;
}

void BondedParticles::reserve(std::size_t size)
{
  if (size > capacity_)
  {
    const std::size_t more = capacity_ + std::max(growth, capacity_ / 2);
    this->grow(std::max(size, std::min(more, this->most_particles())));
  }
}

void BondedParticles::set_defaults(
  std::size_t first, std::size_t end, PackFieldSet written) noexcept
{
  constexpr unsigned bonds = static_cast<unsigned>(PackField::Molecule) + 1;
  unsigned place = 0;
  this->for_arrays(
    [&](auto array, std::size_t)
    {
      if (place <= bonds && (written >> place & 1) == 0) // set_bonds clears what is behind
      {
        fill_zero((arrays_.*array).get() + first, end - first);
      }
      ++place;
    });
  if ((written & set_of(PackField::Mask)) == 0)
  {
    std::fill_n(arrays_.mask.get() + first, end - first, 1);
  }
}

void BondedParticles::resize(std::size_t size, PackFieldSet written)
{
  this->reserve(size);
  if (size > size_)
  {
    this->set_defaults(size_, size, written);
  }
  size_ = size;
}

std::size_t BondedParticles::add(std::int32_t type, const Vector3& x)
{
  const Vector3 place = x; // may be of this object
  this->resize(size_ + 1);
  arrays_.type[size_ - 1] = type;
  arrays_.x[size_ - 1] = place;
  return size_ - 1;
}

void BondedParticles::add_bond(
  std::size_t i, std::int32_t type, std::int64_t partner, std::span<const double> history)
{
  this->expect_particle(i);
  if (history.size() != this->values())
  {
    throw LimitError("expected " + std::to_string(history_values_) +
      " history values of a bond, got " + std::to_string(history.size()));
  }
  const std::size_t bond = this->count(i);
  this->set_bonds(i, bond + 1);
  this->bond_types(i)[bond] = type;
  this->partners(i)[bond] = partner;
  std::ranges::copy(
    history, this->history(i).begin() + static_cast<std::ptrdiff_t>(bond * this->values()));
}

void BondedParticles::set_bonds(std::size_t i, std::size_t count)
{
  this->expect_particle(i);
  if (count > this->width())
  {
    throw LimitError("expected at most " + std::to_string(most_bonds_) + " bonds of particle " +
      std::to_string(i) + ", got " + std::to_string(count));
  }
  const std::size_t old = this->count(i);
  arrays_.bonds[i] = static_cast<std::int32_t>(count);
  if (count > old)
  {
    std::fill_n(this->bond_types(i).data() + old, count - old, 0);
    std::fill_n(this->partners(i).data() + old, count - old, 0);
    std::fill_n(
      this->history(i).data() + old * this->values(), (count - old) * this->values(), 0.0);
  }
}

void BondedParticles::remove(std::size_t i)
{
  this->expect_particle(i);
  const std::size_t last = size_ - 1;
  if (i < last)
  {
    this->for_arrays(
      [&](auto array, std::size_t width)
      {
        auto* const rows = (arrays_.*array).get();
        std::copy_n(rows + last * width, width, rows + i * width);
      });
  }
  size_ = last;
}

BondedMemory BondedParticles::memory() const noexcept
{
  const std::size_t vectors = 5 * sizeof(Vector3);
  const std::size_t integers = (4 + this->width()) * sizeof(std::int32_t);
  const std::size_t history = this->history_width() * sizeof(double);
  return { capacity_ * (vectors + integers + history), capacity_ * this->row_bytes() };
}
}
