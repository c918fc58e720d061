// SPDX-License-Identifier: BSD-3-Clause
// Coordinate styles, and which rows are kept: what the settings do is for read_dump.cpp and rounding.cpp.
#include "reader_helpers.h"

#include "../support/vtk_arrays.h"

TEST(ReaderCoordinatesNotice, SaysOnceWhatItCannotGive)
{
  Reader reader({ Good("ortho_plain.dump") });
  reader->SetCoordinates(vtkGranularDumpReader::UNWRAPPED);
  reader->Update();
  EXPECT_TRUE(reader.Said->Errors.empty());
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(reader.Said->Warnings[0].find("ix"), std::string::npos) << reader.Said->Warnings[0];
  EXPECT_EQ(reader.Text("Coordinates"), "Absolute");
  reader->SetVertices(vtkGranularDumpReader::NO_VERTICES);
  reader->Update();
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
}

/// Of two frames that lose digits the first is told, and the second where the origin is another that is no better.
TEST(ReaderPrecision, LostDigitsAreToldOnceAFile)
{
  std::string text;
  for (const char* step : { "0", "1" })
  {
    text += std::string("ITEM: TIMESTEP\n") + step +
      "\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n1000000 1000001\n0 1\n0 1\n"
      "ITEM: ATOMS id x y z radius\n1 1000000.0" +
      step + " 0.5 0.25 0.01\n";
  }
  Reader reader({ WriteFile("far.dump", text) });
  reader->SetPointPrecision(vtkAlgorithm::SINGLE_PRECISION);
  reader->UpdateTimeStep(1);
  EXPECT_EQ(reader.Particles()->GetPoints()->GetDataType(), VTK_FLOAT);
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(reader.Said->Warnings[0].find("rounding to single precision moves points by up to 0.01 "
                                          "along x, where the smallest radius is 0.01; set "
                                          "PointOrigin"),
    std::string::npos)
    << reader.Said->Warnings[0];
  reader->UpdateTimeStep(0);
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  reader->SetPointOrigin(1e6, 0, 0);
  reader->UpdateTimeStep(1);
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], static_cast<float>(1000000.01 - 1e6));
  EXPECT_EQ(reader.Field("PointOrigin")->GetComponent(0, 0), 1e6);
  EXPECT_EQ(reader.Field("BoxOrigin")->GetComponent(0, 0), 1e6);
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  reader->SetPointOrigin(-1e6, 0, 0);
  reader->UpdateTimeStep(1);
  EXPECT_EQ(reader.Said->Warnings.size(), 2u);
}

TEST(ReaderRows, StrideRegionAndOrderArePassed)
{
  Reader reader({ WriteFile(
    "rows.dump", Frame(0, 4, "id x y z q", "6 3 0 0 60\n4 1 0 0 40\n2 9 0 0 20\n3 2 0 0 30\n")) });
  const auto charges = [&reader]
  {
    reader->Update();
    return ValuesOf(reader.Array("q"));
  };
  EXPECT_EQ(charges(), (Values{ 60, 40, 20, 30 }));
  reader->SetStride(0);
  EXPECT_EQ(reader.Said->Errors, std::vector<std::string>{ "Stride must be at least 1, got 0" });
  reader->SetStride(2);
  EXPECT_EQ(charges(), (Values{ 60, 40, 20 }));
  reader->SetRegionOfInterest(0, 5, 1, -1, 0, 1);
  EXPECT_EQ(charges(), (Values{ 60, 40 }));
  EXPECT_EQ(reader.Particles()->GetNumberOfVerts(), 2);
  reader->SetSortById(true);
  EXPECT_EQ(charges(), (Values{ 40, 60 }));
}

/// As a pipeline asks for them, one after the other; what is in them is for frame_parts.cpp.
TEST(ReaderRows, PiecesTogetherAreTheWhole)
{
  for (const bool sorted : { false, true })
  {
    Reader reader({ Good("pieces_1000.0.dump"), Good("pieces_1000.1.dump"),
      Good("pieces_1000.2.dump"), Good("pieces_1000.3.dump") });
    reader->SetSortById(sorted);
    reader->Update();
    const Values whole = ValuesOf(reader.Array("id"));
    ASSERT_EQ(whole.size(), 1200u);
    for (const int pieces : { 5, 1300 })
    {
      Values parts;
      for (int piece = 0; piece < pieces; ++piece)
      {
        reader->UpdatePiece(piece, pieces, 0);
        const Values part = ValuesOf(reader.Array("id"));
        parts.insert(parts.end(), part.begin(), part.end());
        EXPECT_EQ(reader.Particles()->GetNumberOfVerts(), static_cast<vtkIdType>(part.size()));
        EXPECT_EQ(reader.Box()->GetNumberOfCells(), piece == 0 ? 1 : 0);
        EXPECT_EQ(reader.Text("Coordinates"), "Absolute");
      }
      EXPECT_EQ(parts, whole) << pieces;
    }
    EXPECT_TRUE(reader.Said->Errors.empty());
  }
}
