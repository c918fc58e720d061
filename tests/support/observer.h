// SPDX-License-Identifier: BSD-3-Clause
// What an algorithm tells while it works, and how it is asked to stop.
#ifndef granular_tests_support_observer_h
#define granular_tests_support_observer_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <cstddef>
#include <string>
#include <vector>

/// Keeps what is said, and asks to stop at the n-th report of progress.
class Observer : public vtkCommand
{
public:
  static Observer* New() { return new Observer; }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    if (event != vtkCommand::ProgressEvent)
    {
      this->Said.push_back(static_cast<const char*>(data));
      return;
    }
    this->Reported.push_back(*static_cast<double*>(data));
    if (this->Reported.size() == this->StopAt)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }

  std::vector<std::string> Said; ///< errors and warnings
  std::vector<double> Reported;
  std::size_t StopAt = 0; ///< 0: never
};

/// An algorithm, and who hears it; what its executive says of its failures is kept from the terminal.
template <class Algorithm>
struct Watched
{
  vtkNew<Algorithm> Get;
  vtkNew<Observer> Seen;
  vtkNew<Observer> OfPipeline;

  Watched()
  {
    for (const unsigned long event :
      { vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ProgressEvent })
    {
      this->Get->AddObserver(event, this->Seen);
    }
    this->Get->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->OfPipeline);
  }

  Algorithm* operator->() { return this->Get; }
};

#endif
