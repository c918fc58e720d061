// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/words.h"
#include "granular/formats/local/local_presets.h"
#include "granular/lines/minimum_image.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace granular
{
namespace
{
bool is_integral(double value) noexcept
{
  return std::isfinite(value) && value == std::nearbyint(value);
}

/// A rule for the numbers of a column.
struct Rule
{
  std::string_view name;
  bool (*holds)(double);
  const char* expected;
};

constexpr auto is_count = [](double value) { return is_integral(value) && value >= 1; };
constexpr auto is_number = [](double value) { return is_integral(value) && value >= 0; };
constexpr auto is_positive = [](double value) { return value >= 0; };

constexpr Rule rules[] = {
  { "id1", is_count, "whole numbers from 1" },
  { "id2", is_count, "whole numbers from 1" },
  { "mesh", is_number, "whole numbers from 0" },
  { "triangle", is_number, "whole numbers from 0" },
  { "btype", [](double value) { return is_integral(value) && value != 0; }, "whole numbers but 0" },
  { "periodic", [](double value) { return value == 0 || value == 1; }, "0 and 1" },
  { "dist", is_positive, "no negative numbers" },
  { "ms_id1", is_integral, "whole numbers" },
  { "ms_id2", is_integral, "whole numbers" },
  { "contact_area", is_positive, "no negative numbers" },
};

/// A column whose values are not what its name says.
struct Contradiction
{
  std::size_t column = 0;
  std::string text = {}; ///< "whole numbers, got 0.5"; empty: there is none
};

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

  /// The first column that breaks its rule.
  Contradiction broken_rule() const
  {
    for (const auto& [name, holds, expected] : rules)
    {
      for (std::size_t row = 0; this->has(name) && row < sample_.rows; ++row)
      {
        if (const double value = this->value(row, name); !holds(value))
        {
          return { this->place_of(name), std::string(expected) + ", got " + to_text(value) };
        }
      }
    }
    return {};
  }

  /// Contact points lie between the ends, but for those at images of these.
  bool contact_points_fit() const
  {
    std::size_t whole = 0; // lines
    const auto is_apart = [&](std::size_t row)
    {
      const bool split = this->has("periodic") && this->value(row, "periodic") != 0;
      whole += split ? 0 : 1;
      return split || !this->is_between(row, "contact_pointx", "contact_pointy", "contact_pointz");
    };
    return !this->has("contact_pointx") || !this->has("contact_pointz") || !this->has("x1") ||
      !this->all_rows(is_apart) || whole == 0;
  }

  /// The column that the preset gives that name.
  std::size_t place_of(std::string_view name) const
  {
    return columns_[static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin())];
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
    return !this->has("forcex") || !this->has("x1") || sample_.rows < least_rows ||
      !this->all_rows(
        [this](std::size_t row) { return this->is_between(row, "forcex", "forcey", "forcez"); });
  }

  /// Forces push most particles apart, which torques do not; of few rows that says nothing.
  bool forces_push() const
  {
    constexpr std::size_t least_rows = 10;
    double along = 0; // the line, away from the other particle or the wall
    double all = 0;
    for (std::size_t row = 0; this->has("forcex") && this->has("x1") && row < sample_.rows; ++row)
    {
      const Vector3 force = this->vector(row, "forcex", "forcey", "forcez");
      const Vector3 first = this->place(row, this->has("mesh") ? 2 : 1);
      const Vector3 second = this->place(row, this->has("mesh") ? 1 : 2);
      const Vector3 line = { first[0] - second[0], first[1] - second[1], first[2] - second[2] };
      const double length = std::hypot(line[0], line[1], line[2]);
      if (length > 0 && !(this->has("periodic") && this->value(row, "periodic") != 0))
      {
        along += (force[0] * line[0] + force[1] * line[1] + force[2] * line[2]) / length;
        all += std::hypot(force[0], force[1], force[2]);
      }
    }
    return sample_.rows >= least_rows && along > all / 2;
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
    return sample_.values[row * all_ + this->place_of(name)];
  }

  /// Returns true if a point is in the sphere around the middle that both ends lie on.
  bool is_between(std::size_t row, std::string_view x, std::string_view y, std::string_view z) const
  {
    const Vector3 point = this->vector(row, x, y, z);
    const Vector3 first = this->place(row, 1);
    const Vector3 second = this->place(row, 2);
    double length = 0;
    double apart = 0; // from the middle
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double middle = first[axis] + (second[axis] - first[axis]) / 2;
      length += (second[axis] - first[axis]) * (second[axis] - first[axis]);
      apart += (point[axis] - middle) * (point[axis] - middle);
    }
    return 4 * apart <= length;
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
  return rows.broken_rule().text.empty() && rows.ends_differ() && rows.few_types() &&
    rows.forces_are_no_points() && rows.flags_fit() && rows.places_fit();
}

bool are_forces(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
  const LocalSample& sample)
{
  return PresetRows(preset, columns, all, sample).forces_push();
}

void check_history(const std::vector<std::string>& columns, const std::vector<std::string>& names,
  const LocalSample& sample)
{
  const std::string all = join_words(names);
  std::vector<std::size_t> places(names.size());
  std::iota(places.begin(), places.end(), std::size_t{ 0 });
  const PresetRows rows({ {}, all }, places, places.size(), sample);
  Contradiction found = rows.broken_rule();
  if (found.text.empty() && !rows.contact_points_fit())
  {
    found = { rows.place_of("contact_pointx"), "points between the ends, got none" };
  }
  if (!found.text.empty())
  {
    const auto left = std::ranges::count_if(
      names, [](const std::string& name) { return name.starts_with("history"); });
    throw FormatError("expected " + found.text + ", in the column " + columns[found.column] +
      " that is taken for " + names[found.column] +
      ": history in ColumnMap stands for the columns that are left, here " + std::to_string(left) +
      "; the last columns of the compute may not be in the file");
  }
}
}
