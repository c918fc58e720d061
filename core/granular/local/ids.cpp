// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/ids.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

namespace granular
{
namespace
{
constexpr std::size_t rows_per_chunk = 65536;
constexpr std::size_t some = 1024; // rows at once

[[noreturn]] void refuse(const std::string& value, std::int64_t row)
{
  throw Error("expected a 64-bit integer as id, got " + value + " in row " + std::to_string(row) +
    " (the first is 0)");
}

/// Integers of any type; only large ones of UInt64 do not fit.
void load_integers(const ValueSource& source, std::span<const std::int64_t> rows, std::int64_t* to)
{
  load_numbers(source, rows, to);
  for (std::size_t i = 0; source.type == ValueType::UInt64 && i < rows.size(); ++i)
  {
    if (to[i] < 0)
    {
      refuse(std::to_string(static_cast<std::uint64_t>(to[i])), rows[i]);
    }
  }
}

void load_integral(const ValueSource& source, std::span<const std::int64_t> rows, std::int64_t* to)
{
  std::array<double, some> values;
  load_numbers(source, rows, values.data());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const double value = values[i];
    if (!(value >= -0x1p63 && value < 0x1p63) || std::trunc(value) != value)
    {
      refuse(to_text(value), rows[i]);
    }
    to[i] = static_cast<std::int64_t>(value);
  }
}
}

Ids::Ids(const ArrayView& array, std::int64_t rows, const Executor& executor, Progress& progress)
try
{
  if (array.type == ValueType::Text || array.size() != 1)
  {
    throw Error(std::string("expected one number a row, got ") +
      (array.type == ValueType::Text ? "texts" : std::to_string(array.size())));
  }
  const ValueSource source = component_of(array, 0);
  if (source.type == ValueType::Int64 && source.step == 1)
  {
    values_ = { static_cast<const std::int64_t*>(source.data), static_cast<std::size_t>(rows) };
    return;
  }
  own_.resize(static_cast<std::size_t>(rows));
  values_ = own_;
  auto* const load = is_integer(source.type) ? load_integers : load_integral;
  executor.for_each_stretch(
    own_.size(), rows_per_chunk,
    [&](std::size_t row, std::size_t count, std::size_t)
    {
      std::array<std::int64_t, some> numbers;
      for (const std::size_t last = row + count; row < last; row += some)
      {
        const auto now = std::span(numbers).first(std::min(some, last - row));
        std::iota(now.begin(), now.end(), static_cast<std::int64_t>(row));
        load(source, now, own_.data() + row);
      }
    },
    progress);
}
catch (const Error& error)
{
  throw Error(error.text(), { {}, 0, -1, array.name });
}
}
