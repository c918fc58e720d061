// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/words.h"
#include "granular/formats/local/local_presets.h"
#include "granular/lines/minimum_image.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace granular
{
namespace
{
bool is_integral(double value) noexcept
{
  return std::isfinite(value) && value == std::nearbyint(value);
}

/// A rule for the numbers of a column; null: all are right.
using Rule = bool (*)(double);

Rule rule_of(std::string_view name) noexcept
{
  struct Entry
  {
    std::string_view name;
    Rule rule;
  };
  static constexpr Entry rules[] = {
    { "id1", [](double value) { return is_integral(value) && value >= 1; } },
    { "id2", [](double value) { return is_integral(value) && value >= 1; } },
    { "mesh", [](double value) { return is_integral(value) && value >= 0; } },
    { "triangle", [](double value) { return is_integral(value) && value >= 0; } },
    { "btype", [](double value) { return is_integral(value) && value != 0; } },
    { "periodic", [](double value) { return value == 0 || value == 1; } },
    { "dist", [](double value) { return value >= 0; } },
  };
  const auto* const found = std::ranges::find(rules, name, &Entry::name);
  return found == std::end(rules) ? nullptr : found->rule;
}

/// The rows of a sample as a preset sees them.
class PresetRows
{
public:
  PresetRows(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
    const LocalSample& sample)
    : names_(split_words(preset.columns))
    , columns_(columns)
    , all_(all)
    , sample_(sample)
  {
  }

  bool keep_rules() const
  {
    for (std::size_t i = 0; i < names_.size(); ++i)
    {
      const Rule rule = rule_of(names_[i]);
      if (rule &&
        !this->all_rows(
          [&](std::size_t row) { return rule(sample_.values[row * all_ + columns_[i]]); }))
      {
        return false;
      }
    }
    return true;
  }

  bool ends_differ() const
  {
    return !this->has("id1") || !this->has("id2") ||
      this->all_rows(
        [this](std::size_t row) { return this->value(row, "id1") != this->value(row, "id2"); });
  }

  bool few_types() const
  {
    std::set<double> types;
    for (std::size_t row = 0; this->has("btype") && !this->has("x1") && row < sample_.rows; ++row)
    {
      types.insert(this->value(row, "btype"));
    }
    return types.size() * types.size() <= sample_.rows;
  }

  /// Points between the ends are no forces; of few rows that says nothing.
  bool forces_are_no_points() const
  {
    constexpr std::size_t least_rows = 3;
    const auto is_between = [this](std::size_t row)
    {
      const Vector3 force = this->vector(row, "forcex", "forcey", "forcez");
      const Vector3 first = this->place(row, 1);
      const Vector3 second = this->place(row, 2);
      double length = 0;
      double apart = 0; // from the middle
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double middle = first[axis] + (second[axis] - first[axis]) / 2;
        length += (second[axis] - first[axis]) * (second[axis] - first[axis]);
        apart += (force[axis] - middle) * (force[axis] - middle);
      }
      return 4 * apart <= length;
    };
    return !this->has("forcex") || !this->has("x1") || sample_.rows < least_rows ||
      !this->all_rows(is_between);
  }

  bool flags_fit() const
  {
    const auto fits = [this](std::size_t row)
    {
      const Vector3 first = this->place(row, 1);
      const Vector3 second = this->place(row, 2);
      bool far = false;
      bool near_half = false; // either may be right
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double half = std::abs(sample_.box.vectors[axis][axis].value()) / 2;
        const double distance = std::abs(second[axis] - first[axis]);
        far = far || (is_periodic(sample_.box, axis) && distance > half);
        near_half = near_half || std::abs(distance - half) < 1e-3 * half;
      }
      return near_half || far == (this->value(row, "periodic") == 1);
    };
    return !this->has("periodic") || !this->has("x1") || !sample_.has_box || sample_.box.tilted ||
      this->all_rows(fits);
  }

  /// Places are printed with six digits, or more.
  bool places_fit() const
  {
    constexpr double digits = 2e-5;
    const MinimumImage images(sample_.box);
    std::map<double, Vector3> places;
    const auto fits = [&](std::size_t row, int end, std::string_view id)
    {
      const Vector3 here = this->place(row, end);
      const auto [place, is_new] = places.try_emplace(this->value(row, id), here);
      const Vector3& known = place->second;
      Vector3 apart = {};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        apart[axis] = here[axis] - known[axis];
      }
      const Vector3 shift = images.shift(images.find(apart));
      for (std::size_t axis = 0; axis < 3 && !is_new; ++axis)
      {
        const double most = std::max(std::abs(here[axis]), std::abs(known[axis]));
        if (!(std::abs(apart[axis] + shift[axis]) <= digits * (most + std::abs(shift[axis]))))
        {
          return false;
        }
      }
      return true;
    };
    return !this->has("x1") || !sample_.has_box ||
      this->all_rows(
        [&](std::size_t row)
        {
          return (!this->has("id1") || fits(row, 1, "id1")) &&
            (!this->has("id2") || fits(row, 2, "id2"));
        });
  }

private:
  bool has(std::string_view name) const { return std::ranges::find(names_, name) != names_.end(); }

  double value(std::size_t row, std::string_view name) const
  {
    const auto at = static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
    return sample_.values[row * all_ + columns_[at]];
  }

  Vector3 vector(std::size_t row, std::string_view x, std::string_view y, std::string_view z) const
  {
    return { this->value(row, x), this->value(row, y), this->value(row, z) };
  }

  Vector3 place(std::size_t row, int end) const
  {
    return end == 1 ? this->vector(row, "x1", "y1", "z1") : this->vector(row, "x2", "y2", "z2");
  }

  template <class Fits>
  bool all_rows(const Fits& fits) const
  {
    std::size_t row = 0;
    while (row < sample_.rows && fits(row))
    {
      ++row;
    }
    return row == sample_.rows;
  }

  std::vector<std::string_view> names_;
  std::span<const std::size_t> columns_;
  std::size_t all_;
  const LocalSample& sample_;
};
}

bool fits(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
  const LocalSample& sample)
{
  const PresetRows rows(preset, columns, all, sample);
  return rows.keep_rules() && rows.ends_differ() && rows.few_types() &&
    rows.forces_are_no_points() && rows.flags_fit() && rows.places_fit();
}
}
