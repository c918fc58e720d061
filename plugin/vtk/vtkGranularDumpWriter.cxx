// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpWriter.h"

#include "private/request/expect_data.h"
#include "private/request/text_of.h"
#include "private/writing/writer.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
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
}

//------------------------------------------------------------------------------
/**
 * A dump that is being written.
 */
class vtkGranularDumpWriter::File : public RowsFile
{
public:
  File(vtkGranularDumpWriter* self, granular::DumpFormat format,
    const granular::WriteOptions& options, granular::Communicator& ranks)
    : RowsFile(self->FileName, std::move(format), options, ranks)
    , Self(self)
  {
  }

protected:
  std::unique_ptr<RowsInput> Take(vtkDataObject* input, granular::Notices& notices) override
  {
    auto* points = ExpectData<vtkPointSet>(input, "a vtkPointSet to write", { this->Path });
    auto data = std::make_unique<DumpInput>(points, notices);
    granular::FrameHeader& header = data->View.header;
    const std::string boundary = header.box.boundary;
    if (HasBox(this->Self->BoxVectors))
    {
      header.box = MakeBox(this->Self->BoxOrigin, this->Self->BoxVectors);
      header.box.boundary = boundary;
      data->View.has_box = true;
    }
    if (*TextOf(this->Self->Boundary))
    {
      header.box.boundary = this->Self->Boundary;
    }
    return data;
  }

private:
  vtkGranularDumpWriter* Self;
};

//------------------------------------------------------------------------------
vtkGranularDumpWriter::vtkGranularDumpWriter()
{
  this->SetNumberFormat("Automatic");
}

//------------------------------------------------------------------------------
vtkGranularDumpWriter::~vtkGranularDumpWriter()
{
  this->SetColumns(nullptr);
  this->SetNumberFormat(nullptr);
  this->SetBoundary(nullptr);
}

//------------------------------------------------------------------------------
void vtkGranularDumpWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Style: " << this->Style << "\n";
  os << indent << "Dialect: " << this->Dialect << "\n";
  os << indent << "Scaled: " << this->Scaled << "\n";
  os << indent << "Image: " << this->Image << "\n";
  os << indent << "Columns: " << TextOf(this->Columns) << "\n";
  os << indent << "NumberFormat: " << TextOf(this->NumberFormat) << "\n";
  os << indent << "SortById: " << this->SortById << "\n";
  os << indent << "WriteUnits: " << this->WriteUnits << "\n";
  os << indent << "WriteTime: " << this->WriteTime << "\n";
  const auto print = [&](const char* name, const double* first, int count)
  {
    os << indent << name << ":";
    std::for_each(first, first + count, [&](double value) { os << " " << value; });
    os << "\n";
  };
  print("BoxOrigin", this->BoxOrigin, 3);
  print("BoxVectors", this->BoxVectors, 9);
  os << indent << "Boundary: " << TextOf(this->Boundary) << "\n";
}

//------------------------------------------------------------------------------
void vtkGranularDumpWriter::SetStyle(int style)
{
  this->SetChoice("Style", this->Style, style, { "Atom", "Custom" });
}

//------------------------------------------------------------------------------
void vtkGranularDumpWriter::SetDialect(int dialect)
{
  this->SetChoice("Dialect", this->Dialect, dialect, { "LIGGGHTS", "LAMMPS", "Automatic" });
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularDumpWriter::OpenFile(Internals& internals)
{
  if (*TextOf(this->Boundary))
  {
    granular::parse_boundary(this->Boundary); // a wrong one is told before a file is opened
  }
  if (HasBox(this->BoxVectors))
  {
    CheckFinite(this->BoxOrigin, 3);
    CheckFinite(this->BoxVectors, 9);
  }
  if (this->Style == CUSTOM && (!this->Scaled || this->Image))
  {
    internals.Tell(this, "Scaled and Image are of the Style Atom: this is Custom, see Columns");
  }
  if (this->Style == ATOM && *TextOf(this->Columns))
  {
    internals.Tell(this, "Columns are of the Style Custom: this is Atom");
  }
  granular::DumpFormat format =
    granular::format_of_name(this->FileName, TextOf(this->Columns), TextOf(this->NumberFormat));
  format.dialect = DialectOf(this->Dialect);
  format.style = this->Style == ATOM ? granular::DumpStyle::Atom : granular::DumpStyle::Custom;
  format.atom = { this->Scaled, this->Image };
  format.units = this->WriteUnits;
  format.time = this->WriteTime;
  format.sort_by_id = this->SortById;
  return std::make_unique<File>(
    this, std::move(format), internals.MakeOptions(this), internals.GetRanks());
}
