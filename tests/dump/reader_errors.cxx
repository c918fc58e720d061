// SPDX-License-Identifier: BSD-3-Clause
// What cannot be read: one clear error, empty outputs, and the reader goes on with the next file.
#include "reader_helpers.h"

#include <algorithm>
#include <cmath>
#include <utility>

TEST(ReaderErrors, SayWhereAndWhatAndLeaveNothing)
{
  const std::pair<std::string, std::string> cases[] = {
    { GRANULAR_DATA "/bad/number_word.dump",
      ":4: expected a number of atoms, got 'two'" }, // when opened
    { GRANULAR_DATA "/bad/row_word.dump",
      ":11: column 'y': expected a number, got 'half'" }, // when read
  };
  for (const auto& [file, error] : cases)
  {
    Reader reader({ Good("grains_1000.dump") });
    reader->Update();
    ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
    reader.Open(file);
    reader->Update();
    EXPECT_EQ(reader.Said->Errors, std::vector<std::string>{ file + error });
    EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileFormatError));
    ExpectEmpty(reader);
    ExpectGood(reader);
    EXPECT_EQ(reader.Said->Errors.size(), 1u);
  }
}

TEST(ReaderErrors, NoFileName)
{
  Reader reader;
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_EQ(reader.Said->Errors[0], "no file to read: set FileNames first");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoFileNameError));
  ExpectGood(reader);
}

TEST(ReaderErrors, MissingFile)
{
  Reader reader({ "/no/such/file.dump" });
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_EQ(reader.Said->Errors[0], "/no/such/file.dump: cannot open: No such file or directory");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileNotFoundError));
  ExpectEmpty(reader);
  ExpectGood(reader);
}

TEST(ReaderErrors, Directory)
{
  Reader reader({ GRANULAR_OUTPUT });
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_EQ(reader.Said->Errors[0],
    GRANULAR_OUTPUT ": expected a file, got a directory: name the files in it");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::CannotOpenFileError));
  ExpectGood(reader);
}

TEST(ReaderErrors, AreToldOnceUntilSomethingChanges)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->Update();
  const std::string file = WriteFile("mended.dump", "");
  reader.Open(file);
  reader->Update();
  reader->Update(); // pipelines ask again and again
  EXPECT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_EQ(reader->GetErrorMessage(), reader.Said->Errors[0]);
  EXPECT_NE(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  reader->SetStride(2);
  reader->Update();
  EXPECT_EQ(reader.Said->Errors.size(), 2u);
  WriteFile("mended.dump", Frame(0, 1, "id x y z", "1 0 0 0\n"));
  reader->Refresh();
  reader->Update();
  EXPECT_EQ(reader.Said->Errors.size(), 2u);
  EXPECT_STREQ(reader->GetErrorMessage(), "");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0); // ids that are multiples of 2
}

TEST(ReaderErrors, AnArrayThatNoFrameHasIsAWarning)
{
  Reader reader({ Good("grains.dump") });
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->EnableArray("radios");
  reader->UpdateTimeStep(1000);
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(
    reader.Said->Warnings[0].find("no frame has the array 'radios' asked for"), std::string::npos);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
}

TEST(ReaderCanReadFile, LooksAtTheContent)
{
  EXPECT_TRUE(vtkGranularDumpReader::CanReadFile(Good("grains.dump").c_str()));
  EXPECT_FALSE(vtkGranularDumpReader::CanReadFile(GRANULAR_DATA "/bad/local.dump"));
  EXPECT_FALSE(vtkGranularDumpReader::CanReadFile(GRANULAR_OUTPUT));
  EXPECT_FALSE(vtkGranularDumpReader::CanReadFile("/no/such/file.dump"));
  EXPECT_FALSE(vtkGranularDumpReader::CanReadFile(nullptr));
}

TEST(ReaderErrors, AColumnThatIsWidenedInEveryFrameIsOneWarning)
{
  std::string text;
  for (int step = 0; step < 4; ++step)
  {
    text += Frame(step, 1, "id type x y z", "1 " + std::to_string(step) + ".5 0 0 0\n");
  }
  Reader reader({ WriteFile("types.dump", text) });
  for (int step = 0; step < 4; ++step)
  {
    reader->UpdateTimeStep(step);
    EXPECT_EQ(reader.Numbers("type")->GetComponent(0, 0), step + 0.5);
  }
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
}

TEST(ReaderErrors, HundredsOfBadFramesAreOneShortWarning)
{
  std::string text = Frame(0, 1, "id x y z", "1 0 0 0\n");
  for (int step = 1; step < 200; ++step)
  {
    text +=
      Frame(step, 2 + step, "id x y z", "1 0 0 0\n") + Frame(step, 1, "id x y z", "1 0 0 0\n");
  }
  Reader reader({ WriteFile("bad.dump", text) });
  reader->Update();
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  const std::string& said = reader.Said->Warnings[0];
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 10) << said;
  EXPECT_NE(said.find("and 189 more"), std::string::npos) << said;
}

TEST(ReaderErrors, APointOriginThatIsNoNumber)
{
  Reader reader({ Good("grains.dump") });
  reader->SetPointOrigin(0, std::nan(""), 0);
  reader->UpdateTimeStep(1000);
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_NE(reader.Said->Errors[0].find("PointOrigin must be finite"), std::string::npos);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
}
