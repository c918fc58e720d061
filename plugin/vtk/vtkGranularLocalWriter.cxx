// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalWriter.h"

#include "private/local/local_input.h"
#include "private/request/name_file.h"
#include "private/request/text_of.h"
#include "private/writing/rows_file.h"

#include "vtkInformation.h"
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
  this->SetLabel("ENTRIES");
  this->SetNumberFormat("%g");
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
  if (dialect != LIGGGHTS && dialect != LAMMPS)
  {
    vtkErrorMacro("expected Dialect 0 (LIGGGHTS) or 1 (LAMMPS), got " << dialect);
    return;
  }
  if (this->Dialect != dialect)
  {
    this->Dialect = dialect;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGranularLocalWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject"); // see LocalInput
  return 1;
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularLocalWriter::OpenFile(Internals& internals)
{
  granular::DumpFormat format =
    MakeFormat(this->FileName, this->Dialect == LIGGGHTS, this->Columns, this->NumberFormat);
  format.style = granular::DumpStyle::Local;
  format.counted = TextOf(this->Label);
  granular::Communicator& ranks = internals.GetRanks();
  const granular::WriteOptions options{
    this->ParallelMode == MPI_IO ? granular::ParallelMode::MpiIo : granular::ParallelMode::Gather,
    ChooseThreads(this->Threads, ranks)
  };
  return std::make_unique<File>(this->FileName, format, options, ranks);
}
