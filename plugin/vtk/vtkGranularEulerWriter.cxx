// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEulerWriter.h"

#include "private/euler/euler_input.h"
#include "private/request/name_file.h"
#include "private/writing/whole_file.h"
#include "private/writing/writer.h"

#include "granular/bytes/compression.h"
#include "granular/dump/write/dump_format.h"
#include "granular/euler/euler_text.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <initializer_list>
#include <string>
#include <utility>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularEulerWriter);

namespace
{
constexpr std::initializer_list<const char*> Names = { "LIGGGHTS", "Wide", "Automatic" };
static_assert(
  vtkGranularEulerWriter::LIGGGHTS == static_cast<int>(granular::EulerDialect::Liggghts) &&
  vtkGranularEulerWriter::WIDE == static_cast<int>(granular::EulerDialect::Wide) &&
  vtkGranularEulerWriter::AUTOMATIC == static_cast<int>(granular::EulerDialect::Automatic));
}

//------------------------------------------------------------------------------
/**
 * Cells that are being written.
 */
class vtkGranularEulerWriter::File : public WholeFile
{
public:
  File(vtkGranularEulerWriter* self, Internals& internals)
    : WholeFile({ self->FileName, static_cast<granular::Durability>(self->Durable), "cells",
                  Names.begin()[self->Dialect] },
        internals.GetRanks(), internals.Inputs, *self->Past, internals.Notices)
    , Dialect(static_cast<granular::EulerDialect>(self->Dialect))
  {
  }

protected:
  FrameFacts Take(
    vtkDataObject* input, const FrameTime& time, granular::Notices& vtkNotUsed(notices)) override
  {
    NameFile({ this->Form.Path }, [&] { this->Own = ReadCells(input); });
    return MakeFacts(input, this->Own.Points, this->Own.Cells.count() > 0, time);
  }

  void Gather(granular::Notices&, granular::Progress&) override
  {
    NameFile({ this->Form.Path },
      [&] { this->All = GatherCells(std::exchange(this->Own, {}), this->Ranks); });
  }

  std::string Encode(
    const SharedFacts&, granular::Notices& notices, granular::Progress& progress) override
  {
    granular::Notices found;
    std::string text = granular::encode_euler(this->All, this->Dialect, found, progress);
    for (granular::Notice& notice : found)
    {
      notice.where.path = this->Form.Path;
      notices.push_back(std::move(notice));
    }
    const granular::Compression how = granular::compression_of_name(this->Form.Path);
    return how == granular::Compression::None ? text : granular::compress(text, how);
  }

private:
  const granular::EulerDialect Dialect;
  EulerInput Own;
  granular::EulerCells All;
};

//------------------------------------------------------------------------------
vtkGranularEulerWriter::vtkGranularEulerWriter()
  : Past(std::make_unique<WrittenFiles>())
{
}

//------------------------------------------------------------------------------
vtkGranularEulerWriter::~vtkGranularEulerWriter() = default;

//------------------------------------------------------------------------------
void vtkGranularEulerWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dialect: " << this->Dialect << "\n";
}

//------------------------------------------------------------------------------
void vtkGranularEulerWriter::SetDialect(int dialect)
{
  this->SetChoice("Dialect", this->Dialect, dialect, Names);
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularEulerWriter::OpenFile(Internals& internals)
{
  const std::string path = this->FileName;
  if (granular::is_name_of_ranks(path))
  {
    throw granular::UnsupportedError(
      "expected a name without '%': one file holds the cells of all processes", { path });
  }
  return std::make_unique<File>(this, internals);
}
