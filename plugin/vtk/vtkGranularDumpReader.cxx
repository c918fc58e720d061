// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpReader.h"

#include "private/arrays/array_choice.h"
#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/dump/frame_ahead.h"
#include "private/request/guard.h"
#include "private/request/piece_request.h"
#include "private/request/series_reader.h"

#include "granular/common/archive.h"
#include "granular/common/words.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpReader);

//------------------------------------------------------------------------------
struct vtkGranularDumpReader::Internals
{
  using Self = vtkGranularDumpReader;

  std::string ColumnNames; ///< as they were given
  ArrayChoice Arrays;

  VertexCache Vertices; ///< of the frame before
  FrameAhead Ahead;     ///< the next frame
  std::size_t LastFrame = 0;

  /**
   * What is to be read: a frame, and what of it.
   */
  struct Task
  {
    std::size_t Frame = 0;
    double Time = 0;
    granular::DumpRequest Request;
  };

  void UpdateSelection(const granular::RunIndex& index);
  granular::DumpRequest MakeRequest(Self* self, vtkInformation* output);
  void FindTask(Self* self, vtkInformation* request, vtkInformationVector* outputs, Task& task);
  std::string FormOf(const Task& task) const;
  granular::DumpFrame Read(Self* self, const Task& task, bool together, granular::Notices& notices);
  void FillOutputs(Self* self, vtkInformationVector* outputs, const Task& task,
    granular::DumpFrame& frame, granular::Notices& notices);
  void Run(Self* self, vtkInformation* request, vtkInformationVector* outputs);
  FrameAhead::Key KeyOf(Self* self, const Task& task, bool together);
  void StartNext(Self* self, const Task& task, bool together) noexcept;
};

//------------------------------------------------------------------------------
// The arrays of all frames, in the order in which they occur.
void vtkGranularDumpReader::Internals::UpdateSelection(const granular::RunIndex& index)
{
  std::set<const granular::FrameKind*> seen;
  this->Arrays.Begin();
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    const granular::FrameKind* kind = index.first_piece(frame).entry.kind.get();
    if (!seen.insert(kind).second)
    {
      continue;
    }
    for (const granular::ArrayInfo& array : kind->schema.arrays())
    {
      this->Arrays.Add(array.name, !array.position_form);
    }
  }
  this->Arrays.End();
}

//------------------------------------------------------------------------------
granular::DumpRequest vtkGranularDumpReader::Internals::MakeRequest(
  Self* self, vtkInformation* output)
{
  granular::DumpRequest request;
  request.coordinates = static_cast<granular::Coordinates>(self->Coordinates);
  request.single_precision = self->PointPrecision == SINGLE_PRECISION;
  std::copy_n(self->PointOrigin, 3, request.point_origin.begin());
  request.sort_by_id = self->SortById;
  request.stride = self->Stride;
  std::copy_n(self->RegionOfInterest, 6, request.region.begin());
  // a copy: the frame may be decoded while the selection changes
  request.wanted = [names = this->Arrays.GetWanted()](const granular::ArrayInfo& array)
  { return names.count(array.name) != 0; };
  const PieceRequest wanted = PieceRequest::Of(output);
  request.piece = wanted.Piece;
  request.pieces = wanted.Pieces;
  request.ranges = true; // whoever shows an array asks for it
  request.threads = ChooseThreads(self->Threads, self->Series->GetRanks());
  request.pool = self->Series->Pool;
  return request;
}

//------------------------------------------------------------------------------
// What the port that is asked for wants, whatever it is that the other ranks want.
void vtkGranularDumpReader::Internals::FindTask(
  Self* self, vtkInformation* request, vtkInformationVector* outputs, Task& task)
{
  task.Frame = self->Series->FindFrame(self, request, outputs, task.Time);
  task.Request =
    this->MakeRequest(self, outputs->GetInformationObject(self->Series->PortOf(request)));
  for (double coordinate : task.Request.point_origin)
  {
    if (!std::isfinite(coordinate))
    {
      throw granular::LimitError("PointOrigin must be finite");
    }
  }
}

//------------------------------------------------------------------------------
// What must be the same on ranks that read together: they exchange rows.
std::string vtkGranularDumpReader::Internals::FormOf(const Task& task) const
{
  granular::DumpRequest request = task.Request;
  granular::ArchiveWriter form;
  std::size_t frame = task.Frame;
  form.number(frame);
  form.number(request.coordinates);
  form.number(request.single_precision);
  form.number(request.point_origin);
  form.number(request.sort_by_id);
  form.number(request.stride);
  form.number(request.region);
  for (std::string name : this->Arrays.GetWanted())
  {
    form.text(name);
  }
  return form.bytes;
}

