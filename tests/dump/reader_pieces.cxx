// SPDX-License-Identifier: BSD-3-Clause
// Pieces one after the other in one process, and files that change.
#include "reader_helpers.h"

#include "vtkCellArray.h"
#include "vtkErrorCode.h"

namespace
{
/// Particles as rows of words, in their order: points, every array, the cells.
std::vector<std::string> RowsOf(vtkPolyData* particles)
{
  std::vector<std::string> rows;
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    std::ostringstream row;
    row.precision(17);
    double point[3];
    particles->GetPoint(i, point);
    row << point[0] << " " << point[1] << " " << point[2];
    for (int a = 0; a < particles->GetPointData()->GetNumberOfArrays(); ++a)
    {
      vtkAbstractArray* array = particles->GetPointData()->GetAbstractArray(a);
      row << " " << array->GetName();
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        row << " " << array->GetVariantValue(i * array->GetNumberOfComponents() + c).ToString();
      }
    }
    rows.push_back(row.str());
  }
  return rows;
}

void ExpectVertices(vtkPolyData* particles)
{
  ASSERT_EQ(particles->GetNumberOfVerts(), particles->GetNumberOfPoints());
  for (vtkIdType i = 0; i < particles->GetNumberOfPoints(); ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* point = nullptr;
    particles->GetVerts()->GetCellAtId(i, size, point);
    ASSERT_TRUE(size == 1 && *point == i) << i;
  }
}

struct Source
{
  std::vector<std::string> Files;
  double Time;
};

std::vector<Source> Sources()
{
  return { { { Good("grains.dump") }, 1000 }, { { Good("ortho_custom.bin") }, 0 },
    { { Good("ortho_000050.dump.gz") }, 50 },
    { { Good("pieces_1000.0.dump"), Good("pieces_1000.1.dump"), Good("pieces_1000.2.dump"),
        Good("pieces_1000.3.dump") },
      1000 } };
}

/// A run of frames of different sizes, with ids that tell the frame.
std::string RunOf(const std::vector<int>& sizes)
{
  std::string text;
  for (std::size_t frame = 0; frame < sizes.size(); ++frame)
  {
    std::string rows;
    for (int i = sizes[frame]; i > 0; --i)
    {
      rows += std::to_string(1000000 * frame + i) + " 0.5 0." + std::to_string(i) + " 0.25 7\n";
    }
    text += Frame(static_cast<long>(frame), sizes[frame], "id x y z radius", rows);
  }
  return text;
}
}

TEST(ReaderPieces, TogetherAreTheWhole)
{
  for (const Source& source : Sources())
  {
    for (const bool sorted : { false, true })
    {
      Reader whole(source.Files);
      whole->SetSortById(sorted);
      whole->UpdateTimeStep(source.Time);
      const std::vector<std::string> expected = RowsOf(whole.Particles());
      ASSERT_GT(expected.size(), 100u) << source.Files[0];
      Reader reader(source.Files);
      reader->SetSortById(sorted);
      for (const int pieces : { 1, 2, 5, 1300 })
      {
        std::vector<std::string> rows;
        for (int piece = 0; piece < pieces; ++piece)
        {
          reader->UpdateTimeStep(source.Time, piece, pieces);
          ASSERT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
          const std::vector<std::string> part = RowsOf(reader.Particles());
          rows.insert(rows.end(), part.begin(), part.end());
          EXPECT_EQ(reader.Box()->GetNumberOfCells(), piece == 0 ? 1 : 0);
          EXPECT_EQ(reader.Text("Coordinates"), "Absolute");
          ExpectVertices(reader.Particles());
        }
        EXPECT_EQ(rows, expected) << source.Files[0] << " in " << pieces;
      }
      EXPECT_TRUE(reader.Said->Errors.empty());
    }
  }
}

TEST(ReaderFrames, FilesChange)
{
  const std::string file = WriteFile("run.dump", RunOf({ 10, 20, 30 }));
  const std::string other = WriteFile("other.dump", RunOf({ 11, 21, 31 }));
  Reader reader({ file });
  reader->UpdateTimeStep(0);
  reader.Open(other);
  reader->UpdateTimeStep(1);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 21);

  // replaced behind the reader's back: what is shown is not what was there before
  std::filesystem::remove(other);
  WriteFile("other.dump", RunOf({ 11, 21, 36 }));
  reader->UpdateTimeStep(2);
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_NE(reader.Said->Errors[0].find("the file changed"), std::string::npos);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
  reader->Refresh();
  reader->UpdateTimeStep(2);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 36);

  // grows
  reader->RefreshOnUpdateOn();
  reader->UpdateTimeStep(1);
  WriteFile("other.dump", RunOf({ 11, 21, 36, 40 }));
  reader->UpdateTimeStep(2);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 36);
  reader->UpdateTimeStep(3);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 40);
}
