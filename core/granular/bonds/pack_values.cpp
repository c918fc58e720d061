// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/pack_values.h"

#include "granular/numbers/number_print.h"

namespace granular
{
void refuse_number(const std::string& expected, std::size_t particle, std::size_t at, double got)
{
  throw FormatError(
    "expected " + expected + " " + buffer_place(particle, at) + ", got " + to_text(got));
}

std::string buffer_place(std::size_t particle, std::size_t at)
{
  return "in double " + std::to_string(at) + " of the buffer, of its particle " +
    std::to_string(particle);
}

void expect_rows(const BondedParticles& particles, const ParticleRows& rows)
{
  if (const auto* const range = std::get_if<ParticleRange>(&rows))
  {
    if (range->first > particles.size() || range->count > particles.size() - range->first)
    {
      throw LimitError("expected rows of " + std::to_string(particles.size()) + " particles, got " +
        std::to_string(range->count) + " from " + std::to_string(range->first) + " on");
    }
    return;
  }
  for (const std::size_t row : std::get<ParticleList>(rows))
  {
    if (row >= particles.size())
    {
      throw LimitError("expected rows of " + std::to_string(particles.size()) +
        " particles, got row " + std::to_string(row));
    }
  }
}

void expect_size(std::size_t needed, std::size_t size)
{
  if (size != needed)
  {
    throw LimitError(
      "expected a buffer of " + std::to_string(needed) + " doubles, got " + std::to_string(size));
  }
}
}
