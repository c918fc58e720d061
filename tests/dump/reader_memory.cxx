// SPDX-License-Identifier: BSD-3-Clause
// Arrays and cells whose memory comes from a pool and goes back there.
#include "../../plugin/vtk/private/arrays/arrays.h"

#include "granular/memory/block.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

using granular::BlockPool;
using vtkGranularPrivate::MakeCells;
using vtkGranularPrivate::MakePool;
using vtkGranularPrivate::TakePoints;
using vtkGranularPrivate::VertexCache;

namespace
{
constexpr std::size_t MiB = std::size_t{ 1 } << 20;
constexpr vtkIdType Rows = 100000;

struct Pooled : testing::Test
{
  std::shared_ptr<BlockPool> Pool = std::make_shared<BlockPool>(1024 * MiB);

  /// Points 0, 1, 2, ...
  vtkSmartPointer<vtkPoints> MakePoints() const
  {
    granular::Block block(Rows * 3 * sizeof(double), this->Pool);
    auto* first = static_cast<double*>(block.data());
    std::iota(first, first + Rows * 3, 0.0);
    return TakePoints(block, Rows, false, {});
  }

  /// An array of its own of a pooled block.
  vtkSmartPointer<vtkDoubleArray> MakeArray() const
  {
    return vtkDoubleArray::SafeDownCast(this->MakePoints()->GetData());
  }
};

bool AreVertices(vtkCellArray* cells, vtkIdType points)
{
  if (cells->GetNumberOfCells() != points)
  {
    return false;
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < points; ++i)
  {
    cells->GetCellAtId(i, ids);
    if (ids->GetNumberOfIds() != 1 || ids->GetId(0) != i)
    {
      return false;
    }
  }
  return true;
}

/// The variable for one test, and as it was afterwards.
struct Environment
{
  explicit Environment(const char* value) { Set(value); }
  ~Environment() { Set(nullptr); }
  static void Set(const char* value)
  {
    if (value)
    {
      ::setenv("GRANULAR_POOL_MIB", value, 1);
    }
    else
    {
      ::unsetenv("GRANULAR_POOL_MIB");
    }
  }
};
}

using ReaderMemory = Pooled;

TEST_F(ReaderMemory, ComesBackWithTheLastArrayThatHasIt)
{
  auto points = this->MakePoints();
  const void* const memory = points->GetVoidPointer(0);
  vtkNew<vtkPolyData> output;
  output->SetPoints(points);
  points = nullptr;
  vtkNew<vtkPolyData> shown;
  shown->ShallowCopy(output);
  vtkNew<vtkDoubleArray> kept;
  kept->ShallowCopy(output->GetPoints()->GetData());
  EXPECT_EQ(kept->GetVoidPointer(0), memory) << "no copy of the memory";
  output->Initialize();
  shown->Initialize();
  EXPECT_EQ(this->Pool->idle_bytes(), 0u);
  EXPECT_NE(this->MakePoints()->GetVoidPointer(0), memory);
  this->Pool->clear();
  EXPECT_EQ(kept->GetValue(3 * Rows - 1), 3 * Rows - 1);
  kept->Initialize();
  EXPECT_GE(this->Pool->idle_bytes(), Rows * 3 * sizeof(double));
  EXPECT_EQ(this->MakePoints()->GetVoidPointer(0), memory);
}

TEST_F(ReaderMemory, IsNotThatOfADeepCopy)
{
  vtkNew<vtkPolyData> output;
  output->SetPoints(this->MakePoints());
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(output);
  output->Initialize();
  const auto other = this->MakePoints(); // into the memory that came back
  std::fill_n(static_cast<double*>(other->GetVoidPointer(0)), 3 * Rows, -1.0);
  EXPECT_EQ(copy->GetPoint(Rows - 1)[2], 3 * Rows - 1);
}

TEST_F(ReaderMemory, OutlivesThePool)
{
  const auto array = this->MakeArray();
  this->Pool.reset();
  EXPECT_EQ(array->GetValue(3 * Rows - 1), 3 * Rows - 1);
}

TEST_F(ReaderMemory, OfAnArrayThatIsUsedAgainIsFreedAsItWasMade)
{
  // an array keeps the function that frees it when it takes other memory, from malloc
  for (int way = 0; way < 5; ++way)
  {
    const auto array = this->MakeArray();
    switch (way)
    {
      case 0:
        array->Initialize();
        array->SetNumberOfTuples(5);
        break;
      case 1:
        array->Allocate(12 * Rows);
        array->SetNumberOfTuples(2 * Rows);
        break;
      case 2:
        array->InsertNextValue(1);
        array->SetNumberOfTuples(5 * Rows);
        break;
      case 3:
        array->SetNumberOfTuples(10);
        array->Squeeze();
        break;
      default:
        array->Initialize();
        array->SetNumberOfTuples(Rows);
        break;
    }
    array->FillValue(3);
    EXPECT_EQ(array->GetValue(array->GetNumberOfValues() - 1), 3);
    EXPECT_GE(this->Pool->idle_bytes(), Rows * 3 * sizeof(double)) << way;
    this->Pool->clear();
  }
}

