// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_print_loss_h
#define granular_dump_write_print_loss_h

#include "granular/dump/write/column_plan.h"
#include "granular/dump/write/dump_format.h"
#include "granular/dump/write/row_values.h"
#include "granular/particles/rounding_loss.h"

#include <cstddef>
#include <string>
#include <vector>

namespace granular
{
/// Returns the smallest radius of the rows of a frame; HUGE_VAL without radii.
double smallest_radius(const FrameView& frame);

/// Returns the format of the box in a text dump: all digits for LAMMPS, six for LIGGGHTS. LIGGGHTS also gets all digits if
/// six would move the corners by a tenth of the limit, or change a length by more than a value may change; any reader of
/// dumps reads any number.
NumberFormat box_numbers(const Box& box, Dialect dialect, const RoundingLimit& limit);

/// Adds a notice about the loss in the rows of all ranks if it exceeds the limit. Returns true if it does.
bool note_print_loss(const RoundingLoss& loss, const RoundingLimit& limit, const DumpFormat& format,
  const ColumnPlan& plan, Notices& notices);

/// Measures the loss that the format of a dump causes. A column costs a comparison per value; if the printed digits may be
/// too few for its largest values, these are printed and read back.
class PrintLoss
{
public:
  /// Measures nothing.
  PrintLoss() = default;

  PrintLoss(const ColumnPlan& plan, const FrameView& frame, const Box& box,
    const DumpFormat& format, const RoundingLimit& limit);

  /// Returns the format of the box: see box_numbers.
  NumberFormat of_box() const noexcept { return of_box_; }

  /// Rows of the frame.
  void measure(const RowValues& values, RoundingLoss& loss) const;

private:
  /// A column of coordinates.
  struct Place
  {
    std::size_t column;
    Vector3 unit;  ///< length of 1 in the column along the axes
    Vector3 moved; ///< by other rounding: of the box that scales it, or of a sum of doubles
    double safe;   ///< no value up to this one moves too far
  };

  void add_place(const ColumnSource& source, std::size_t column, const Vector3& of_box,
    const Vector3& of_sums, const RoundingLimit& limit);
  void measure_place(const Place& place, const RowValues& values, RoundingLoss& loss) const;
  void measure_values(std::size_t column, const RowValues& values, RoundingLoss& loss) const;

  Box box_;
  NumberFormat of_box_ = { 6 };
  NumberFormat numbers_ = { 0 };
  std::vector<Place> places_;
  std::vector<std::size_t> values_; ///< columns whose numbers may change too much
};
}
#endif
