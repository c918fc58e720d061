// SPDX-License-Identifier: BSD-3-Clause
// What cannot be read: one clear error, empty outputs, and the reader goes on with the next file.
#include "reader_helpers.h"

#include "vtkErrorCode.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace
{
struct Bad
{
  const char* name;
  std::string text;
  std::string error; ///< after the path
  unsigned long code;
};

const std::string Header = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n";
const std::string Box = "ITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n";

std::vector<Bad> BadFiles()
{
  const unsigned long format = vtkErrorCode::FileFormatError;
  return {
    { "empty", "", ": expected a dump, got an empty file", format },
    { "garbage", "this is not a dump\n",
      ":1: expected ITEM: TIMESTEP, UNITS or TIME, got 'this is not a dump'", format },
    { "negative", Header + "-5\n" + Box + "ITEM: ATOMS id x y z\n",
      ":4: expected a number of atoms >= 0, got '-5'", format },
    { "huge", Header + "9000000000000000000\n" + Box + "ITEM: ATOMS id x y z\n1 0 0 0\n",
      ":1: expected 9000000000000000000 rows, got 1", format },
    { "no_number", Header + "many\n" + Box + "ITEM: ATOMS id x y z\n1 0 0 0\n",
      ":4: expected a number of atoms, got 'many'", format },
    { "no_coordinates", Header + "1\n" + Box + "ITEM: ATOMS id type\n1 1\n",
      ":1: expected columns of coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu), got 'id "
      "type'",
      format },
    { "short_row", Header + "2\n" + Box + "ITEM: ATOMS id x y z\n1 0 0\n2 0 0 0\n",
      ":10: expected 4 words in a row, got 3", format },
    { "bad_value", Header + "1\n" + Box + "ITEM: ATOMS id x y z\n1 0 zero 0\n",
      ":10: column 'y': expected a number, got 'zero'", format },
    { "no_box", Header + "1\nITEM: ATOMS id x y z\n1 0 0 0\n",
      ":5: expected ITEM: BOX BOUNDS before ITEM: ATOMS, got none", format },
  };
}

void ExpectEmpty(Reader& reader)
{
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reader.Particles()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 0);
}

void ExpectGood(Reader& reader)
{
  reader.Open(Good("grains_1000.dump"));
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
}
}

TEST(ReaderErrors, SayWhereAndWhatAndLeaveNothing)
{
  for (const Bad& bad : BadFiles())
  {
    const std::string file = WriteFile(std::string(bad.name) + ".dump", bad.text);
    Reader reader({ Good("grains_1000.dump") });
    reader->Update();
    ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
    reader.Open(file);
    reader->Update();
    ASSERT_EQ(reader.Said->Errors.size(), 1u) << bad.name;
    EXPECT_EQ(reader.Said->Errors[0], file + bad.error);
    EXPECT_EQ(reader->GetErrorCode(), bad.code) << bad.name;
    ExpectEmpty(reader);
    ExpectGood(reader);
    EXPECT_EQ(reader.Said->Errors.size(), 1u) << bad.name;
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
  EXPECT_EQ(reader.Said->Errors[0], GRANULAR_OUTPUT ": expected a file, got a directory");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::CannotOpenFileError));
  ExpectGood(reader);
}

TEST(ReaderErrors, NoPermission)
{
  const std::string file = WriteFile("secret.dump", Frame(0, 1, "id x y z", "1 0 0 0\n"));
  std::filesystem::permissions(file, std::filesystem::perms::none);
  // root may read everything: be somebody else meanwhile, if the folder lets others in
  const bool root = geteuid() == 0;
  if (root && (seteuid(65534) != 0 || faccessat(AT_FDCWD, GRANULAR_OUTPUT, X_OK, AT_EACCESS) != 0))
  {
    EXPECT_EQ(seteuid(0), 0);
    GTEST_SKIP() << "this user may read every file";
  }
  Reader reader({ file });
  reader->Update();
  EXPECT_FALSE(vtkGranularDumpReader::CanReadFile(file.c_str()));
  if (root)
  {
    ASSERT_EQ(seteuid(0), 0);
  }
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_EQ(reader.Said->Errors[0], file + ": cannot open: Permission denied");
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

TEST(ReaderErrors, AFileThatWasReplacedOrShortenedWhileOpen)
{
  const std::string text =
    Frame(0, 1, "id x y z", "1 0 0 0\n") + Frame(10, 2, "id x y z", "1 0 0 1\n2 0 0 2\n");
  for (const std::string& now : { text.substr(0, text.size() - 10), std::string(text.size(), 'x') })
  {
    const std::string file = WriteFile("replaced.dump", text);
    Reader reader({ file });
    reader->Update();
    WriteFile("replaced.dump", now);
    reader->UpdateTimeStep(10);
    ASSERT_EQ(reader.Said->Errors.size(), 1u);
    EXPECT_EQ(reader.Said->Errors[0].rfind(file, 0), 0u) << reader.Said->Errors[0];
    EXPECT_NE(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    ExpectEmpty(reader);
    ExpectGood(reader);
  }
}

TEST(ReaderErrors, ADumpCutAnywhereShowsItsCompleteFrames)
{
  const std::string frames[] = { Frame(0, 0, "id x y z ", ""),
    Frame(10, 2, "id x y z ", "1 0.5 0 1 \n2 0.25 0 2 \n"), Frame(20, 1, "id x y z", "1 0 0 1\n") };
  const std::string text = frames[0] + frames[1] + frames[2];
  const std::size_t ends[] = { frames[0].size(), frames[0].size() + frames[1].size(), text.size() };
  for (std::size_t length = 0; length <= text.size(); ++length)
  {
    const std::size_t complete = (length >= ends[0]) + (length >= ends[1]) + (length >= ends[2]);
    Reader reader({ WriteFile("cut.dump", text.substr(0, length)) });
    reader->Update();
    if (complete == 0)
    {
      EXPECT_EQ(reader.Said->Errors.size(), 1u) << length;
      ExpectEmpty(reader);
      continue;
    }
    ASSERT_EQ(reader.Times().size(), complete) << length;
    reader->UpdateTimeStep(1000);
    EXPECT_TRUE(reader.Said->Errors.empty()) << length;
    const vtkIdType points[] = { 0, 2, 1 };
    EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), points[complete - 1]) << length;
  }
}

