// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalWriter.h"

#include "private/local/local_input.h"
#include "private/request/name_file.h"
#include "private/request/text_of.h"
#include "private/writing/writer.h"

#include "vtkObjectFactory.h"

#include <utility>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalWriter);

//------------------------------------------------------------------------------
/**
 * A dump of rows that is being written.
 */
class vtkGranularLocalWriter::File : public RowsFile
{
public:
  File(const char* path, const granular::DumpFormat& format, const granular::WriteOptions& options,
    granular::Communicator& ranks)
    : RowsFile(path, format, options, ranks)
    , Chosen(!format.columns.empty())
  {
  }

protected:
  std::unique_ptr<RowsInput> Take(vtkDataObject* input, granular::Notices& notices) override
  {
    std::unique_ptr<LocalInput> data;
    NameFile(
      { this->Path }, [&] { data = std::make_unique<LocalInput>(input, this->Chosen, notices); });
    return data;
  }

private:
  const bool Chosen; ///< which columns there are
};

//------------------------------------------------------------------------------
vtkGranularLocalWriter::vtkGranularLocalWriter()
{
  this->SetLabel("Automatic");
  this->SetNumberFormat("Automatic");
}

//------------------------------------------------------------------------------
vtkGranularLocalWriter::~vtkGranularLocalWriter()
{
  this->SetLabel(nullptr);
  this->SetColumns(nullptr);
  this->SetNumberFormat(nullptr);
}

//------------------------------------------------------------------------------
void vtkGranularLocalWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dialect: " << this->Dialect << "\n";
  os << indent << "Label: " << TextOf(this->Label) << "\n";
  os << indent << "Columns: " << TextOf(this->Columns) << "\n";
  os << indent << "NumberFormat: " << TextOf(this->NumberFormat) << "\n";
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
    granular::format_of_name(this->FileName, TextOf(this->Columns), TextOf(this->NumberFormat));
  format.dialect = DialectOf(this->Dialect);
  format.style = granular::DumpStyle::Local;
  const std::string label = TextOf(this->Label);
  format.counted = label == "Automatic" ? std::string() : label;
  return std::make_unique<File>(
    this->FileName, format, internals.MakeOptions(this), internals.GetRanks());
}
