// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong: one error that says what, the old file as it was, and the next Write() is right.
#include "writer_helpers.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkTable.h"
#include "vtkTrivialProducer.h"

#include <cmath>

namespace
{
using Lines = std::vector<std::string>;
const std::string Old = "the old file";

/// A name with an old file behind it.
std::string OldName()
{
  return WriteFile("a.dump", Old);
}

void ExpectOld(Writer& writer)
{
  EXPECT_EQ(Content(writer->GetFileName()), Old);
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{ "a.dump" });
}

vtkSmartPointer<vtkPolyData> Large()
{
  auto data = MakeParticles(200000);
  return data;
}
}

TEST(WriterErrors, NothingToWriteOrNowhere)
{
  Writer writer(NewName("a.dump"));
  writer.ExpectError(vtkErrorCode::UnknownError, "no input: expected points to write");
  vtkNew<vtkTrivialProducer> nothing;
  writer->SetInputConnection(nothing->GetOutputPort());
  writer.ExpectError(vtkErrorCode::FileFormatError,
    std::string(writer->GetFileName()) + ": expected a vtkPointSet to write, got a vtkDataObject");
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{});
  writer->SetInputData(MakeParticles(1));
  writer->SetFileName(nullptr);
  writer.ExpectError(vtkErrorCode::NoFileNameError, "no file to write: set FileName first");
  writer->SetFileName("");
  writer.ExpectError(vtkErrorCode::NoFileNameError, "no file to write: set FileName first");
}

TEST(WriterErrors, OtherThanPoints)
{
  Writer writer(OldName());
  const std::string path = writer->GetFileName();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeParticles(2));
  blocks->SetBlock(1, MakeParticles(2));
  writer->SetInputData(blocks);
  writer.ExpectError(vtkErrorCode::FileFormatError,
    path +
      ": expected a vtkPointSet to write, got a vtkMultiBlockDataSet: the filter MergeBlocks makes "
      "one of it");
  vtkNew<vtkTable> table;
  writer->SetInputData(table);
  writer.ExpectError(
    vtkErrorCode::FileFormatError, path + ": expected a vtkPointSet to write, got a vtkTable");
  ExpectOld(writer);
}

TEST(WriterErrors, PropertiesOutOfRangeChangeNothing)
{
  Writer writer;
  writer->SetStyle(2);
  writer->SetStyle(-1);
  writer->SetDialect(3);
  writer->SetParallelMode(-1);
  writer->SetThreads(-1);
  EXPECT_EQ(writer.Said->Errors,
    (Lines{ "expected Style 0 (Atom) or 1 (Custom), got 2",
      "expected Style 0 (Atom) or 1 (Custom), got -1",
      "expected Dialect 0 (LIGGGHTS) or 1 (LAMMPS) or 2 (Automatic), got 3",
      "expected ParallelMode 0 (Gather) or 1 (MPI-IO), got -1",
      "expected Threads of at least 0, got -1" }));
  EXPECT_EQ(writer->GetStyle(), 1);
  EXPECT_EQ(writer->GetDialect(), 2);
  EXPECT_EQ(writer->GetParallelMode(), 0);
  EXPECT_EQ(writer->GetThreads(), 0);
}

TEST(WriterErrors, PropertiesThatMakeNoSense)
{
  Writer writer(OldName());
  writer->SetInputData(MakeParticles(2));
  const auto expect = [&](const std::string& text)
  { writer.ExpectError(vtkErrorCode::UnknownError, text); };
  writer->SetNumberFormat("%d");
  expect(
    "expected a number format of Automatic, %g, %.Ng with N from 1 to 17, or shortest, got '%d'");
  writer->SetNumberFormat("%g");
  writer->SetColumns("id colour");
  expect("column 'colour': expected an array to make it from, got none: there are no arrays");
  writer->SetColumns("");
  for (const char* boundary : { "pp pp", "pp pp pq", "p p q", "pp pp pp pp", "pppppp" })
  {
    writer->SetBoundary(boundary);
    expect(std::string("expected boundaries as in 'pp pp ff' or 'p p f', of p, f, s and m, got '") +
      boundary + "'");
  }
  writer->SetBoundary("");
  writer->WriteUnitsOn();
  expect("expected the units of the frame for ITEM: UNITS, got none");
  writer->WriteUnitsOff();
  writer->WriteTimeOn();
  expect("expected the time of the frame for ITEM: TIME, got none");
  writer->WriteTimeOff();
  writer->SetBoxOrigin(0, std::nan(""), 0);
  const double flat[9] = { 1, 0, 0, 0, 0, 0, 0, 0, 1 };
  writer->SetBoxVectors(flat);
  expect("expected BoxOrigin and BoxVectors of finite numbers, got nan");
  writer->SetBoxOrigin(0, 0, 0);
  writer->SetColumns("xs ys zs");
  expect("expected a box with a length along y to scale coordinates by, got one of length 0");
  ExpectOld(writer);
  writer->SetColumns("");
  writer->SetBoxVectors(std::vector<double>(9, 0).data());
  EXPECT_EQ(writer.Rows().size(), 2u);
}

