// SPDX-License-Identifier: BSD-3-Clause
#include "granular_bonds.h"

#include "packing.h"

#include <exception>
#include <new>
#include <string>

struct granular_bonds : granular::BondedParticles
{
  using BondedParticles::BondedParticles;
};

namespace
{
using granular::BadBondArgument;

constexpr granular_bonds_form usual_form = { 0, 0, 10 };

thread_local std::string last_error;

granular_bonds_status keep_error(granular_bonds_status status, const char* text) noexcept
{
  try
  {
    last_error = text;
    return status;
  }
  catch (const std::bad_alloc&)
  {
    last_error.clear();
    return GRANULAR_BONDS_NO_MEMORY;
  }
}

/// Runs the body of a function, and turns an exception into a status and the last error of the thread.
template <class Body>
granular_bonds_status guarded(const Body& body) noexcept
{
  try
  {
    body();
    return GRANULAR_BONDS_OK;
  }
  catch (const BadBondArgument& error)
  {
    return keep_error(GRANULAR_BONDS_BAD_ARGUMENT, error.what());
  }
  catch (const granular::FormatError& error)
  {
    return keep_error(GRANULAR_BONDS_FORMAT_ERROR, error.what());
  }
  catch (const granular::LimitError& error)
  {
    return keep_error(GRANULAR_BONDS_LIMIT_ERROR, error.what());
  }
  catch (const granular::UnsupportedError& error)
  {
    return keep_error(GRANULAR_BONDS_UNSUPPORTED, error.what());
  }
  catch (const std::bad_alloc&)
  {
    return keep_error(GRANULAR_BONDS_NO_MEMORY, "out of memory");
  }
  catch (const std::exception& error)
  {
    return keep_error(GRANULAR_BONDS_OTHER_ERROR, error.what());
  }
}

template <class Pointer>
Pointer& needed(Pointer* pointer, const char* name)
{
  if (pointer == nullptr)
  {
    throw BadBondArgument(std::string("expected ") + name + ", got null");
  }
  return *pointer;
}

/// Returns the doubles at a pointer, which may be null if there are none.
std::span<const double> doubles_at(const double* pointer, std::size_t count, const char* name)
{
  return { count > 0 ? &needed(pointer, name) : pointer, count };
}

/// Sets *doubles, and returns true if a buffer is given, which must have room for them.
bool wants_packing(const double* buffer, std::size_t room, std::size_t size, std::size_t* doubles)
{
  needed(doubles, "doubles") = size;
  if (buffer != nullptr && room < size)
  {
    throw BadBondArgument(
      "expected room for " + std::to_string(size) + " doubles, got " + std::to_string(room));
  }
  return buffer != nullptr;
}
}

const char* granular_bonds_last_error(void)
{
  return last_error.c_str();
}

granular_bonds_status granular_bonds_create(
  int32_t most_bonds, int32_t history_values, granular_bonds** particles)
{
  return guarded(
    [&]
    {
      granular_bonds*& made = needed(particles, "particles");
      made = new granular_bonds(most_bonds, history_values);
    });
}

void granular_bonds_destroy(granular_bonds* particles)
{
  delete particles;
}

granular_bonds_status granular_bonds_grow(granular_bonds* particles, size_t capacity)
{
  return guarded([&] { needed(particles, "particles").grow(capacity); });
}

granular_bonds_status granular_bonds_resize(granular_bonds* particles, size_t size)
{
  return guarded([&] { needed(particles, "particles").resize(size); });
}

granular_bonds_status granular_bonds_add(
  granular_bonds* particles, int32_t type, const double x[3], size_t* row)
{
  return guarded(
    [&]
    {
      const size_t added = needed(particles, "particles").add(type, &needed(x, "x"));
      if (row != nullptr)
      {
        *row = added;
      }
    });
}

granular_bonds_status granular_bonds_add_bond(
  granular_bonds* particles, size_t row, int32_t type, int64_t partner, const double* history)
{
  return guarded(
    [&]
    {
      granular_bonds& all = needed(particles, "particles");
      all.add_bond(row, type, partner, doubles_at(history, all.history_values(), "history").data());
    });
}

granular_bonds_status granular_bonds_set_bonds(granular_bonds* particles, size_t row, int32_t bonds)
{
  return guarded(
    [&]
    {
      if (bonds < 0)
      {
        throw BadBondArgument("expected a number of bonds from 0, got " + std::to_string(bonds));
      }
      needed(particles, "particles").set_bonds(row, static_cast<size_t>(bonds));
    });
}

granular_bonds_status granular_bonds_remove(granular_bonds* particles, size_t row)
{
  return guarded([&] { needed(particles, "particles").remove(row); });
}

granular_bonds_status granular_bonds_view(granular_bonds* particles, granular_bonds_arrays* arrays)
{
  return guarded([&] { needed(arrays, "arrays") = needed(particles, "particles").arrays(); });
}

granular_bonds_status granular_bonds_pack(const granular_bonds* particles, int kind, size_t first,
  size_t count, const int32_t* list, const granular_bonds_shift* shift, double* buffer, size_t room,
  size_t* doubles)
{
  return guarded(
    [&]
    {
      const granular_bonds& all = needed(particles, "particles");
      const granular::BondRows rows{ first, count, list };
      if (wants_packing(buffer, room, packed_doubles(all, kind, rows), doubles))
      {
        pack(all, kind, rows, shift, buffer);
      }
    });
}

granular_bonds_status granular_bonds_unpack(granular_bonds* particles, int kind, size_t first,
  const int32_t* list, const double* buffer, size_t doubles, size_t* count)
{
  return guarded(
    [&]
    {
      const size_t unpacked = unpack(
        needed(particles, "particles"), kind, first, list, doubles_at(buffer, doubles, "buffer"));
      if (count != nullptr)
      {
        *count = unpacked;
      }
    });
}

granular_bonds_status granular_bonds_pack_record(const granular_bonds* particles, size_t row,
  const granular_bonds_form* form, const double* fixes, size_t fix_count, double* buffer,
  size_t room, size_t* doubles)
{
  return guarded(
    [&]
    {
      const granular_bonds& all = needed(particles, "particles");
      const auto of_fixes = doubles_at(fixes, fix_count, "fixes");
      if (wants_packing(buffer, room, record_doubles(all, row) + fix_count, doubles))
      {
        pack_record(all, row, form != nullptr ? *form : usual_form, of_fixes, buffer);
      }
    });
}

granular_bonds_status granular_bonds_unpack_record(granular_bonds* particles,
  const granular_bonds_form* form, size_t fix_count, const double* chunk, size_t chunk_doubles,
  size_t* doubles)
{
  return guarded(
    [&]
    {
      const size_t size = unpack_record(needed(particles, "particles"),
        form != nullptr ? *form : usual_form, fix_count, doubles_at(chunk, chunk_doubles, "chunk"));
      if (doubles != nullptr)
      {
        *doubles = size;
      }
    });
}