TEST(ReaderErrors, OneBadFileInASeriesIsAWarningAndTheOthersAreShown)
{
  Reader reader({ Good("grains_1000.dump"), WriteFile("broken.dump", "ITEM: TIMESTEP\nx\n") });
  reader->Update();
  EXPECT_TRUE(reader.Said->Errors.empty());
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  reader->SetStride(2);
  reader->Update();
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
}

TEST(ReaderErrors, AWarningIsGivenOnceAFile)
{
  const std::string file =
    WriteFile("large_type.dump", Frame(0, 2, "id type x y z", "1 1.5 0 0 0\n2 2 0 0 0\n"));
  Reader reader({ file });
  reader->Update();
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_EQ(reader.Array("type")->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(reader.Numbers("type")->GetComponent(0, 0), 1.5);
  reader->SetSortById(true);
  reader->Update();
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
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

TEST(ReaderErrors, ASettingThatCannotBeIsRefused)
{
  Reader reader({ Good("grains.dump") });
  reader->SetStride(0);
  reader->SetTimestepSize(-1);
  ASSERT_EQ(reader.Said->Errors.size(), 2u);
  EXPECT_NE(reader.Said->Errors[0].find("Stride must be at least 1, got 0"), std::string::npos);
  EXPECT_NE(reader.Said->Errors[1].find("TimestepSize must be finite and greater than 0, got -1"),
    std::string::npos);
  EXPECT_EQ(reader->GetStride(), 1);
  EXPECT_EQ(reader->GetTimestepSize(), 1);
}

TEST(ReaderCanReadFile, LooksAtTheContent)
{
  const auto can = [](const std::string& file)
  { return vtkGranularDumpReader::CanReadFile(file.c_str()) != 0; };
  for (const char* name : { "grains.dump", "grains_0.dump", "grains_label.dump", "ortho_plain.dump",
         "ortho_unwrapped.dump", "tri_scaled.dump" })
  {
    EXPECT_TRUE(can(Good(name))) << name;
  }
  EXPECT_FALSE(can(WriteFile("local.dump",
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n0\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\n"
    "ITEM: ENTRIES c_1\n")));
  EXPECT_FALSE(can(WriteFile("other.dump", "-- PostgreSQL database dump\n")));
  EXPECT_FALSE(can(WriteFile("binary.dump", std::string(1000, '\0'))));
  EXPECT_FALSE(can(WriteFile("nothing.dump", "")));
  EXPECT_FALSE(can(GRANULAR_OUTPUT));
  EXPECT_FALSE(can("/no/such/file.dump"));
  EXPECT_FALSE(vtkGranularDumpReader::CanReadFile(nullptr));
}

TEST(ReaderErrors, TheSameNoticeOfEveryFrameIsOneWarning)
{
  std::string text;
  for (int step = 0; step < 6; ++step)
  {
    text += Frame(step, 1, "id x y", "1 0 0\n");
  }
  Reader reader({ WriteFile("flat.dump", text) });
  for (int step = 0; step < 6; ++step)
  {
    reader->UpdateTimeStep(step);
  }
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(reader.Said->Warnings[0].find("no column for the coordinate z"), std::string::npos);
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

TEST(ReaderErrors, EveryFrameThatIsLeftOutIsSaid)
{
  const std::string good = Frame(0, 1, "id x y z", "1 0 0 0\n");
  const std::string bad = Frame(1, 2, "id x y z", "1 0 0 0\n");
  Reader reader({ WriteFile("bad.dump", bad + bad + good) });
  reader->Update();
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(reader.Said->Warnings[0].find("bad.dump:1: "), std::string::npos);
  EXPECT_NE(reader.Said->Warnings[0].find("bad.dump:11: "), std::string::npos);
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
