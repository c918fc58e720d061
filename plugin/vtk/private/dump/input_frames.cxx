// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/input_frames.h"

#include "private/request/guard.h"
#include "private/request/request_task.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <string>
#include <string_view>

namespace vtkGranularPrivate
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

InputFrames::InputFrames(vtkAlgorithm* consumer, const Part& part, int input)
  : Wanted(part)
{
  this->Source = consumer->GetInputAlgorithm(input, 0, this->Port);
  this->Source->UpdateInformation();
  this->Info = this->Source->GetOutputInformation(this->Port);
}

InputFrames::~InputFrames()
{
  auto* pipeline = Pipeline::SafeDownCast(this->Source->GetExecutive());
  if (this->TimeBefore && pipeline)
  {
    this->Info->Set(Pipeline::UPDATE_TIME_STEP(), *this->TimeBefore);
    pipeline->PropagateUpdateExtent(this->Port);
  }
}

std::vector<double> InputFrames::GetTimes() const
{
  const double* times = this->Info->Get(Pipeline::TIME_STEPS());
  return times ? std::vector<double>(times, times + this->Info->Length(Pipeline::TIME_STEPS()))
               : std::vector<double>();
}

vtkDataObject* InputFrames::GetData() const
{
  return this->Source->GetOutputDataObject(this->Port);
}

std::optional<double> InputFrames::GetTime() const
{
  vtkDataObject* data = this->GetData();
  vtkInformation* info = data ? data->GetInformation() : nullptr;
  return info && info->Has(vtkDataObject::DATA_TIME_STEP())
    ? std::optional(info->Get(vtkDataObject::DATA_TIME_STEP()))
    : std::nullopt;
}

void InputFrames::Update(std::optional<double> time, granular::Communicator& ranks,
  const std::string& consequence, const granular::Where& where)
{
  granular::agree(ranks, nullptr);
  const bool made = this->UpdateHere(time);
  granular::do_together(ranks,
    [&]
    {
      if (IsMarkedStopped<vtkAlgorithm>(this->Info))
      {
        throw granular::Cancelled{};
      }
      if (!made || !this->GetData())
      {
        throw granular::Error(
          "the input could not be made" + consequence + ": see the messages before", where);
      }
    });
}

void InputFrames::Restore(granular::Communicator& ranks)
{
  if (this->TimeBefore)
  {
    this->Update(this->TimeBefore, ranks);
  }
}

/**
 * Returns false if that fails on this rank.
 */
bool InputFrames::UpdateHere(std::optional<double> time)
{
  if (time)
  {
    if (!this->TimeBefore)
    {
      const std::vector<double> times = this->GetTimes();
      this->TimeBefore = this->GetShownTime().value_or(times.empty() ? *time : times.front());
    }
    this->Info->Set(Pipeline::UPDATE_TIME_STEP(), *time);
  }
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(this->Port + 1);
  vtkInformation* request = requests->GetInformationObject(this->Port);
  request->Set(Pipeline::UPDATE_PIECE_NUMBER(), this->Wanted.Piece);
  request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), this->Wanted.Pieces);
  request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), this->Wanted.GhostLevels);
  this->Source->UpdateInformation();
  ForgetPieces(this->Info);
  return this->Source->Update(this->Port, requests) != 0;
}

/**
 * The time that the nearest of those before was asked for: a filter that is new, as ParaView puts some before
 * writers, has not been asked yet.
 */
std::optional<double> InputFrames::GetShownTime() const
{
  vtkAlgorithm* algorithm = this->Source;
  for (int port = this->Port; algorithm;)
  {
    vtkInformation* info = algorithm->GetOutputInformation(port);
    if (info->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      return info->Get(Pipeline::UPDATE_TIME_STEP());
    }
    const bool more =
      algorithm->GetNumberOfInputPorts() > 0 && algorithm->GetNumberOfInputConnections(0) > 0;
    algorithm = more ? algorithm->GetInputAlgorithm(0, 0, port) : nullptr;
  }
  return {};
}

void CheckTimes(const std::vector<double>& times, granular::Communicator& ranks)
{
  const std::string_view own(
    reinterpret_cast<const char*>(times.data()), times.size() * sizeof(double));
  const std::vector<std::string> all = ranks.all_gather(own);
  if (all.front() != own)
  {
    throw granular::Error("expected the time steps of the first process, got others");
  }
}
}
