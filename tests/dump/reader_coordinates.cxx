// SPDX-License-Identifier: BSD-3-Clause
// Coordinate styles, and which rows are kept.
#include "reader_helpers.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace
{
/// The same 500 atoms from any of the files: x y z of each id at step 100.
std::map<int, std::vector<double>> PositionsById(const std::string& file, int coordinates)
{
  Reader reader({ Good(file) });
  reader->SetCoordinates(coordinates);
  const std::vector<double> times = reader.Times();
  reader->UpdateTimeStep(times.back());
  EXPECT_TRUE(reader.Said->Errors.empty()) << file;
  std::map<int, std::vector<double>> positions;
  for (vtkIdType i = 0; i < reader.Particles()->GetNumberOfPoints(); ++i)
  {
    const double* p = reader.Particles()->GetPoint(i);
    positions[static_cast<int>(reader.Numbers("id")->GetComponent(i, 0))] = { p[0], p[1], p[2] };
  }
  EXPECT_EQ(positions.size(), 500u) << file;
  return positions;
}

/// What the simulation printed with 17 digits.
std::map<int, std::vector<double>> TruthById(const std::string& file, const std::string& suffix)
{
  const PlainFrame plain = ReadPlain(Good(file)).back();
  std::map<int, std::vector<double>> positions;
  for (std::size_t row = 0; row < plain.rows; ++row)
  {
    positions[static_cast<int>(plain.Number("id", row))] = { plain.Number("x" + suffix, row),
      plain.Number("y" + suffix, row), plain.Number("z" + suffix, row) };
  }
  return positions;
}

void ExpectNear(const std::map<int, std::vector<double>>& is,
  const std::map<int, std::vector<double>>& truth, double tolerance, const std::string& what)
{
  double largest = 0;
  for (const auto& [id, position] : is)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      largest = std::max(largest, std::abs(position[axis] - truth.at(id)[axis]));
    }
  }
  EXPECT_LE(largest, tolerance) << what;
}

class ReaderCoordinates : public testing::TestWithParam<std::string>
{
};
}

// `%g` prints 6 digits: half a unit of the last is 5e-5 for coordinates of 10 and more, which the
// tilted box has, 5e-6 below, and 5e-7 of the lengths and tilts of the box for scaled ones.
TEST_P(ReaderCoordinates, OfEveryStyleAgreeWithWhatTheSimulationPrintedInFull)
{
  const std::string box = this->GetParam();
  for (const char* style : { "_plain", "_image", "_scaled", "_scaled_image" })
  {
    const std::string file = box + style + ".dump";
    const bool largePrinted = box == "tri" && file.find("scaled") == std::string::npos;
    const double printed = largePrinted ? 5.1e-5 : 8e-6;
    const auto absolute = PositionsById(file, vtkGranularDumpReader::ABSOLUTE);
    ExpectNear(absolute, TruthById(box + "_unwrapped.dump", ""), printed, file);
    const auto scaled = PositionsById(file, vtkGranularDumpReader::SCALED);
    for (const auto& [id, position] : scaled)
    {
      for (double coordinate : position)
      {
        ASSERT_GE(coordinate, -0.1) << file << " id " << id;
        ASSERT_LE(coordinate, 1.1) << file << " id " << id;
      }
    }
  }
  for (const char* style : { "_image", "_scaled_image" })
  {
    const std::string file = box + style + ".dump";
    const bool largePrinted = box == "tri" && file.find("scaled") == std::string::npos;
    const auto unwrapped = PositionsById(file, vtkGranularDumpReader::UNWRAPPED);
    ExpectNear(
      unwrapped, TruthById(box + "_unwrapped.dump", "u"), largePrinted ? 5.1e-5 : 8e-6, file);
  }
}

TEST_P(ReaderCoordinates, OfAFileWithAllStylesAreThoseOfTheSimulation)
{
  const std::string file = this->GetParam() + "_unwrapped.dump";
  ExpectNear(PositionsById(file, vtkGranularDumpReader::ABSOLUTE), TruthById(file, ""), 0, "x");
  ExpectNear(PositionsById(file, vtkGranularDumpReader::UNWRAPPED), TruthById(file, "u"), 0, "xu");
  // xsu holds the image counts as well: what is left is between 0 and 1. LAMMPS' own x and xsu
  // differ by up to 6e-14.
  auto scaled = TruthById(file, "su");
  for (auto& [id, position] : scaled)
  {
    for (double& coordinate : position)
    {
      coordinate -= std::floor(coordinate);
    }
  }
  ExpectNear(PositionsById(file, vtkGranularDumpReader::SCALED), scaled, 1e-13, "xs");
}

INSTANTIATE_TEST_SUITE_P(Boxes, ReaderCoordinates, testing::Values("ortho", "tri"),
  [](const testing::TestParamInfo<std::string>& box) { return box.param; });

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

TEST(ReaderRows, StrideAlsoWorksWhereIdsAreSwitchedOff)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableArray("id");
  reader->SetStride(100);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 12);
  EXPECT_FALSE(reader.Array("id"));
}

TEST(ReaderRows, StrideCountsRowsWhereThereAreNoIds)
{
  const std::string file = WriteFile(
    "no_ids.dump", Frame(0, 5, "x y z q", "0 0 0 0\n1 0 0 1\n2 0 0 2\n3 0 0 3\n4 0 0 4\n"));
  Reader reader({ file });
  reader->SetStride(2);
  reader->Update();
  ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 3);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(reader.Numbers("q")->GetComponent(i, 0), 2 * i);
  }
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

TEST(ReaderRows, RegionFacesAreInside)
{
  const std::string file = WriteFile(
    "faces.dump", Frame(0, 3, "id x y z", "1 1 5 5\n2 2 5 5\n3 2.0000000000000004 5 5\n"));
  Reader reader({ file });
  reader->SetRegionOfInterest(1, 2, 5, 5, 1, -1);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 2);
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

TEST(ReaderRows, SortingAlsoWorksWithStringsAndWithoutTheIdArray)
{
  const std::string file = WriteFile(
    "sort_texts.dump", Frame(0, 3, "id element x y z", "3 C 3 0 0\n1 A 1 0 0\n2 B 2 0 0\n"));
  Reader reader({ file });
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableArray("id");
  reader->SetSortById(true);
  reader->Update();
  auto* elements = vtkStringArray::SafeDownCast(reader.Array("element"));
  ASSERT_TRUE(elements);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(elements->GetValue(i), std::string(1, static_cast<char>('A' + i)));
    EXPECT_EQ(reader.Particles()->GetPoint(i)[0], i + 1);
  }
  EXPECT_FALSE(reader.Array("id"));
}
