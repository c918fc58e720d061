// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpWriter.h"

#include "private/dump_input.h"
#include "private/writer.h"

#include "granular/base/words.h"
#include "granular/dump/dump_writer.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpWriter);

namespace
{
const char* TextOf(const char* text)
{
  return text ? text : "";
}

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
class vtkGranularDumpWriter::File : public FrameWriter
{
public:
  File(vtkGranularDumpWriter* self, granular::DumpFormat format,
    const granular::WriteOptions& options, granular::Communicator& ranks)
    : Self(self)
    , Ranks(ranks)
    , Writer(self->FileName, std::move(format), options, ranks)
  {
  }

  void Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
    granular::Progress& progress) override
  {
    std::optional<DumpInput> data;
    std::string told;
    granular::do_together(this->Ranks,
      [&]
      {
        granular::Notices own;
        auto* points = vtkPointSet::SafeDownCast(input);
        if (!points)
        {
          throw granular::UnsupportedError("expected a vtkPointSet to write, got a " +
              std::string(input->GetClassName()) +
              (vtkCompositeDataSet::SafeDownCast(input) ? ": the filter MergeBlocks makes one of it"
                                                        : ""),
            { this->Self->FileName });
        }
        data.emplace(points, own);
        this->Complete(*data, time, own);
        told = data->View.rows > 0 ? "rows" : "none";
        for (const granular::Notice& notice : own)
        {
          told += '\0' + notice.text;
        }
      });
    this->Gather(told, notices);
    this->Writer.write(data->View, notices, progress);
  }

  void Finish() override { this->Writer.finish(); }

private:
  /**
   * What any of the processes has to say that has rows, or all of them where none has: who has no rows may have no
   * field data either.
   */
  void Gather(const std::string& own, granular::Notices& notices)
  {
    const std::vector<std::string> all = this->Ranks.all_gather(own);
    const bool any = std::any_of(
      all.begin(), all.end(), [](const std::string& told) { return told.front() == 'r'; });
    for (const std::string& told : all)
    {
      std::istringstream texts(told);
      std::string text;
      std::getline(texts, text, '\0');
      while ((!any || told.front() == 'r') && std::getline(texts, text, '\0'))
      {
        notices.push_back({ {}, text });
      }
    }
  }

  /**
   * What the properties, or the pipeline, say beyond the field data.
   */
  void Complete(DumpInput& data, const FrameTime& time, granular::Notices& notices)
  {
    granular::FrameHeader& header = data.View.header;
    if (!data.HasTimestep)
    {
      header.timestep = time.Step.value_or(time.Frame);
      granular::Notice notice;
      notice.text = time.Step ? "the input has no field data 'timestep': its time is taken for it"
                              : "the input has no field data 'timestep': frames are counted from 0";
      notices.push_back(notice);
    }
    if (!data.HasTime)
    {
      header.time = time.Time;
    }
    if (*TextOf(this->Self->Units))
    {
      header.units = this->Self->Units;
    }
    const std::string boundary = header.box.boundary;
    if (HasBox(this->Self->BoxVectors))
    {
      header.box = MakeBox(this->Self->BoxOrigin, this->Self->BoxVectors);
      header.box.boundary = boundary;
      data.View.has_box = true;
    }
    if (*TextOf(this->Self->Boundary))
    {
      header.box.boundary = this->Self->Boundary;
    }
  }

  vtkGranularDumpWriter* Self;
  granular::Communicator& Ranks;
  granular::DumpWriter Writer;
};

//------------------------------------------------------------------------------
vtkGranularDumpWriter::vtkGranularDumpWriter()
{
  this->SetNumberFormat("%g");
}

//------------------------------------------------------------------------------
vtkGranularDumpWriter::~vtkGranularDumpWriter()
{
  this->SetColumns(nullptr);
  this->SetNumberFormat(nullptr);
  this->SetUnits(nullptr);
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
  os << indent << "Units: " << TextOf(this->Units) << "\n";
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
  if (style != ATOM && style != CUSTOM)
  {
    vtkErrorMacro("expected Style 0 (Atom) or 1 (Custom), got " << style);
    return;
  }
  if (this->Style != style)
  {
    this->Style = style;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularDumpWriter::SetDialect(int dialect)
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
int vtkGranularDumpWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject"); // see File::Write
  return 1;
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularDumpWriter::OpenFile(Internals& internals)
{
  const std::string path = this->FileName;
  if (*TextOf(this->Boundary))
  {
    granular::parse_boundary(this->Boundary); // a wrong one is told before a file is opened
  }
  if (HasBox(this->BoxVectors))
  {
    CheckFinite(this->BoxOrigin, 3);
    CheckFinite(this->BoxVectors, 9);
  }
  if (granular::split_words(TextOf(this->Units)).size() > 1)
  {
    throw granular::Error("expected Units of one word, got '" + std::string(this->Units) + "'");
  }
  if (this->Style == CUSTOM && (!this->Scaled || this->Image))
  {
    internals.Tell(this, "Scaled and Image are of the Style Atom: this is Custom, see Columns");
  }
  if (this->Style == ATOM && *TextOf(this->Columns))
  {
    internals.Tell(this, "Columns are of the Style Custom: this is Atom");
  }
  granular::DumpFormat format;
  format.style = this->Style == ATOM ? granular::DumpStyle::Atom : granular::DumpStyle::Custom;
  format.dialect =
    this->Dialect == LIGGGHTS ? granular::Dialect::Liggghts : granular::Dialect::Lammps;
  format.binary = granular::is_binary_name(path);
  format.compression = granular::compression_of_name(path);
  format.atom = { this->Scaled, this->Image };
  format.numbers = granular::parse_number_format(TextOf(this->NumberFormat));
  format.units = this->WriteUnits;
  format.time = this->WriteTime;
  format.sort_by_id = this->SortById;
  for (const std::string_view name : granular::split_words(TextOf(this->Columns)))
  {
    format.columns.emplace_back(name);
  }
  granular::Communicator& ranks = internals.GetRanks();
  granular::WriteOptions options;
  options.mode =
    this->ParallelMode == MPI_IO ? granular::ParallelMode::MpiIo : granular::ParallelMode::Gather;
  options.threads = ChooseThreads(this->Threads, ranks);
  return std::make_unique<File>(this, std::move(format), options, ranks);
}
