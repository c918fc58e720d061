// SPDX-License-Identifier: BSD-3-Clause
// Files of the VTK writers that survive a loss of power: what waits for the disk, by the property Durable.
#include "vtkGranularDecompositionReader.h"
#include "vtkGranularDecompositionWriter.h"
#include "vtkGranularDumpReader.h"
#include "vtkGranularDumpWriter.h"
#include "vtkGranularEulerReader.h"
#include "vtkGranularEulerWriter.h"
#include "vtkGranularLocalReader.h"
#include "vtkGranularLocalWriter.h"

#include "../support/failing_calls.h"
#include "../support/observer.h"
#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
class DurableClasses : public OwnFolder
{
protected:
  void TearDown() override { stop_failing(); }

  /// Returns the number of times that a new writer waits for the disk.
  template <class WriterClass>
  long Syncs(vtkAlgorithm* input, const std::string& name, int durable)
  {
    Watched<WriterClass> writer;
    writer->SetInputConnection(input->GetOutputPort());
    writer->SetFileName(this->path(name).c_str());
    if (durable >= 0)
    {
      writer->SetDurable(durable);
    }
    make_fail({ CallFault::Error, FailingCalls::always, 1, calls::sync });
    EXPECT_EQ(writer->Write(), 1);
    stop_failing();
    EXPECT_TRUE(writer.Seen->Said.empty()) << writer.Seen->Said.front();
    return calls_that_may_fail();
  }

  template <class ReaderClass, class WriterClass>
  void Check(const std::string& input, const std::string& ending)
  {
    Watched<ReaderClass> reader;
    reader->AddFileName((std::string(GRANULAR_DATA) + "/good/" + input).c_str());
    struct Case
    {
      int Durable; ///< -1: as it is by default
      long OfOne;  ///< the file, and its name
      long OfMany;
    };
    for (const Case& each : { Case{ -1, 2, 0 }, Case{ WriterClass::DURABLE_AUTOMATIC, 2, 0 },
           Case{ WriterClass::DURABLE_ON, 2, 2 }, Case{ WriterClass::DURABLE_OFF, 0, 0 } })
    {
      EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, "one" + ending, each.Durable), each.OfOne);
      EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, "many_*" + ending, each.Durable), each.OfMany);
    }
    Watched<WriterClass> writer;
    writer->SetDurable(3);
    EXPECT_EQ(writer->GetDurable(), WriterClass::DURABLE_AUTOMATIC);
    ASSERT_EQ(writer.Seen->Said.size(), 1U);
    EXPECT_NE(writer.Seen->Said[0].find("expected Durable"), std::string::npos)
      << writer.Seen->Said[0];
  }
};
}

TEST_F(DurableClasses, DumpWriter)
{
  this->Check<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", ".dump");
}

TEST_F(DurableClasses, LocalWriter)
{
  this->Check<vtkGranularLocalReader, vtkGranularLocalWriter>("local/contacts.dump", ".bonds");
}

TEST_F(DurableClasses, EulerWriter)
{
  this->Check<vtkGranularEulerReader, vtkGranularEulerWriter>("euler_1000.vtk", ".euler");
}

TEST_F(DurableClasses, DecompositionWriter)
{
  this->Check<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", ".decomposition");
}
