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

  /// How often a new writer waits for the disk, with a setting of Durable or none.
  template <class WriterClass>
  long Syncs(vtkAlgorithm* input, const std::string& name, int durable = -1)
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
    const std::string one = "one" + ending;
    const std::string many = "many_*" + ending;
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, one), 2); // the file, and its name
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, many), 0);
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, one, WriterClass::DURABLE_AUTOMATIC), 2);
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, many, WriterClass::DURABLE_AUTOMATIC), 0);
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, one, WriterClass::DURABLE_ON), 2);
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, many, WriterClass::DURABLE_ON), 2);
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, one, WriterClass::DURABLE_OFF), 0);
    EXPECT_EQ(this->Syncs<WriterClass>(reader.Get, many, WriterClass::DURABLE_OFF), 0);
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
