// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: ranks write one file, whose bytes do not tell how many they were; and what goes wrong on one of them
// is an error of all.
#include "reader_ranks.h"
#include "writer_helpers.h"

#include "../support/small_disk.h"

#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkVariantArray.h"

#include <functional>
#include <optional>

namespace
{
constexpr int All = 30000; ///< several reports of progress on each rank
const std::string Old = "the old file";

/// Grains at three times: each piece has its share of them, in order; what is wrong with a piece can be said.
class Source : public vtkPolyDataAlgorithm
{
public:
  static Source* New();
  vtkTypeMacro(Source, vtkPolyDataAlgorithm);

  std::function<bool(vtkPolyData*, double)> Change = [](vtkPolyData*, double) { return true; };
  std::function<bool(int)> Has = [](int) { return true; }; ///< whether a piece has any

protected:
  Source() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double times[] = { 0, 10, 20 };
    const double range[] = { 0, 20 };
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 3);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* info = outputs->GetInformationObject(0);
    const int piece = info->Get(Pipeline::UPDATE_PIECE_NUMBER());
    const int pieces = info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
    const double time =
      info->Has(Pipeline::UPDATE_TIME_STEP()) ? info->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
    int holders = 0;
    int before = 0;
    for (int i = 0; i < pieces; ++i)
    {
      holders += this->Has(i) ? 1 : 0;
      before += i < piece && this->Has(i) ? 1 : 0;
    }
    const int first = All * before / holders;
    const int end = this->Has(piece) ? All * (before + 1) / holders : first;
    const auto data = MakeParticles(end - first);
    std::vector<int> ids;
    for (int i = first; i < end; ++i)
    {
      data->GetPoints()->SetPoint(i - first, i % 10, 0.001 * (i % 7919), time / 8);
      ids.push_back(1 + i * 7919 % All); // no two are the same
    }
    AddArray<vtkIntArray>(data, "id", ids);
    AddArray<vtkIntArray>(data, "type", std::vector<int>(ids.size(), 1));
    data->GetFieldData()->RemoveArray("timestep"); // the time is it
    auto* output = vtkPolyData::GetData(info);
    output->ShallowCopy(data);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return this->Change(output, time) ? 1 : 0;
  }
};

vtkStandardNewMacro(Source);

class WriterRanks : public ReaderRanks
{
protected:
  /// Rank 0 writes, or looks: all have one folder, that of rank 0.
  void SetUp() override
  {
    ReaderRanks::SetUp();
    this->Ranks.all_gather("");
    std::filesystem::current_path("../0");
    this->Ranks.all_gather("");
  }

  /// What is in the file when all have written it.
  std::string Bytes(const std::string& name)
  {
    this->Ranks.all_gather("");
    std::string bytes = Content(name);
    this->Ranks.all_gather("");
    return bytes;
  }

  /// What one process alone writes.
  std::string Alone(Source* source, const std::string& name, int sorted)
  {
    const std::string own = std::to_string(this->Rank()) + "_alone_" + name;
    Writer writer(own);
    writer->SetController(nullptr);
    writer->SetInputConnection(source->GetOutputPort());
    writer->SetSortById(sorted);
    writer->WriteTimeStepsOn();
    EXPECT_EQ(writer->Write(), 1);
    return Content(own);
  }

  /// Write() fails on all, and says the same.
  void ExpectFault(Writer& writer, const std::string& text)
  {
    if (this->Rank() == 0)
    {
      std::ofstream(writer->GetFileName()) << Old;
    }
    this->Ranks.all_gather("");
    EXPECT_EQ(writer->Write(), 0);
    std::string said = "code " + std::to_string(writer->GetErrorCode());
    for (const std::string& error : writer.Said->Errors)
    {
      said += ": " + error;
    }
    writer.Said->Errors.clear();
    EXPECT_NE(said.find(text), std::string::npos) << said;
    this->ExpectSame(said);
    EXPECT_EQ(this->Bytes(writer->GetFileName()), Old);
    EXPECT_EQ(Beside("./x"), std::vector<std::string>{ writer->GetFileName() });
    this->Ranks.all_gather("");
  }
};
}

TEST_F(WriterRanks, TheBytesAreThoseOfOne)
{
  vtkNew<Source> source;
  for (const char* name : { "a.dump", "a.bin", "a.dump.gz", "a.dump.zst" })
  {
    for (const int sorted : { 0, 1 })
    {
      const std::string alone = this->Alone(source, name, sorted);
      EXPECT_GT(alone.size(), 100000u);
      for (const int mode : { vtkGranularWriter::GATHER, vtkGranularWriter::MPI_IO })
      {
        for (const int without : { -1, 0, 1 })
        {
          if (without >= 0 && this->Size() == 1)
          {
            continue;
          }
          source->Has = [&](int piece) { return piece != without; };
          source->Modified();
          Writer writer(name);
          writer->SetInputConnection(source->GetOutputPort());
          writer->SetParallelMode(mode);
          writer->SetSortById(sorted);
          writer->WriteTimeStepsOn();
          EXPECT_EQ(writer->Write(), 1);
          EXPECT_TRUE(this->Bytes(name) == alone) << name << " " << sorted << mode << without;
          source->Has = [](int) { return true; };
          source->Modified();
        }
      }
    }
  }
}

TEST_F(WriterRanks, TheInputCannotBeMadeOnOne)
{
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    for (const double when : { 0.0, 10.0, 20.0 })
    {
      vtkNew<Source> source;
      vtkNew<Messages> silent;
      source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent);
      source->Change = [&](vtkPolyData*, double time)
      { return this->Rank() != rank || time != when; };
      Writer writer("a.dump");
      writer->SetInputConnection(source->GetOutputPort());
      writer->WriteTimeStepsOn();
      this->ExpectFault(writer, "a.dump: the input could not be made, and nothing is written");
    }
  }
}

