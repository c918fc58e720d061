// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEulerReader.h"

#include "private/euler/euler_cells.h"
#include "private/readers/series_reader.h"
#include "private/request/guard.h"

#include "granular/formats/euler/euler_file.h"
#include "granular/formats/euler/regular_grids.h"
#include "granular/formats/grid_dump/grid_dump.h"

#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkGranularEulerReader);

namespace
{
/**
 * Form of the data of all frames, as the first one that has cells tells.
 */
struct Form
{
  vtkTypeInt64 Step = 0;    ///< of that frame
  bool IsImage = true;      ///< one grid; else any number of them
  granular::EulerGrid Grid; ///< of an image; without cells if no frame has any
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<Form>& form)
{
  archive.number(form.Step);
  archive.number(form.IsImage);
  archive.number(form.Grid);
}

/**
 * Reads cells, of which there may be several files, and finds the grids that they form, if wanted. Errors name the file.
 */
granular::EulerFrame ReadCells(const granular::Kind& kind,
  const std::vector<granular::FramePiece>& pieces,
  const std::function<bool(std::string_view)>& wanted, int threads,
  std::vector<granular::RegularGrid>* grids, granular::Notices& notices,
  granular::Progress& progress)
{
  granular::EulerFrame all = kind.cells(pieces, wanted, threads, notices, progress);
  if (grids)
  {
    NameFile(granular::where_of(pieces.front().file.path, pieces.front().entry),
      [&] { *grids = granular::find_regular_grids(all, notices); });
  }
  return all;
}

std::string ToString(const std::array<std::int64_t, 3>& counts)
{
  return std::to_string(counts[0]) + " x " + std::to_string(counts[1]) + " x " +
    std::to_string(counts[2]);
}

/**
 * The pipeline has been told what image there is, for all frames.
 */
void CheckImage(const Form& form, const std::vector<granular::RegularGrid>& grids)
{
  if (grids.size() > 1 || (grids.size() == 1 && grids.front().grid.counts != form.Grid.counts))
  {
    throw granular::UnsupportedError("expected a grid of " + ToString(form.Grid.counts) +
      " cells as at timestep " + std::to_string(form.Step) + ", got " +
      (grids.size() > 1 ? std::to_string(grids.size()) + " grids"
                        : ToString(grids.front().grid.counts)) +
      ": with the output Points all can be shown");
  }
}

/**
 * The smallest box around points, or around all grids.
 */
granular::Box FindBounds(
  const granular::EulerFrame& frame, const std::vector<granular::RegularGrid>& grids)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  granular::Vector3 lo = { infinity, infinity, infinity };
  granular::Vector3 hi = { -infinity, -infinity, -infinity };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto add = [&](double from, double to)
    {
      lo[axis] = std::min(lo[axis], from); // no nan becomes a bound
      hi[axis] = std::max(hi[axis], to);
    };
    for (const granular::RegularGrid& each : grids)
    {
      add(each.grid.lo[axis], each.grid.hi[axis]);
    }
    for (std::size_t i = axis; grids.empty() && i < frame.centres.size(); i += 3)
    {
      add(frame.centres[i], frame.centres[i]);
    }
    if (!(lo[axis] <= hi[axis]))
    {
      lo[axis] = hi[axis] = 0;
    }
  }
  return granular::Box::from_bounds(lo, hi);
}

/**
 * A part of a grid, as an image in which its cells have the numbers that they have in the grid.
 */
void FillGrid(vtkImageData* image, const granular::EulerFrame& frame,
  const granular::RegularGrid& grid, const CellExtent& extent)
{
  FillImage(image, grid.grid, extent, frame, { ExtentOf(grid.grid), grid.first }, {});
}

/**
 * Each grid is on one rank. All ranks have the same partitions, empty or not: some filters of ParaView wait for each other
 * with each.
 */
