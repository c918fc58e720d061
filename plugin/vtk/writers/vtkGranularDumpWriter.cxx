// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpWriter.h"

#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/writing/writer.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpWriter);

namespace
{
bool HasBox(const double vectors[9])
{
  return std::any_of(vectors, vectors + 9, [](double value) { return value != 0; });
}

void CheckFinite(const double* first, int count)
{
  const double* const last = first + count;
  const double* const bad =
    std::find_if_not(first, last, [](double value) { return std::isfinite(value); });
  if (bad != last)
  {
    throw granular::Error(
      "expected BoxOrigin and BoxVectors of finite numbers, got " + std::to_string(*bad));
  }
}

/**
 * The particles of this rank, in a box and with boundaries that were given, if any.
 */
std::unique_ptr<RowsInput> TakeParticles(vtkDataObject* input, const granular::Where& where,
  const std::optional<granular::Box>& box, const std::string& boundary, granular::Notices& notices)
{
  auto data = std::make_unique<DumpInput>(
    ExpectData<vtkPointSet>(input, "a vtkPointSet to write", where), notices);
  granular::Box& own = data->View.header.box;
  std::string flags = boundary.empty() ? own.boundary : boundary;
  if (box)
  {
    own = *box;
    data->View.has_box = true;
  }
  own.boundary = std::move(flags);
  return data;
}
}

vtkGranularPrintMacro(vtkGranularDumpWriter, Style, Dialect, Scaled, Image, Columns, NumberFormat,
  SortById, WriteUnits, WriteTime, BoxOrigin, BoxVectors, Boundary);

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularDumpWriter::OpenFile(Internals& internals)
{
  if (!this->Boundary.empty())
  {
    granular::parse_boundary(this->Boundary); // a wrong one is told before a file is opened
  }
  std::optional<granular::Box> box;
  if (HasBox(this->BoxVectors))
  {
    CheckFinite(this->BoxOrigin, 3);
    CheckFinite(this->BoxVectors, 9);
    box = MakeBox(this->BoxOrigin, this->BoxVectors);
  }
  if (this->Style == CUSTOM && (!this->Scaled || this->Image))
  {
    internals.Tell(this, "Scaled and Image are of the Style Atom: this is Custom, see Columns");
  }
  if (this->Style == ATOM && !this->Columns.empty())
  {
    internals.Tell(this, "Columns are of the Style Custom: this is Atom");
  }
  granular::DumpFormat format =
    granular::format_of_name(this->FileName, this->Columns, this->NumberFormat);
  format.dialect = DialectOf(this->Dialect);
  format.style = this->Style == ATOM ? granular::DumpStyle::Atom : granular::DumpStyle::Custom;
  format.atom = { this->Scaled, this->Image };
  format.units = this->WriteUnits;
  format.time = this->WriteTime;
  format.sort_by_id = this->SortById;
  return std::make_unique<RowsFile>(this->FileName, std::move(format), internals.MakeOptions(this),
    internals.GetRanks(),
    [where = granular::Where{ this->FileName }, box, boundary = this->Boundary](
      vtkDataObject* input, granular::Notices& notices)
    { return TakeParticles(input, where, box, boundary, notices); });
}