TEST_F(WriterRanks, AnArrayIsWrongOnOne)
{
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    for (const int mode : { vtkGranularWriter::GATHER, vtkGranularWriter::MPI_IO })
    {
      vtkNew<Source> source;
      source->Change = [&](vtkPolyData* data, double time)
      {
        if (this->Rank() == rank && time == 10)
        {
          AddArray<vtkDoubleArray>(data, "n", { 1, 2 });
        }
        return true;
      };
      Writer writer("a.dump");
      writer->SetInputConnection(source->GetOutputPort());
      writer->SetParallelMode(mode);
      writer->WriteTimeStepsOn();
      this->ExpectFault(writer, "column 'n': expected a value for each of ");
      source->Change = [](vtkPolyData*, double) { return true; };
      source->Modified();
      EXPECT_EQ(writer->Write(), 1);
      this->Ranks.all_gather("");
      if (this->Rank() == 0)
      {
        std::filesystem::remove("a.dump");
      }
    }
  }
}

TEST_F(WriterRanks, OneDoesNotSeeTheFile)
{
  for (int rank = 1; rank < this->Size(); ++rank)
  {
    if (this->Rank() == 0)
    {
      Write("a.dump", Old);
    }
    std::filesystem::current_path("../" + std::to_string(this->Rank() == rank ? rank : 0));
    vtkNew<Source> source;
    Writer writer("a.dump");
    writer->SetInputConnection(source->GetOutputPort());
    writer->SetParallelMode(vtkGranularWriter::MPI_IO);
    this->Ranks.all_gather("");
    writer.ExpectError(vtkErrorCode::FileNotFoundError,
      "a.dump: cannot write: No such file or directory (on rank " + std::to_string(rank) + " of " +
        std::to_string(this->Size()) + ")");
    writer->SetParallelMode(vtkGranularWriter::GATHER);
    EXPECT_EQ(writer->Write(), 1);
    std::filesystem::current_path("../0");
    EXPECT_EQ(this->Bytes("a.dump").substr(0, 15), "ITEM: TIMESTEP\n");
    EXPECT_EQ(Beside("./x"), std::vector<std::string>{ "a.dump" });
    this->Ranks.all_gather("");
  }
}

TEST_F(WriterRanks, AFullDisk)
{
  std::optional<SmallDisk> disk;
  if (this->Rank() == 0)
  {
    disk.emplace("disk");
  }
  if (!this->OnAny(disk && disk->there()))
  {
    GTEST_SKIP() << SmallDisk::not_there;
  }
  std::filesystem::current_path("disk");
  for (const char* name : { "a.dump", "a.bin", "a.dump.gz", "own_%.dump" })
  {
    for (const int mode : { vtkGranularWriter::GATHER, vtkGranularWriter::MPI_IO })
    {
      vtkNew<Source> source;
      Writer writer(name);
      writer->SetInputConnection(source->GetOutputPort());
      writer->SetParallelMode(mode);
      writer->SetNumberFormat("%.17g");
      writer->WriteTimeStepsOn();
      this->ExpectFault(writer, "cannot write: No space left on device");
      EXPECT_EQ(
        writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::OutOfDiskSpaceError));
      if (this->Rank() == 0)
      {
        std::filesystem::remove(name);
      }
    }
  }
  std::filesystem::current_path("..");
  this->Ranks.all_gather("");
}

TEST_F(WriterRanks, AbortedOnOne)
{
  vtkNew<Source> source;
  for (const char* name : { "a.dump", "a.bin" })
  {
    for (const int mode : { vtkGranularWriter::GATHER, vtkGranularWriter::MPI_IO })
    {
      for (int at = 1; at < 6; ++at)
      {
        Writer writer(name);
        writer->SetInputConnection(source->GetOutputPort());
        writer->SetParallelMode(mode);
        writer->WriteTimeStepsOn();
        vtkNew<Stopper> stopper;
        stopper->At = this->Rank() == this->Size() - 1 ? at : 0;
        writer->AddObserver(vtkCommand::ProgressEvent, stopper);
        this->ExpectFault(writer, "code 0");
        stopper->At = 0;
        EXPECT_EQ(writer->Write(), 1);
        this->Ranks.all_gather("");
        if (this->Rank() == 0)
        {
          std::filesystem::remove(name);
        }
      }
    }
  }
}

TEST_F(WriterRanks, WhatAnyOfThemLeavesOutIsToldOnce)
{
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    vtkNew<Source> source;
    source->Has = [&](int piece) { return piece == rank; };
    source->Change = [&](vtkPolyData* data, double)
    {
      if (this->Rank() == rank)
      {
        vtkNew<vtkVariantArray> variants;
        variants->SetName("mixed");
        variants->SetNumberOfTuples(data->GetNumberOfPoints());
        data->GetPointData()->AddArray(variants);
      }
      return true;
    };
    Writer writer("a.dump");
    writer->SetInputConnection(source->GetOutputPort());
    writer->WriteTimeStepsOn();
    EXPECT_EQ(writer->Write(), 1);
    EXPECT_EQ(writer.Said->Warnings,
      this->Rank() > 0
        ? std::vector<std::string>{}
        : (std::vector<std::string>{ "the array 'mixed' of the type variant is left out",
            "the input has no field data 'timestep': its time is taken for it" }));
  }
}

int main(int argc, char** argv)
{
  return RunWithController(argc, argv);
}
