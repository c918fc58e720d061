// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/processes.h"

#include "private/request/abort.h"

#include "vtkAlgorithm.h"
#include "vtkMultiProcessController.h"

namespace vtkGranularPrivate
{
Processes::Processes()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
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
    self->Modified();
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
  }
  return !failed;
}
}