TEST_F(ReaderMemory, OfVerticesIsPooled)
{
  auto cells = MakeCells(Rows, 1, this->Pool);
  EXPECT_FALSE(cells->IsStorage64Bit());
  EXPECT_TRUE(AreVertices(cells, Rows));
  cells = nullptr;
  EXPECT_GE(this->Pool->idle_bytes(), 2 * Rows * sizeof(vtkTypeInt32));
  cells = MakeCells(1, Rows, this->Pool);
  ASSERT_EQ(cells->GetNumberOfCells(), 1);
  EXPECT_EQ(cells->GetCellSize(0), Rows);
  vtkNew<vtkIdList> ids;
  cells->GetCellAtId(0, ids);
  EXPECT_EQ(ids->GetId(Rows - 1), Rows - 1);
  EXPECT_TRUE(AreVertices(MakeCells(7, 1, this->Pool), 7));
  EXPECT_TRUE(AreVertices(MakeCells(7, 1), 7));
  EXPECT_EQ(MakeCells(0, 1, this->Pool)->GetNumberOfCells(), 0);
}

using ReaderVertices = Pooled;

TEST_F(ReaderVertices, AreTheSameAsLongAsTheirNumberAndKindIs)
{
  VertexCache cache;
  const auto first = cache.Get(Rows, true, this->Pool);
  EXPECT_TRUE(AreVertices(first, Rows));
  EXPECT_EQ(cache.Get(Rows, true, this->Pool), first);
  const auto one = cache.Get(Rows, false, this->Pool);
  EXPECT_EQ(one->GetNumberOfCells(), 1);
  EXPECT_EQ(cache.Get(Rows, false, this->Pool), one);
  const auto fewer = cache.Get(Rows - 1, false, this->Pool);
  EXPECT_EQ(fewer->GetCellSize(0), Rows - 1);
  EXPECT_TRUE(AreVertices(cache.Get(3, true, this->Pool), 3));
  EXPECT_EQ(cache.Get(0, true, this->Pool)->GetNumberOfCells(), 0);
  EXPECT_EQ(cache.Get(0, false, this->Pool)->GetNumberOfCells(), 0);
  EXPECT_TRUE(AreVertices(first, Rows)) << "what an output has stays";
}

TEST_F(ReaderVertices, OfTwoOutputsStayWhenACopyOfOneIsFilledAnew)
{
  VertexCache cache;
  vtkNew<vtkPolyData> output;
  output->SetPoints(this->MakePoints());
  output->SetVerts(cache.Get(Rows, true, this->Pool));
  vtkNew<vtkPolyData> deep;
  deep->DeepCopy(output);
  EXPECT_NE(deep->GetVerts(), output->GetVerts());
  deep->GetVerts()->Initialize(); // who has a copy may do with it what he likes
  vtkNew<vtkPolyData> shallow;
  shallow->ShallowCopy(output);
  shallow->BuildCells();
  shallow->BuildLinks();
  shallow->Squeeze();
  shallow->AllocateExact(10, 10);
  const vtkIdType point = 4;
  shallow->InsertNextCell(VTK_VERTEX, 1, &point);
  shallow->DeepCopy(deep);
  output->Initialize();
  EXPECT_TRUE(AreVertices(cache.Get(Rows, true, this->Pool), Rows));
}

TEST_F(ReaderVertices, ThatSomeoneChangedAreMadeAnew)
{
  VertexCache cache;
  const auto longer = cache.Get(100, true, this->Pool);
  longer->InsertNextCell({ 5 });
  EXPECT_TRUE(AreVertices(cache.Get(100, true, this->Pool), 100));
  const auto other = cache.Get(100, true, this->Pool);
  other->ReplaceCellAtId(7, { 8 });
  other->Modified();
  EXPECT_TRUE(AreVertices(cache.Get(100, true, this->Pool), 100));
  const auto emptied = cache.Get(100, true, this->Pool);
  emptied->Initialize();
  EXPECT_TRUE(AreVertices(cache.Get(100, true, this->Pool), 100));
}

TEST(ReaderPool, HasTheLimitOfTheEnvironment)
{
  granular::Notices notices;
  {
    const Environment variable("12");
    EXPECT_EQ(MakePool(notices)->limit(), 12 * MiB);
  }
  {
    const Environment variable("0");
    EXPECT_EQ(MakePool(notices), nullptr);
  }
  EXPECT_TRUE(notices.empty());
}

TEST(ReaderPool, KeepsAnEighthOfTheMemoryUnlessToldOtherwise)
{
  granular::Notices notices;
  Environment::Set(nullptr);
  const std::size_t usual = MakePool(notices)->limit();
  EXPECT_GT(usual, 16 * MiB);
  EXPECT_TRUE(notices.empty());
  for (const char* wrong : { "much", "-1", "12 GB", "1.5", "99999999999999999999" })
  {
    const Environment variable(wrong);
    EXPECT_EQ(MakePool(notices)->limit(), usual) << wrong;
    ASSERT_EQ(notices.size(), 1u) << wrong;
    EXPECT_EQ(granular::to_string(notices[0]),
      "expected a number of MiB in GRANULAR_POOL_MIB, got '" + std::string(wrong) +
        "'; memory is kept as if it were not set");
    notices.clear();
  }
  const Environment variable("9000000000000000000");
  EXPECT_GT(MakePool(notices)->limit(), 1024 * 1024 * MiB);
}