void FillBlocks(vtkPartitionedDataSet* output, const granular::EulerFrame& frame,
  const std::vector<granular::RegularGrid>& grids, const PieceRequest& piece)
{
  const auto [begin, end] = piece.RangeOf(static_cast<vtkTypeInt64>(grids.size()));
  output->SetNumberOfPartitions(static_cast<unsigned int>(grids.size()));
  for (vtkTypeInt64 i = begin; i < end; ++i)
  {
    vtkNew<vtkImageData> image;
    FillGrid(image, frame, grids[i], ExtentOf(grids[i].grid));
    output->SetPartition(static_cast<unsigned int>(i), image);
  }
}
}

//------------------------------------------------------------------------------
struct vtkGranularEulerReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularEulerReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::euler_kind)
    , Reader(reader)
  {
  }

  const granular::Kind& FindKind() override
  {
    return granular::kind_of_first(this->GetRanks(),
      [this]() -> const granular::Kind&
      {
        return granular::is_grid_file(this->FileNames.front()) ? granular::grid_kind
                                                               : granular::euler_kind;
      });
  }

  std::string GetLookKey() const override { return std::to_string(this->Reader->OutputType); }
  void LookFurther() override;
  void Describe(vtkInformationVector* outputs) override;
  void Fill(Shown& shown, const granular::EulerFrame& frame,
    const std::vector<granular::RegularGrid>& grids) const;
  void Show(Shown& shown) override;

  vtkGranularEulerReader* const Reader;
  Form Known;
};

//------------------------------------------------------------------------------
void vtkGranularEulerReader::Internals::LookFurther()
{
  granular::ArchiveWriter packer;
  if (this->GetRanks().rank() == 0)
  {
    const granular::RunIndex& index = this->Run.index();
    const std::vector<granular::FramePiece> pieces =
      index.pieces(this->Run.kind().looked_at(index).front());
    Form form;
    form.Step = pieces.front().entry.timestep;
    if (this->Reader->OutputType == IMAGE_DATA)
    {
      AlgorithmProgress progress(this->Reader);
      granular::Notices notices; // are given again where cells are shown
      std::vector<granular::RegularGrid> grids;
      ReadCells(
        this->Run.kind(), pieces, [](std::string_view) { return false; }, this->GetThreads(),
        &grids, notices, progress);
      form.IsImage = grids.size() <= 1;
      form.Grid = grids.size() == 1 ? grids.front().grid : granular::EulerGrid{};
      ExtentOf(form.Grid); // can be had
    }
    pass(packer, std::as_const(form));
  }
  this->GetRanks().broadcast(packer.bytes, 0);
  granular::ArchiveReader unpacker{ packer.bytes };
  pass(unpacker, this->Known);
}

