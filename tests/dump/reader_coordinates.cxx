// SPDX-License-Identifier: BSD-3-Clause
// Coordinate styles, and which rows are kept.
#include "reader_helpers.h"

#include <set>

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

TEST(ReaderPrecision, OriginIsSubtractedBeforeRounding)
{
  const std::string file = WriteFile("far.dump",
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n"
    "1000000 1000001\n0 1\n0 1\nITEM: ATOMS id x y z\n"
    "1 1000000.0000012345 0.5 0.25\n2 1000000.5 0 1\n");
  Reader reader({ file });
  reader->SetPointPrecision(vtkAlgorithm::SINGLE_PRECISION);
  reader->SetPointOrigin(1e6, 0, 0);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetPoints()->GetDataType(), VTK_FLOAT);
  const auto exact = static_cast<float>(1000000.0000012345 - 1e6);
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], exact);
  EXPECT_EQ(reader.Particles()->GetPoint(1)[0], 0.5);
  EXPECT_EQ(reader.Field("PointOrigin")->GetComponent(0, 0), 1e6);
  EXPECT_EQ(reader.Field("BoxOrigin")->GetComponent(0, 0), 1e6);
  EXPECT_EQ(reader.Box()->GetBounds()[0], 0);
  EXPECT_EQ(reader.Box()->GetBounds()[1], 1);
  reader->SetPointOrigin(0, 0, 0);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], 1e6);
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
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  reader->SetPointOrigin(-1e6, 0, 0);
  reader->UpdateTimeStep(1);
  EXPECT_EQ(reader.Said->Warnings.size(), 2u);
}

TEST(ReaderRows, StrideKeepsTheSameIdsInEveryFrame)
{
  Reader reader({ Good("grains.dump") });
  reader->SetStride(7);
  std::vector<std::set<double>> kept;
  for (double step : { 1000., 2000. })
  {
    reader->UpdateTimeStep(step);
    kept.emplace_back();
    for (vtkIdType i = 0; i < reader.Particles()->GetNumberOfPoints(); ++i)
    {
      kept.back().insert(reader.Numbers("id")->GetComponent(i, 0));
    }
  }
  std::set<double> expected;
  for (int id = 7; id <= 1200; id += 7)
  {
    expected.insert(id);
  }
  EXPECT_EQ(kept[0], expected);
  EXPECT_EQ(kept[1], expected);
}

TEST(ReaderRows, RegionIsInAbsoluteCoordinatesWhateverThePointsAre)
{
  const PlainFrame plain = ReadPlain(Good("grains.dump"))[2];
  std::vector<double> expected;
  for (std::size_t row = 0; row < plain.rows; ++row)
  {
    const double x = plain.Number("x", row), z = plain.Number("z", row);
    if (x >= -0.02 && x <= 0.03 && z >= 0.01 && z <= 0.05)
    {
      expected.push_back(plain.Number("id", row));
    }
  }
  ASSERT_GT(expected.size(), 10u);
  for (int coordinates : { 0, 1, 2 })
  {
    Reader reader({ Good("grains.dump") });
    reader->SetCoordinates(coordinates);
    reader->SetPointOrigin(5, 5, 5);
    reader->SetRegionOfInterest(-0.02, 0.03, 1, -1, 0.01, 0.05);
    reader->UpdateTimeStep(2000);
    std::vector<double> ids;
    for (vtkIdType i = 0; i < reader.Particles()->GetNumberOfPoints(); ++i)
    {
      ids.push_back(reader.Numbers("id")->GetComponent(i, 0));
    }
    EXPECT_EQ(ids, expected) << coordinates;
    EXPECT_EQ(reader.Numbers("v")->GetNumberOfTuples(), static_cast<vtkIdType>(ids.size()));
    EXPECT_EQ(reader.Particles()->GetNumberOfVerts(), static_cast<vtkIdType>(ids.size()));
  }
}

TEST(ReaderRows, SortingOrdersAllArraysById)
{
  const PlainFrame plain = ReadPlain(Good("grains.dump"))[1];
  std::map<long, std::size_t> rows;
  for (std::size_t row = 0; row < plain.rows; ++row)
  {
    rows[std::stol(plain.columns.at("id")[row])] = row;
  }
  Reader reader({ Good("grains.dump") });
  reader->SetSortById(true);
  reader->UpdateTimeStep(1000);
  ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  vtkIdType i = 0;
  for (const auto& [id, row] : rows)
  {
    ASSERT_EQ(reader.Numbers("id")->GetComponent(i, 0), id);
    ASSERT_EQ(reader.Numbers("radius")->GetComponent(i, 0), plain.Number("radius", row));
    ASSERT_EQ(reader.Numbers("omega")->GetComponent(i, 1), plain.Number("omegay", row));
    ASSERT_EQ(reader.Numbers("type")->GetComponent(i, 0), plain.Number("type", row));
    ASSERT_EQ(reader.Particles()->GetPoint(i)[2], plain.Number("z", row));
    ++i;
  }
}
