// SPDX-License-Identifier: BSD-3-Clause
// Calls of the system that fail once, through VTK: the next update looks again. The reference is the output of a reader that was not
// disturbed.
#include "vtkGranularDecompositionReader.h"
#include "vtkGranularDumpReader.h"
#include "vtkGranularEulerReader.h"
#include "vtkGranularLocalReader.h"
#include "vtkGranularRestartReader.h"

#include "../support/failing_calls.h"
#include "../support/observer.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace
{
/// Times, and every value of every array of all outputs.
std::string Content(vtkAlgorithm* reader)
{
  std::ostringstream text;
  text.precision(17);
  for (int port = 0; port < reader->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* info = reader->GetOutputInformation(port);
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    for (int i = 0; i < info->Length(Pipeline::TIME_STEPS()); ++i)
    {
      text << info->Get(Pipeline::TIME_STEPS())[i] << " ";
    }
    vtkDataObject* output = reader->GetOutputDataObject(port);
    for (int type = 0; type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
    {
      text << "\n" << output->GetNumberOfElements(type);
      vtkFieldData* arrays = output->GetAttributesAsFieldData(type);
      for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* array = arrays->GetAbstractArray(i);
        text << "\n" << array->GetName();
        for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
        {
          text << " " << array->GetVariantValue(value).ToString();
        }
      }
    }
  }
  return text.str();
}

template <class Algorithm>
void Open(Watched<Algorithm>& reader, const std::vector<std::string>& files)
{
  for (const std::string& file : files)
  {
    reader->AddFileName((std::string(GRANULAR_DATA) + "/good/" + file).c_str());
  }
}

/// What may be done where an update has failed.
enum class Again
{
  Update,  ///< another update
  Refresh, ///< one after Refresh
  Follow   ///< one that looks whether files have changed
};

template <class Algorithm>
void TryAll(const std::vector<std::string>& files)
{
  Watched<Algorithm> undisturbed;
  Open(undisturbed, files);
  undisturbed->Update();
  const std::string whole = Content(undisturbed.Get);
  const std::size_t said = undisturbed.Seen->Said.size();
  ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
  for (const Again again : { Again::Update, Again::Refresh, Again::Follow })
  {
    for (const CallFault fault : { CallFault::End, CallFault::Error })
    {
      bool fired = true;
      long number = 1;
      for (; fired; ++number)
      {
        Watched<Algorithm> reader;
        Open(reader, files);
        reader->SetRefreshOnUpdate(again == Again::Follow);
        make_fail({ fault, number, 1 });
        reader->Update();
        fired = calls_that_may_fail() >= number;
        make_fail({});
        const bool failed = reader->GetErrorCode() != 0;
        EXPECT_TRUE(failed || reader.Seen->Said.size() > said || Content(reader.Get) == whole);
        if (again == Again::Refresh)
        {
          reader->Refresh();
        }
        reader->Update();
        const bool looks = failed || again != Again::Update;
        EXPECT_TRUE(!looks || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole))
          << "fault " << static_cast<int>(fault) << " at call " << number << ", again "
          << static_cast<int>(again) << ": "
          << (reader.Seen->Said.empty() ? "" : reader.Seen->Said.back());
      }
      EXPECT_GT(number, 3);
    }
  }
}
}

TEST(ReaderFailingReads, OfText)
{
  TryAll<vtkGranularDumpReader>({ "chain.dump" });
}

TEST(ReaderFailingReads, OfBinary)
{
  TryAll<vtkGranularDumpReader>({ "ortho_scaled.bin" });
}

TEST(ReaderFailingReads, OfCompressed)
{
  TryAll<vtkGranularDumpReader>({ "ortho_000000.dump.gz", "ortho_000050.dump.gz" });
}

TEST(ReaderFailingReads, OfContacts)
{
  TryAll<vtkGranularLocalReader>({ "local/pieces_3000.0.dump", "local/pieces_3000.1.dump",
    "local/pieces_3000.2.dump", "local/pieces_3000.3.dump" });
}

TEST(ReaderFailingReads, OfRestarts)
{
  TryAll<vtkGranularRestartReader>({ "restart/half.restart" });
  TryAll<vtkGranularRestartReader>({ "restart/parts.base.restart" });
}

TEST(ReaderFailingReads, OfEulerCells)
{
  TryAll<vtkGranularEulerReader>({ "euler_1000.vtk", "euler_2000.vtk" });
}

TEST(ReaderFailingReads, OfDecompositions)
{
  TryAll<vtkGranularDecompositionReader>({ "decomposition_1000.vtk", "decomposition_2000.vtk" });
  TryAll<vtkGranularDecompositionReader>({ "decomposition/text.vtu" });
}
