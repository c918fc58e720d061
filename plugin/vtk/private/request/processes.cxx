// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/processes.h"

#include "granular/parallel/executor.h"

#include "vtkAlgorithm.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkMultiProcessController.h"
#include "vtkOutputWindow.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "granular/mpi/mpi_communicator.h"

#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#endif

#include <algorithm>
#include <cstring>
#include <utility>

namespace vtkGranularPrivate
{
namespace
{
/**
 * Passes on what an executive says, but what follows from a failure that was told.
 */
void PassOn(vtkObject*, unsigned long, void*, void* text)
{
  const auto* words = static_cast<const char*>(text);
  if (words && !std::strstr(words, "returned failure for request") &&
    !std::strstr(words, "No whole extent has been set"))
  {
    vtkOutputWindowDisplayErrorText(words);
  }
}

/**
 * Returns the ranks of a controller, all of which must call this; a single rank if there is no controller or it is not
 * an MPI controller.
 */
std::unique_ptr<granular::Communicator> MakeRanks(vtkMultiProcessController* controller)
{
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  auto* mpi =
    controller ? vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()) : nullptr;
  if (mpi && mpi->GetNumberOfProcesses() > 1)
  {
    return granular::MpiCommunicator::make(*mpi->GetMPIComm()->GetHandle());
  }
#else
  static_cast<void>(controller);
#endif
  return std::make_unique<granular::SerialCommunicator>();
}
}

Processes::Processes()
  : Controller(vtkMultiProcessController::GetGlobalController())
  , Quieter(vtkSmartPointer<vtkCallbackCommand>::New())
{
  this->Quieter->SetCallback(PassOn);
}

Processes::~Processes() = default;

vtkMultiProcessController* Processes::GetController() const
{
  return this->Controller;
}

bool Processes::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller == controller)
  {
    return false;
  }
  this->Controller = controller;
  this->Ranks.reset();
  return true;
}

granular::Communicator& Processes::Get()
{
  if (!this->Ranks)
  {
    this->Ranks = MakeRanks(this->Controller);
  }
  return *this->Ranks;
}

void Processes::BeginUpdate(vtkAlgorithm* self)
{
  if (this->Cancelled)
  {
    self->SetAbortExecute(0);
    MarkStopped(self, false);
  }
  if (this->Cancelled || this->Refused)
  {
    this->Cancelled = false;
    this->Refused = false;
    const bool same = this->ErrorTime == self->GetMTime();
    self->Modified();
    this->ErrorTime = same ? self->GetMTime() : this->ErrorTime;
  }
}

void Processes::Forget(vtkAlgorithm* self)
{
  this->Message.clear();
  this->LastError.clear();
  SetErrorCode(self, vtkErrorCode::NoError);
}

Outcome Processes::Fail(vtkAlgorithm* self, const Failure& failure)
{
  this->Message = failure.Text;
  if (failure.End == Outcome::Cancelled)
  {
    MarkStopped(self, true);
    return failure.End;
  }
  this->Quiet(self->GetExecutive());
  if (this->LastError != failure.Text || this->ErrorTime != self->GetMTime())
  {
    vtkErrorWithObjectMacro(self, << failure.Text);
    this->LastError = failure.Text;
    this->ErrorTime = self->GetMTime();
  }
  SetErrorCode(self, failure.Code);
  return failure.End;
}

void Processes::Quiet(vtkExecutive* executive)
{
  if (!executive->HasObserver(vtkCommand::ErrorEvent, this->Quieter))
  {
    executive->AddObserver(vtkCommand::ErrorEvent, this->Quieter);
  }
}

int Processes::EndRequest(vtkAlgorithm* self, Outcome outcome)
{
  this->Cancelled = outcome == Outcome::Cancelled;
  this->Refused = outcome == Outcome::Refused;
  const bool failed = outcome == Outcome::Failed || this->Refused;
  if (failed)
  {
    // who asked to stop, while another rank failed, has had the answer
    self->SetAbortExecute(0);
    MarkStopped(self, false);
    this->ErrorTime = self->GetMTime(); // what was cleaned up after the failure is no change
  }
  return !failed;
}

void Processes::Warn(vtkAlgorithm* self, const std::vector<Remark>& remarks)
{
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(self->GetExecutive());
  const vtkMTimeType time = pipeline ? pipeline->GetPipelineMTime() : 0;
  const std::set<std::string> before =
    time == this->WarnedTime ? std::exchange(this->Warned, {}) : std::set<std::string>();
  this->Warned.clear();
  this->WarnedTime = time;
  for (const Remark& remark : remarks)
  {
    if (this->Warned.insert(remark.Topic).second && !before.contains(remark.Topic))
    {
      vtkWarningWithObjectMacro(self, << remark.Text);
    }
  }
}

int ChooseThreads(int wanted, const granular::Communicator& ranks)
{
  if (wanted > 0)
  {
    return wanted;
  }
  // a rank that is bound to some cores has these for itself
  return std::clamp(granular::machine_cores() / ranks.node_size(), 1, granular::available_cores());
}
}