//------------------------------------------------------------------------------
// An image can be cut anywhere, all else is in pieces.
void vtkGranularEulerReader::Internals::Describe(vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Remove(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
  info->Remove(Pipeline::WHOLE_EXTENT());
  info->Remove(vtkDataObject::ORIGIN());
  info->Remove(vtkDataObject::SPACING());
  if (this->Reader->OutputType == IMAGE_DATA && this->Known.IsImage)
  {
    const granular::EulerGrid& grid = this->Known.Grid;
    const bool empty = grid.size() == 0;
    const CellExtent none = { 0, -1, 0, -1, 0, -1 };
    const CellExtent whole = empty ? none : ExtentOf(grid);
    const granular::Vector3 spacing = empty
      ? granular::Vector3{ 1, 1, 1 }
      : granular::Vector3{ grid.spacing(0), grid.spacing(1), grid.spacing(2) };
    info->Remove(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST());
    OfferExtent(info, whole);
    info->Set(vtkDataObject::ORIGIN(), grid.lo.data(), 3);
    info->Set(vtkDataObject::SPACING(), spacing.data(), 3);
  }
}

//------------------------------------------------------------------------------
void vtkGranularEulerReader::Internals::Fill(Shown& shown, const granular::EulerFrame& frame,
  const std::vector<granular::RegularGrid>& grids) const
{
  vtkDataObject* output = vtkDataObject::GetData(shown.Outputs);
  auto* image = vtkImageData::SafeDownCast(output);
  auto* blocks = vtkPartitionedDataSet::SafeDownCast(output);
  auto* points = vtkPolyData::SafeDownCast(output);
  if (this->Reader->OutputType == POINTS && points)
  {
    const auto [begin, end] = shown.Piece.RangeOf(frame.cells);
    FillPoints(points, frame, begin, end, {});
  }
  else if (this->Reader->OutputType == IMAGE_DATA && this->Known.IsImage && image)
  {
    CellExtent extent = {};
    if (!grids.empty())
    {
      extent = AskedExtent(shown.Port, ExtentOf(this->Known.Grid));
    }
    FillGrid(image, frame, grids.empty() ? granular::RegularGrid{} : grids.front(), extent);
  }
  else if (this->Reader->OutputType == IMAGE_DATA && !this->Known.IsImage && blocks)
  {
    FillBlocks(blocks, frame, grids, shown.Piece);
  }
  else
  {
    throw granular::Error("expected an output for what the files hold, got a " +
      std::string(output->GetClassName()) + ": the files have changed, update again");
  }
}

//------------------------------------------------------------------------------
// Each rank reads the whole frame, and keeps its part.
void vtkGranularEulerReader::Internals::Show(Shown& shown)
{
  shown.Progress.set_part(0, 0.9);
  const bool cells = this->Reader->OutputType == IMAGE_DATA;
  const auto wanted = [&](std::string_view name)
  {
    const std::string array(name);
    return this->Points.GetSelection()->ArrayExists(array.c_str()) == 0 ||
      this->Points.GetSelection()->ArrayIsEnabled(array.c_str()) != 0;
  };
  std::vector<granular::RegularGrid> grids;
  const granular::EulerFrame frame = ReadCells(this->Run.kind(), shown.Pieces, wanted,
    this->GetThreads(), cells ? &grids : nullptr, shown.Notices, shown.Progress);
  if (cells && this->Known.IsImage)
  {
    NameFile(shown.Where, [&] { CheckImage(this->Known, grids); });
  }
  granular::FrameHeader header;
  if (frame.header)
  {
    header = *frame.header;
  }
  else
  {
    header.box = FindBounds(frame, grids);
    header.box.boundary = "ff ff ff";
  }
  header.timestep = shown.Pieces.front().entry.timestep;
  this->Fill(shown, frame, grids);
  FillHeader(vtkDataObject::GetData(shown.Outputs)->GetFieldData(), header,
    granular::Coordinates::Absolute, {});
}

//------------------------------------------------------------------------------
vtkGranularEulerReader::vtkGranularEulerReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkDataObject" }); // see RequestDataObject
}

//------------------------------------------------------------------------------
int vtkGranularEulerReader::CanReadFile(const char* fileName)
{
  const std::string name = fileName ? fileName : "";
  return granular::is_euler_file(name) || granular::is_grid_file(name) ? 1 : 0;
}

//------------------------------------------------------------------------------
// There is an output whatever happens: of the type that there was, or of one that the files would make.
int vtkGranularEulerReader::RequestDataObject(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  const auto provide = [&](auto made)
  {
    vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
    if (!output || output->GetDataObjectType() != made->GetDataObjectType())
    {
      info->Set(vtkDataObject::DATA_OBJECT(), made);
    }
  };
  if (this->OutputType == POINTS)
  {
    provide(vtkNew<vtkPolyData>().Get());
    return 1;
  }
  if (!info->Get(vtkDataObject::DATA_OBJECT()))
  {
    provide(vtkNew<vtkImageData>().Get());
  }
  const Outcome outcome = Guard(this, *this->Ranks, outputVector,
    [&]
    {
      this->Series->Update();
      this->Series->LookOnce();
      if (static_cast<Internals&>(*this->Series).Known.IsImage)
      {
        provide(vtkNew<vtkImageData>().Get());
      }
      else
      {
        provide(vtkNew<vtkPartitionedDataSet>().Get());
      }
    });
  return this->Ranks->EndRequest(this, outcome);
}

//------------------------------------------------------------------------------
void vtkGranularEulerReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OutputType: " << (this->OutputType == POINTS ? "Points" : "ImageData") << "\n";
}
