// SPDX-License-Identifier: BSD-3-Clause
#include "private/readers/series_reader.h"

#include "vtkGranularParticleReader.h"

#include "private/arrays/arrays.h"
#include "private/local/lines.h"

#include "granular/runs/kind.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::SetParticles(
  granular::Request& request, vtkGranularParticleReader* reader)
{
  request.coordinates = static_cast<granular::Coordinates>(reader->GetCoordinates());
  std::copy_n(reader->GetPointOrigin(), 3, request.point_origin.begin());
  request.sort_by_id = reader->GetSortById();
  request.stride = reader->GetStride();
  std::copy_n(reader->GetRegionOfInterest(), 6, request.region.begin());
}

//------------------------------------------------------------------------------
int vtkGranularSeriesReader::Internals::GetThreads()
{
  return ChooseThreads(this->Self->Threads, this->GetRanks());
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Update()
{
  if (this->FileNames.empty())
  {
    throw granular::IoError("no file to read: set FileNames first");
  }
  const granular::RunOptions options = this->MakeOptions();
  if (!this->Run.options().tell_the_same(options))
  {
    this->LookedAt.reset();
  }
  if (this->Valid && !this->Stale && this->IndexedNames == this->FileNames &&
    this->Run.options().repeated_steps == options.repeated_steps &&
    this->Run.options().column_names == options.column_names &&
    this->Run.options().column_map == options.column_map)
  {
    this->Run.set_options(options);
    return;
  }
  granular::Communicator& ranks = this->GetRanks();
  this->Valid = false;
  this->LookedAt.reset();
  if (this->IndexedNames != this->FileNames)
  {
    this->Told.clear();
    this->IndexedNames = this->FileNames;
  }
  if (const granular::Kind& kind = this->FindKind(); &kind != &this->Run.kind())
  {
    this->Run = granular::Run(kind);
  }
  granular::Notices notices;
  AlgorithmProgress progress(this->Self);
  this->Run.refresh(this->FileNames, options, ranks, notices, progress);
  granular::do_together(ranks,
    [&]
    {
      if (ranks.rank() == 0)
      {
        this->Tell(notices, true);
      }
    });
  this->Valid = true;
  this->Stale = false;
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::LookOnce()
{
  std::string key = this->GetLookKey();
  if (this->LookedAt == key)
  {
    return;
  }
  granular::do_together(this->GetRanks(),
    [&]
    {
      AlgorithmProgress progress(this->Self);
      this->Run.look(this->GetRanks(), progress);
      const bool isOfLines = this->Run.kind().rows == granular::RowKind::Lines;
      (isOfLines ? this->Cells : this->Points).Offer(this->Run.arrays(0));
      if (!isOfLines)
      {
        this->Cells.Offer(this->Run.arrays(1));
      }
      this->LookFurther();
    });
  this->LookedAt = std::move(key);
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Tell(const granular::Notices& notices, bool ofFrames)
{
  constexpr int most = 10;
  std::map<std::string, std::string> texts;
  std::map<std::string, int> counts;
  for (const granular::Notice& notice : notices)
  {
    const std::string& path = notice.where.path;
    if (this->Told.insert(granular::subject_of(notice, ofFrames)).second && ++counts[path] <= most)
    {
      std::string& joined = texts[path];
      joined += (joined.empty() ? "" : "\n") + granular::to_string(notice);
    }
  }
  int files = 0;
  for (const auto& [path, text] : texts)
  {
    if (++files > most)
    {
      vtkWarningWithObjectMacro(
        this->Self, << "there is more to say of " << texts.size() - most << " more files");
      break;
    }
    const int more = counts[path] - most;
    vtkWarningWithObjectMacro(
      this->Self, << text << (more > 0 ? "\nand " + std::to_string(more) + " more" : ""));
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::ShowRequested(
  vtkInformation* request, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  // valid already, but for a pipeline that goes on after RequestInformation failed
  this->Update();
  AlgorithmProgress own(this->Self);
  granular::SharedProgress together(own, this->GetRanks());
  granular::PartialProgress progress(together);
  progress.step(0);
  Shown shown{ .Outputs = outputs, .Progress = progress };
  const int port =
    request->Has(Pipeline::FROM_OUTPUT_PORT()) ? request->Get(Pipeline::FROM_OUTPUT_PORT()) : 0;
  shown.Port = outputs->GetInformationObject(std::max(port, 0));
  shown.Piece = PieceRequest::Of(shown.Port);
  const std::vector<double> times = this->Run.index().times(this->Self->TimestepSize);
  if (shown.Port->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    shown.Number = granular::RunIndex::find(times, shown.Port->Get(Pipeline::UPDATE_TIME_STEP()));
  }
  shown.Pieces = this->Run.index().pieces(shown.Number);
  shown.Where = granular::where_of(shown.Pieces.front());
  if (!std::exchange(this->PoolMade, true))
  {
    this->Pool = MakePool(shown.Notices);
  }
  if (this->Pool)
  {
    this->Pool->next_frame();
  }
  this->LookOnce();
  this->Show(shown);
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject::GetData(outputs, i)
      ->GetInformation()
      ->Set(vtkDataObject::DATA_TIME_STEP(), times[shown.Number]);
  }
  if (this->GetRanks().rank() == 0 || !shown.Together)
  {
    this->Tell(shown.Notices, false);
  }
  progress.set_part(1, 1);
  progress.step(1);
}

//------------------------------------------------------------------------------
granular::Request vtkGranularSeriesReader::Internals::MakeRequest()
{
  granular::Request request;
  request.bonds = this->Run.kind().has_bonds;
  const bool isOfLines = this->Run.kind().rows == granular::RowKind::Lines;
  request.wanted = (isOfLines ? this->Cells : this->Points).MakeFilter();
  request.wanted_bonds = this->Cells.MakeFilter();
  request.ranges = true; // whoever shows an array asks for it
  request.threads = this->GetThreads();
  request.pool = this->Pool;
  this->SetRequest(request);
  const auto isFinite = [](double number) { return std::isfinite(number); };
  if (!std::ranges::all_of(request.point_origin, isFinite))
  {
    throw granular::LimitError("PointOrigin must be finite");
  }
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Show(Shown& shown)
{
  granular::Request request = this->MakeRequest();
  request.piece = shown.Piece.Piece;
  request.pieces = shown.Piece.Pieces;
  std::vector<std::string> names;
  for (const ArrayChoice* choice : { &this->Points, &this->Cells })
  {
    const auto& wanted = choice->GetWanted();
    names.insert(names.end(), wanted.begin(), wanted.end());
  }
  granular::Communicator& group =
    this->Run.group(shown.Number, request, names, this->GetRanks(), this->Alone);
  shown.Together = &group != &this->Alone;
  granular::Tables frame = this->Run.read(shown.Number, request,
    this->Run.known_offer(shown.Number), group, shown.Notices, shown.Progress);
  if (this->Run.kind().rows == granular::RowKind::Lines)
  {
    this->Cells.CheckNames(shown.Where.path, shown.Notices, frame.rows.schema);
    this->FillLines(shown, frame, request);
  }
  else
  {
    this->Points.CheckNames(shown.Where.path, shown.Notices, frame.rows.schema);
    this->Cells.CheckNames(shown.Where.path, shown.Notices, frame.bonds.schema);
    this->FillParticles(shown, frame, request);
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::FillBox(
  Shown& shown, const granular::Table& rows, const granular::Request& request)
{
  auto* box =
    vtkUnstructuredGrid::GetData(shown.Outputs, shown.Outputs->GetNumberOfInformationObjects() - 1);
  if (shown.Piece.Piece == 0 && rows.header.has_box &&
    !vtkGranularPrivate::FillBox(box, rows.header.box, rows.coordinates, request.point_origin))
  {
    shown.Notices.push_back({ shown.Where, "the box is not finite and not shown" });
  }
  FillFieldData(box->GetFieldData(), rows, request.point_origin);
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::FillLines(
  Shown& shown, granular::Tables& frame, const granular::Request& request)
{
  auto* lines = vtkPolyData::GetData(shown.Outputs, 0);
  auto* rows = vtkTable::GetData(shown.Outputs, 1);
  FillRows(rows, frame.rows);
  FillFieldData(lines->GetFieldData(), frame.rows, request.point_origin);
  FillFieldData(rows->GetFieldData(), frame.rows, request.point_origin);
  FillBox(shown, frame.rows, request);
  if (frame.rows.has_lines)
  {
    vtkGranularPrivate::FillLines(lines, rows, frame.rows, request, shown.Where, shown.Notices);
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::FillParticles(
  Shown& shown, granular::Tables& frame, const granular::Request& request)
{
  granular::Table& rows = frame.rows;
  auto* particles = vtkPolyData::GetData(shown.Outputs, 0);
  vtkGranularPrivate::FillParticles(
    particles, rows, request.single_precision, this->GetVertices(), this->Vertices, this->Pool);
  FillFieldData(particles->GetFieldData(), rows, request.point_origin);
  FillBox(shown, rows, request);
  if (this->Run.kind().has_bonds)
  {
    auto* lines = vtkPolyData::GetData(shown.Outputs, 1);
    vtkNew<vtkTable> bonds;
    FillRows(bonds, frame.bonds);
    FillFieldData(lines->GetFieldData(), frame.bonds, request.point_origin);
    vtkGranularPrivate::FillLines(lines, bonds, frame.bonds, request, shown.Where, shown.Notices);
  }
  if (!frame.groups.empty())
  {
    AddFact(particles->GetFieldData(), MakeStrings("Groups", frame.groups));
  }
  FillLeftOut(shown.Outputs, request);
}
