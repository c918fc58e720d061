// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/euler_text.h"

#include "granular/base/number.h"
#include "granular/base/number_print.h"
#include "granular/base/text_lines.h"

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

/// Whether six decimals are the same for both.
bool prints_alike(double a, double b)
{
  const auto printed = [](double value)
  {
    std::array<char, most_fixed_chars> digits;
    static_cast<void>(parse_double(digits.data(), print_fixed(digits.data(), value), value));
    return value;
  };
  return std::abs(a - b) <= 1e-6 && printed(a) == printed(b);
}

void tell(std::size_t lost, std::size_t all, const std::string& what, Notices& notices)
{
  if (lost > 0)
  {
    Notice& notice = notices.emplace_back();
    notice.text = "six decimals, which is what LIGGGHTS writes, are few: " + std::to_string(lost) +
      " of " + std::to_string(all) + what + "; the dialect Wide keeps all digits";
  }
}

/// Says where centres along an axis become equal.
void tell_centres(const EulerCells& cells, std::size_t axis, Notices& notices)
{
  std::vector<double> places;
  for (std::size_t i = axis; i < cells.centres.size(); i += 3)
  {
    const double place = cells.centres[i];
    if (std::isfinite(place) && (places.empty() || place != places.back()))
    {
      places.push_back(place);
    }
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::size_t lost = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
  {
    lost += prints_alike(places[i - 1], places[i]) ? 1U : 0U;
  }
  tell(lost, places.size(),
    std::string(" places of centres along ") + "xyz"[axis] + " become equal to the one before",
    notices);
}

void tell_radii(const EulerCells& cells, Notices& notices)
{
  const auto is_lost = [](double radius) { return radius != 0 && prints_alike(radius, 0); };
  const auto lost = static_cast<std::size_t>(std::ranges::count_if(cells.radius, is_lost));
  tell(lost, cells.radius.size(), " radii become 0", notices);
}
}

std::string encode_euler(
  const EulerCells& cells, EulerDialect dialect, Notices& notices, Progress& progress)
{
  const auto count = static_cast<std::size_t>(cells.count());
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
  for (std::size_t axis = 0; !wide && axis < 3; ++axis)
  {
    tell_centres(cells, axis, notices);
  }
  if (!wide)
  {
    tell_radii(cells, notices);
  }
  progress.step(1);
  return text;
}
}
