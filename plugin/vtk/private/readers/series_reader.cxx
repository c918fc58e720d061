// SPDX-License-Identifier: BSD-3-Clause
#include "private/readers/series_reader.h"

#include "private/arrays/pool.h"
#include "private/local/lines.h"

#include "granular/common/pass.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <map>
#include <utility>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularSeriesReader::Internals::Found vtkGranularSeriesReader::Internals::Look(
  granular::ArchiveWriter&)
{
  return {};
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Take(granular::ArchiveReader&)
{
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Describe(vtkInformationVector*)
{
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
  const auto repeated = static_cast<granular::RepeatedSteps>(this->Self->RepeatedSteps);
  std::vector<std::string> columns = this->GetColumnNames();
  if (this->Valid && !this->Stale && this->IndexedNames == this->FileNames &&
    this->Options.repeated_steps == repeated && this->Options.column_names == columns)
  {
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
  this->Options.column_names = std::move(columns);
  this->Options.repeated_steps = repeated;
  this->Options.threads = this->GetThreads();
  granular::Notices notices;
  AlgorithmProgress progress(this->Self);
  granular::update_run_index(this->Index, ranks, this->FileNames, this->Options, notices, progress);
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
  granular::Communicator& ranks = this->GetRanks();
  granular::do_together(ranks,
    [&]
    {
      granular::ArchiveWriter own;
      granular::ArchiveWriter packer;
      if (ranks.rank() == 0)
      {
        const Found found = this->Look(own);
        granular::pass(packer, found.Points);
        granular::pass(packer, found.Cells);
        packer.bytes += own.bytes;
      }
      ranks.broadcast(packer.bytes, 0);
      granular::ArchiveReader unpacker{ packer.bytes };
      for (ArrayChoice* choice : { &this->Points, &this->Cells })
      {
        ArrayNames names;
        granular::pass(unpacker, names);
        choice->Offer(names);
      }
      this->Take(unpacker);
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
    // what is said of a column, or of all rows, holds for the next frames too; what is said of
    // frames is new for each
    const std::string about = ofFrames ? std::to_string(notice.where.line) : notice.where.column;
    const std::string what = !notice.topic.empty() ? notice.topic
      : ofFrames || about.empty()                  ? notice.text
                                                   : "";
    if (this->Told.insert(path + "\n" + about + "\n" + what).second && ++counts[path] <= most)
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
void vtkGranularSeriesReader::Internals::Run(vtkInformation* request, vtkInformationVector* outputs)
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
  const std::vector<double> times = this->Index.times(this->Self->TimestepSize);
  if (shown.Port->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    shown.Number = granular::RunIndex::find(times, shown.Port->Get(Pipeline::UPDATE_TIME_STEP()));
  }
  shown.Pieces = this->Index.pieces(shown.Number);
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
granular::Communicator& vtkGranularSeriesReader::Internals::FindGroup(
  Shown& shown, const std::function<void(granular::ArchiveWriter&)>& form)
{
  granular::ArchiveWriter same;
  same.number(shown.Piece.Pieces);
  same.number(shown.Number);
  form(same);
  for (const ArrayChoice* choice : { &this->Points, &this->Cells })
  {
    for (const std::string& name : choice->GetWanted())
    {
      same.text(name);
    }
  }
  granular::Communicator& ranks = this->GetRanks();
  const std::vector<std::string> all =
    ranks.all_gather(std::to_string(shown.Piece.Piece) + ' ' + same.bytes);
  shown.Together = shown.Piece.Pieces == ranks.size();
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    shown.Together = shown.Together && all[rank] == std::to_string(rank) + ' ' + same.bytes;
  }
  return shown.Together ? ranks : this->Alone;
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::PassForm(
  granular::ArchiveWriter& form, const granular::DumpRequest& request)
{
  form.number(request.coordinates);
  form.number(request.single_precision);
  form.number(request.point_origin);
  form.number(request.sort_by_id);
  form.number(request.stride);
  form.number(request.region);
}

//------------------------------------------------------------------------------
granular::Vector3 vtkGranularSeriesReader::Internals::CheckOrigin(const double origin[3])
{
  if (!std::all_of(origin, origin + 3, [](double number) { return std::isfinite(number); }))
  {
    throw granular::LimitError("PointOrigin must be finite");
  }
  return { origin[0], origin[1], origin[2] };
}

//------------------------------------------------------------------------------
granular::LineRequest vtkGranularSeriesReader::Internals::MakeLineRequest(
  int periodicLines, const double pointOrigin[3])
{
  return { static_cast<granular::PeriodicLines>(periodicLines), CheckOrigin(pointOrigin),
    this->GetThreads(), this->Pool };
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::FillParticles(Shown& shown, granular::DumpFrame& frame,
  const granular::Vector3& pointOrigin, bool singlePrecision, VertexCells cells)
{
  auto* particles = vtkPolyData::GetData(shown.Outputs, 0);
  auto* box =
    vtkUnstructuredGrid::GetData(shown.Outputs, shown.Outputs->GetNumberOfInformationObjects() - 1);
  vtkGranularPrivate::FillParticles(
    particles, frame, singlePrecision, cells, this->Vertices, this->Pool);
  if (shown.Piece.Piece == 0 && !FillBox(box, frame.header.box, frame.coordinates, pointOrigin))
  {
    shown.Notices.push_back({ shown.Where, "the box is not finite and not shown" });
  }
  FillFieldData(particles->GetFieldData(), frame, pointOrigin);
  FillFieldData(box->GetFieldData(), frame, pointOrigin);
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::FillBonds(
  Shown& shown, granular::LocalFrame& bonds, const granular::LineRequest& request)
{
  auto* lines = vtkPolyData::GetData(shown.Outputs, 1);
  vtkNew<vtkTable> rows;
  FillRows(rows, bonds);
  FillLines(lines, rows, bonds, request, shown.Where, shown.Notices);
  FillFieldData(lines->GetFieldData(), bonds.table, request.point_origin);
}