TEST(WriterErrors, ProgressGoesFrom0To1AndNeverBack)
{
  Reader reader({ Good("grains.dump") });
  for (const bool all : { false, true })
  {
    for (const bool sorted : { false, true })
    {
      Writer writer(NewName("a.dump"));
      writer->SetInputConnection(reader->GetOutputPort());
      writer->SetWriteTimeSteps(all);
      writer->SetSortById(sorted);
      vtkNew<Stopper> progress;
      writer->AddObserver(vtkCommand::ProgressEvent, progress);
      EXPECT_EQ(writer->Write(), 1);
      EXPECT_TRUE(std::is_sorted(progress->Reported.begin(), progress->Reported.end()));
      EXPECT_EQ(progress->Reported.front(), 0);
      EXPECT_EQ(progress->Reported.back(), 1);
      EXPECT_GE(progress->Reported.size(), all ? 4u : 2u);
    }
  }
}

TEST(WriterErrors, AbortedAtAnyReportTheOldFileIsAsItWas)
{
  for (const char* end : { "a.dump", "a.dump.gz", "a.bin" })
  {
    vtkNew<Stopper> counter;
    Writer counted(NewName(end));
    counted->SetInputData(Large());
    counted->SetThreads(1);
    counted->AddObserver(vtkCommand::ProgressEvent, counter);
    ASSERT_EQ(counted->Write(), 1);
    const std::string whole = Content(counted->GetFileName());
    const int reports = static_cast<int>(counter->Reported.size());
    ASSERT_GE(reports, 4);
    // the last one comes when all is done
    for (int at = 1; at < reports; at += std::max(1, reports / 6))
    {
      Writer writer(WriteFile(end, Old));
      writer->SetInputData(Large());
      writer->SetThreads(1);
      vtkNew<Stopper> stopper;
      stopper->At = at;
      writer->AddObserver(vtkCommand::ProgressEvent, stopper);
      EXPECT_EQ(writer->Write(), 0) << at;
      EXPECT_EQ(writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
      EXPECT_TRUE(writer.Said->Errors.empty());
      EXPECT_EQ(Content(writer->GetFileName()), Old);
      EXPECT_EQ(Beside(writer->GetFileName()).size(), 1u);
      EXPECT_EQ(writer->Write(), 1) << at;
      EXPECT_EQ(Content(writer->GetFileName()), whole);
      std::filesystem::remove(writer->GetFileName());
    }
  }
}

TEST(WriterErrors, AReaderThatIsAbortedWritesNothing)
{
  Reader reader({ Good("grains.dump") });
  vtkNew<Stopper> stopper;
  stopper->At = 1;
  reader->UpdateInformation();
  reader->AddObserver(vtkCommand::ProgressEvent, stopper);
  Writer writer(OldName());
  writer->SetInputConnection(reader->GetOutputPort());
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_TRUE(writer.Said->Errors.empty());
  ExpectOld(writer);
  EXPECT_EQ(writer->Write(), 1);
}

TEST(WriterErrors, UpdateWritesToo)
{
  Writer writer(NewName("a.dump"));
  writer->SetInputData(MakeParticles(2));
  writer->Update();
  EXPECT_TRUE(writer->GetWritten());
  EXPECT_NE(Content(writer->GetFileName()).find("OF ATOMS\n2\n"), std::string::npos);
}

TEST(WriterErrors, EachWarningOnceAFile)
{
  Reader reader({ Good("grains.dump") });
  Writer writer(NewName("a.dump"));
  reader->GetPointDataArraySelection()->DisableArray("id");
  writer->SetInputConnection(reader->GetOutputPort());
  writer->WriteTimeStepsOn();
  for (int times = 1; times <= 2; ++times)
  {
    EXPECT_EQ(writer->Write(), 1);
    EXPECT_EQ(writer.Said->Warnings,
      Lines(times, "no array 'id': ids are the numbers of the rows, from 1"));
  }
}
