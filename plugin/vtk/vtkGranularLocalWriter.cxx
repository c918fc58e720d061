// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalWriter.h"

#include "private/local/local_input.h"
#include "private/request/name_file.h"
#include "private/writing/writer.h"

#include "vtkObjectFactory.h"

#include <memory>
#include <string>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalWriter);

//------------------------------------------------------------------------------
void vtkGranularLocalWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dialect: " << this->Dialect << "\n";
  os << indent << "Label: " << this->Label << "\n";
  os << indent << "Columns: " << this->Columns << "\n";
  os << indent << "NumberFormat: " << this->NumberFormat << "\n";
}

//------------------------------------------------------------------------------
void vtkGranularLocalWriter::SetDialect(int dialect)
{
  this->SetChoice("Dialect", this->Dialect, dialect, { "LIGGGHTS", "LAMMPS", "Automatic" });
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularLocalWriter::OpenFile(Internals& internals)
{
  granular::DumpFormat format =
    granular::format_of_name(this->FileName, this->Columns, this->NumberFormat);
  format.dialect = DialectOf(this->Dialect);
  format.style = granular::DumpStyle::Local;
  format.counted = this->Label == "Automatic" ? std::string() : this->Label;
  const bool chosen = !format.columns.empty();
  return std::make_unique<RowsFile>(this->FileName, format, internals.MakeOptions(this),
    internals.GetRanks(),
    [where = granular::Where{ this->FileName }, chosen](
      vtkDataObject* input, granular::Notices& notices)
    {
      std::unique_ptr<RowsInput> data;
      NameFile(where, [&] { data = std::make_unique<LocalInput>(input, chosen, notices); });
      return data;
    });
}
