// SPDX-License-Identifier: BSD-3-Clause
// What an algorithm tells while it works, and how it is asked to stop.
#ifndef granular_tests_support_observer_h
#define granular_tests_support_observer_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
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

  /// Returns all that was said since the last call, without the place in the sources that VTK puts before it.
  std::vector<std::string> TakeSaid()
  {
    std::vector<std::string> texts;
    for (std::string text : std::exchange(this->Seen->Said, {}))
    {
      const std::size_t start = text.find("): ");
      text.erase(0, start == std::string::npos ? 0 : start + 3);
      text.erase(text.find_last_not_of('\n') + 1);
      texts.push_back(text);
    }
    return texts;
  }

  /// Expects that nothing was said, or one thing with this in it.
  void ExpectSaid(const std::string& text)
  {
    const std::vector<std::string> said = std::exchange(this->Seen->Said, {});
    ASSERT_EQ(said.size(), text.empty() ? 0u : 1u) << text << (said.empty() ? "" : ": " + said[0]);
    EXPECT_TRUE(text.empty() || said[0].find(text) != std::string::npos) << said[0];
  }
};

#endif
