// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/euler/euler_text.h"

#include "granular/numbers/number_print.h"
#include "granular/particles/rounding_loss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace granular
{
namespace
{
/// Writes tuples of numbers, one a line, and reports how many are done.
class TupleWriter
{
public:
  TupleWriter(std::string& text, EulerDialect dialect, std::size_t tuples, Progress& progress)
    : text_(text)
    , dialect_(dialect)
    , all_(static_cast<double>(std::max(tuples, std::size_t{ 1 })))
    , progress_(progress)
  {
  }

  void add(const std::vector<double>& values, std::size_t components)
  {
    std::array<char, most_fixed_chars + 1> word;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      char* const end = dialect_ == EulerDialect::Liggghts
        ? print_fixed(word.data(), values[i])
        : print_number(word.data(), values[i], { 0 });
      const bool last = (i + 1) % components == 0;
      *end = last ? '\n' : ' ';
      text_.append(word.data(), end + 1);
      if (last)
      {
        this->count();
      }
    }
  }

  /// One more is done.
  void count()
  {
    constexpr std::size_t lot = 16384;
    if (++done_ % lot == 0)
    {
      progress_.step(static_cast<double>(done_) / all_);
    }
  }

private:
  std::string& text_;
  EulerDialect dialect_;
  double all_;
  Progress& progress_;
  std::size_t done_ = 0;
};

/// The loss of six decimals in cells.
class DecimalLoss
{
public:
  explicit DecimalLoss(const EulerCells& cells)
    : cells_(cells)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->find_places(axis);
    }
    std::ranges::for_each(cells.radius, [&](double radius) { loss_.add_radius(radius); });
    for (const EulerArray& array : euler_arrays())
    {
      names_.emplace_back(array.name);
      if (!array.optional)
      {
        this->measure(array);
      }
    }
  }

  /// Returns true if there is nothing to tell.
  bool is_none() const { return joined_ == std::array<std::size_t, 3>{} && this->text().empty(); }

  /// Throws Error where cells would be in one place along an axis.
  void tell(Notices& notices) const
  {
    std::string text = this->text();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::string places =
        std::to_string(places_[axis]) + " places of centres along " + "xyz"[axis];
      if (joined_[axis] > 0 && joined_[axis] + 1 == places_[axis])
      {
        throw Error(
          "expected cells that six decimals, which is what LIGGGHTS writes, tell apart, got " +
          places + " that all become one; the dialect Wide keeps all digits");
      }
      if (joined_[axis] > 0)
      {
        text += (text.empty() ? "" : "; ") + std::to_string(joined_[axis]) + " of " + places +
          " become equal to the one before";
      }
    }
    if (!text.empty())
    {
      Notice& notice = notices.emplace_back();
      notice.topic = "rounding";
      notice.text = "rounding to six decimals, which is what LIGGGHTS writes, " + text +
        "; the dialect Wide keeps all digits";
    }
  }

private:
  static constexpr double most = 5e-7; ///< that a number is moved by

  std::string text() const { return loss_.text(Box::from_bounds(lo_, hi_), "centres", names_); }

  /// Finds the places of centres along an axis, and those that become the same.
  void find_places(std::size_t axis)
  {
    std::vector<double> places;
    for (std::size_t i = axis; i < cells_.centres.size(); i += 3)
    {
      const double place = cells_.centres[i];
      if (std::isfinite(place) && (places.empty() || place != places.back()))
      {
        places.push_back(place);
      }
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    double before = HUGE_VAL;
    for (const double place : places)
    {
      const double rounded = as_fixed(place);
      joined_[axis] += rounded == before ? 1U : 0U;
      loss_.move(axis, std::abs(rounded - place));
      before = rounded;
    }
    places_[axis] = places.size();
    lo_[axis] = places.empty() ? 0 : places.front();
    hi_[axis] = places.empty() ? 0 : places.back();
  }

  /// A radius counts by itself. Other values are held against the largest of their array: what is next to nothing beside it
  /// is so in any case. Of vectors the length counts.
  void measure(const EulerArray& array)
  {
    const std::vector<double>& values = cells_.*array.values;
    const auto components = static_cast<std::size_t>(array.components);
    const bool alone = array.values == &EulerCells::radius;
    const std::size_t index = names_.size() - 1;
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); i += components)
    {
      const double* const v = values.data() + i;
      largest = std::max(largest, components == 3 ? std::hypot(v[0], v[1], v[2]) : std::abs(*v));
    }
    constexpr double safe = 2 * most / RoundingLoss::of_value; // sqrt(3) for three components
    if (largest >= safe && !alone)
    {
      return;
    }
    for (const double value : values)
    {
      if (value != 0 && std::abs(value) < safe)
      {
        const double moved = std::abs(as_fixed(value) - value);
        const double whole = alone ? std::abs(value) : largest;
        loss_.change(index, whole, whole + moved);
      }
    }
  }

  const EulerCells& cells_;
  RoundingLoss loss_;
  std::vector<std::string> names_; ///< of the arrays
  std::array<std::size_t, 3> places_ = {};
  std::array<std::size_t, 3> joined_ = {}; ///< places that become the one before
  Vector3 lo_ = {};
  Vector3 hi_ = {};
};

/// Returns true if the text of LIGGGHTS has the same values, and centres that are not worth a notice: those of grids are computed.
bool decimals_are_enough(const EulerCells& cells)
{
  const auto exact = [](double value) { return !std::isfinite(value) || as_fixed(value) == value; };
  return DecimalLoss(cells).is_none() &&
    std::ranges::all_of(euler_arrays(),
      [&](const EulerArray& array)
      {
        const std::vector<double>& values = cells.*array.values;
        return array.optional ? values.empty() : std::ranges::all_of(values, exact);
      });
}
}

std::string encode_euler(
  const EulerCells& cells, EulerDialect dialect, Notices& notices, Progress& progress)
{
  const auto count = static_cast<std::size_t>(cells.count());
  if (dialect == EulerDialect::Automatic)
  {
    dialect = decimals_are_enough(cells) ? EulerDialect::Liggghts : EulerDialect::Wide;
  }
  const bool wide = dialect == EulerDialect::Wide;
  const std::string_view type = wide ? "double" : "float";
  std::string text = "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\n"
                     "DATASET POLYDATA\n";
  constexpr std::size_t lines = 8; // of a cell: centre, vertex and at most six arrays
  TupleWriter writer(text, dialect, lines * count, progress);
  add_line(text, "POINTS ", count, " ", type);
  writer.add(cells.centres, 3);
  add_line(text, "VERTICES ", count, " ", 2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    add_line(text, "1 ", i);
    writer.count();
  }
  add_line(text, "POINT_DATA ", count);
  for (const EulerArray& array : euler_arrays())
  {
    const std::vector<double>& values = cells.*array.values;
    if (array.optional && (!wide || values.empty()))
    {
      continue;
    }
    add_line(text, array.components == 3 ? "VECTORS " : "SCALARS ", array.name, " ", type,
      array.components == 3 ? "" : " 1\nLOOKUP_TABLE default");
    writer.add(values, static_cast<std::size_t>(array.components));
  }
  if (!wide)
  {
    DecimalLoss(cells).tell(notices);
  }
  progress.step(1);
  return text;
}
}