//------------------------------------------------------------------------------
granular::DumpFrame vtkGranularDumpReader::Internals::Read(
  Self* self, const Task& task, bool together, granular::Notices& notices)
{
  granular::Communicator& ranks = self->Series->GetRanks();
  std::vector<granular::FramePiece> pieces;
  AlgorithmProgress own(self);
  granular::SharedProgress progress(own, ranks);
  std::optional<granular::DumpPart> ahead;
  granular::do_together(ranks,
    [&]
    {
      progress.step(0);
      pieces = self->Series->Index.pieces(task.Frame);
      ahead = this->Ahead.Take(this->KeyOf(self, task, together), progress);
    });
  granular::DumpFrame frame;
  if (together)
  {
    frame = granular::read_dump(pieces, task.Request, ranks, std::move(ahead), notices, own);
  }
  else
  {
    granular::SerialCommunicator alone;
    granular::do_together(ranks,
      [&] {
        frame =
          granular::read_dump(pieces, task.Request, alone, std::move(ahead), notices, progress);
      });
  }
  granular::do_together(ranks, [&] { progress.step(1); });
  return frame;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::Internals::FillOutputs(Self* self, vtkInformationVector* outputs,
  const Task& task, granular::DumpFrame& frame, granular::Notices& notices)
{
  const VertexCells cells[] = { VertexCells::None, VertexCells::One, VertexCells::OnePerPoint };
  FillParticles(vtkPolyData::GetData(outputs, 0), frame, task.Request.single_precision,
    cells[self->Vertices], this->Vertices, self->Series->Pool);
  auto* box = vtkUnstructuredGrid::GetData(outputs, 1);
  if (task.Request.piece == 0 &&
    !FillBox(box, frame.header.box, frame.coordinates, task.Request.point_origin))
  {
    const granular::FramePiece piece = self->Series->Index.first_piece(task.Frame);
    notices.push_back({ granular::where_of(piece), "the box is not finite and not shown" });
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    FillFieldData(output->GetFieldData(), frame, task.Request.point_origin);
    FillLeftOut(output->GetFieldData(), task.Request);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), task.Time);
  }
}

//------------------------------------------------------------------------------
// Collective: what may fail on one rank alone is done together.
void vtkGranularDumpReader::Internals::Run(
  Self* self, vtkInformation* request, vtkInformationVector* outputs)
{
  granular::Communicator& ranks = self->Series->GetRanks();
  granular::Notices notices;
  Task task;
  std::string form;
  granular::do_together(ranks,
    [&]
    {
      self->Series->StartFrame(notices);
      this->FindTask(self, request, outputs, task);
      this->Arrays.CheckNames(self->Series->Index.first_piece(task.Frame).file.path, notices);
      form = this->FormOf(task);
    });
  const bool together = AskTogether({ task.Request.piece, task.Request.pieces }, form, ranks);
  granular::DumpFrame frame = this->Read(self, task, together, notices);
  granular::do_together(ranks,
    [&]
    {
      this->FillOutputs(self, outputs, task, frame, notices);
      if (ranks.rank() == 0 || !together) // what they have read together, rank 0 knows all of
      {
        self->Series->Tell(self, notices, false);
      }
    });
  this->StartNext(self, task, together);
}

//------------------------------------------------------------------------------
FrameAhead::Key vtkGranularDumpReader::Internals::KeyOf(Self* self, const Task& task, bool together)
{
  return { task.Frame, task.Request.piece, task.Request.pieces, together, self->GetMTime() };
}

//------------------------------------------------------------------------------
// The next frame in the direction in which they are looked at. Where there is no memory or no thread for
// that, it is decoded when it is asked for.
void vtkGranularDumpReader::Internals::StartNext(
  Self* self, const Task& task, bool together) noexcept
{
  const bool back = task.Frame + 1 == this->LastFrame;
  this->LastFrame = task.Frame;
  try
  {
    Task next = task;
    next.Frame += back ? -1 : 1;
    if (self->Prefetch && next.Frame < self->Series->Index.size())
    {
      this->Ahead.Start(
        this->KeyOf(self, next, together), self->Series->Index.pieces(next.Frame), next.Request);
    }
  }
  catch (const std::exception&)
  {
  }
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::vtkGranularDumpReader()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
  this->Series->Format = &granular::dump_format();
  this->Internal->Arrays.GetSelection()->AddObserver(
    vtkCommand::ModifiedEvent, this, &vtkGranularDumpReader::Modified);
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::~vtkGranularDumpReader() = default;

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularDumpReader::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::ForgetFrames()
{
  this->Internal->Ahead.Drop();
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::FramesChanged()
{
  this->Internal->UpdateSelection(this->Series->Index);
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::CanReadFile(const char* fileName)
{
  return granular::is_dump_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::SetColumnNames(const char* names)
{
  const std::string wanted = names ? names : "";
  if (this->Internal->ColumnNames != wanted)
  {
    std::string spaced = wanted; // no column has a comma in its name
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    const std::vector<std::string_view> words = granular::split_words(spaced);
    this->Internal->ColumnNames = wanted;
    this->Series->ColumnNames.assign(words.begin(), words.end());
    this->Refresh();
  }
}

//------------------------------------------------------------------------------
const char* vtkGranularDumpReader::GetColumnNames()
{
  return this->Internal->ColumnNames.c_str();
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::SetStride(vtkTypeInt64 stride)
{
  if (stride < 1)
  {
    vtkErrorMacro("Stride must be at least 1, got " << stride);
    return;
  }
  if (this->Stride != stride)
  {
    this->Stride = stride;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::SetPrefetch(bool prefetch)
{
  this->Prefetch = prefetch; // changes no result: nothing is to be read again
  if (!prefetch)
  {
    this->Internal->Ahead.Drop();
  }
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularDumpReader::GetPointDataArraySelection()
{
  return this->Internal->Arrays.GetSelection();
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkUnstructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  return this->Series->Run(
    this, outputVector, [&] { this->Internal->Run(this, request, outputVector); });
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ColumnNames: " << this->Internal->ColumnNames << "\n";
  os << indent << "Coordinates: " << this->Coordinates << "\n";
  os << indent << "PointPrecision: " << this->PointPrecision << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
  os << indent << "SortById: " << (this->SortById ? "On" : "Off") << "\n";
  os << indent << "Vertices: " << this->Vertices << "\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "Prefetch: " << (this->Prefetch ? "On" : "Off") << "\n";
  os << indent << "RegionOfInterest:";
  for (double bound : this->RegionOfInterest)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "PointArrays:\n";
  this->Internal->Arrays.GetSelection()->PrintSelf(os, indent.GetNextIndent());
}
