// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_print_loss_h
#define granular_dump_write_print_loss_h

#include "granular/dump/write/column_plan.h"
#include "granular/dump/write/dump_format.h"
#include "granular/dump/write/row_values.h"
#include "granular/particles/rounding_loss.h"

#include <cstddef>
#include <vector>

namespace granular
{
/// Measures the loss that the digits of a text dump cause. A column costs a comparison per value; if the printed digits may
/// be too few for its largest values, these are printed and read back.
class PrintLoss
{
public:
  /// Measures nothing.
  PrintLoss() = default;

  PrintLoss(
    const ColumnPlan& plan, const Box& box, const DumpFormat& format, double smallest_radius);

  /// Returns the format of the box: all digits for LAMMPS, six for LIGGGHTS. LIGGGHTS also gets all digits if six would move
  /// the corners by a tenth of the limit; any reader of dumps reads any number.
  NumberFormat of_box() const noexcept { return of_box_; }

  /// Rows of the frame.
  void measure(const RowValues& values, RoundingLoss& loss) const;

private:
  /// A column whose numbers may lose too much.
  struct Column
  {
    std::size_t index;
    double safe;   ///< no value up to this one does
    bool place;    ///< coordinates
    Vector3 unit;  ///< length of 1 in the column along the axes
    Vector3 moved; ///< by the digits of the box that scales it
  };

  NumberFormat of_box_ = { 6 };
  NumberFormat numbers_ = {};
  std::vector<Column> columns_;
};

/// Adds a notice about the loss in the rows of all ranks if it exceeds the limits. Returns true if it does.
bool note_print_loss(const RoundingLoss& loss, const Box& box, const DumpFormat& format,
  const ColumnPlan& plan, Notices& notices);
}
#endif
