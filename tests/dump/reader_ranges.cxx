// SPDX-License-Identifier: BSD-3-Clause
// The ranges that arrays come with are those that VTK finds by looking.
#include "reader_helpers.h"

#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersion.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>

namespace
{
using Ranges = std::vector<double>;

/// All that can be asked for; Python and ParaView ask for all of it.
Ranges RangesOf(vtkDataArray* array)
{
  Ranges ranges;
  for (int component = -1; component < array->GetNumberOfComponents(); ++component)
  {
    double range[2];
    array->GetRange(range, component);
    ranges.insert(ranges.end(), range, range + 2);
    array->GetFiniteRange(range, component);
    ranges.insert(ranges.end(), range, range + 2);
  }
  return ranges;
}

bool Knows(vtkDataArray* array)
{
  return array->HasInformation() && array->GetInformation()->Has(vtkAbstractArray::PER_COMPONENT());
}

/// Of every array of points: what it came with is what VTK finds when it has forgotten that.
void ExpectRanges(Reader& reader, const std::string& unknown = "")
{
  std::vector<vtkDataArray*> arrays = { reader.Particles()->GetPoints()->GetData() };
  for (int i = 0; i < reader.Particles()->GetPointData()->GetNumberOfArrays(); ++i)
  {
    arrays.push_back(reader.Particles()->GetPointData()->GetArray(i));
  }
  for (vtkDataArray* array : arrays)
  {
    if (array) // texts are none
    {
      const std::string name = array->GetName();
      EXPECT_EQ(Knows(array), unknown != "all" && name != unknown) << name;
      const Ranges given = RangesOf(array);
      array->Modified();
      EXPECT_FALSE(Knows(array)) << name;
      EXPECT_EQ(given, RangesOf(array)) << name;
    }
  }
}

std::string Frame(const std::string& columns, const std::vector<std::string>& rows)
{
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(rows.size()) +
    "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS " + columns + "\n";
  for (const std::string& row : rows)
  {
    text += row + "\n";
  }
  return text;
}

std::vector<std::string> ManyRows(int count)
{
  std::vector<std::string> rows;
  for (int row = 0; row < count; ++row)
  {
    const double value = std::sin(1.7 * row) * std::exp(0.01 * (row % 900));
    std::ostringstream line;
    line.precision(17);
    line << row % 7919 - 100 << ' ' << row % 5 << ' ' << value << ' ' << -value / 3 << ' '
         << value * value << ' ' << row % 3 - 1 << " 0 7 " << 1 / (1.0 + row) << ' ' << value << ' '
         << 2 * value << " Si";
    rows.push_back(line.str());
  }
  return rows;
}

/// Takes away the pages within an array, and counts who looks at them: that is a fault, after which they are
/// back.
class Scans
{
public:
  explicit Scans(vtkDataArray* array)
  {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(array->GetVoidPointer(0));
    const std::uintptr_t first = (begin + page - 1) / page * page;
    const auto bytes = static_cast<std::uintptr_t>(array->GetDataSize() * array->GetDataTypeSize());
    Size = (begin + bytes) / page * page - first;
    Begin = reinterpret_cast<void*>(first);
    Count = 0;
    struct sigaction action = {};
    action.sa_handler = [](int)
    {
      Count = Count + 1;
      mprotect(Begin, Size, PROT_READ | PROT_WRITE);
    };
    sigaction(SIGSEGV, &action, &this->Before);
    mprotect(Begin, Size, PROT_NONE);
  }
  ~Scans()
  {
    mprotect(Begin, Size, PROT_READ | PROT_WRITE);
    sigaction(SIGSEGV, &this->Before, nullptr);
  }
  Scans(const Scans&) = delete;
  Scans& operator=(const Scans&) = delete;

  int count() const { return Count; }

private:
  struct sigaction Before;
  static inline void* Begin = nullptr;
  static inline std::size_t Size = 0;
  static inline volatile std::sig_atomic_t Count = 0;
};

/// What ParaView asks of a data set: of its arrays the field data, where these know ranges.
void GatherRanges(vtkPolyData* particles)
{
  particles->GetBounds();
  for (int i = 0; i < particles->GetPointData()->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = particles->GetPointData()->GetArray(i))
    {
      RangesOf(array);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
      for (int component = -1; component < array->GetNumberOfComponents(); ++component)
      {
        double range[2];
        particles->GetPointData()->GetRange(i, range, component);
        particles->GetPointData()->GetFiniteRange(i, range, component);
      }
#endif
    }
  }
}

const std::string Columns = "id type x y z ix iy iz radius c_a[1] c_a[2] element";
}

TEST(ReaderRanges, WhateverIsRead)
{
  const std::string file = WriteFile("many.dump", Frame(Columns, ManyRows(20'001)));
  for (int threads = 1; threads <= 3; threads += 2)
  {
    for (int way = 0; way < 6; ++way)
    {
      SCOPED_TRACE("threads " + std::to_string(threads) + ", way " + std::to_string(way));
      Reader reader({ file });
      reader->SetThreads(threads);
      reader->SetPointPrecision(
        way == 1 ? vtkAlgorithm::SINGLE_PRECISION : vtkAlgorithm::DOUBLE_PRECISION);
      reader->SetSortById(way == 2);
      reader->SetStride(way == 3 ? 7 : 1);
      const double region[] = { -1, 1, 1, -1, 1, -1 };
      reader->SetRegionOfInterest(way == 4 ? region : reader->GetRegionOfInterest());
      reader->SetCoordinates(
        way == 5 ? vtkGranularDumpReader::UNWRAPPED : vtkGranularDumpReader::ABSOLUTE);
      reader->Update();
      ASSERT_GT(reader.Particles()->GetNumberOfPoints(), 100);
      ExpectRanges(reader);
    }
  }
}

TEST(ReaderRanges, OfPieces)
{
  const std::string file = WriteFile("many.dump", Frame(Columns, ManyRows(5'001)));
  for (const bool sorted : { false, true })
  {
    Reader reader({ file });
    reader->SetSortById(sorted);
    reader->UpdatePiece(1, 3, 0);
    ASSERT_GT(reader.Particles()->GetNumberOfPoints(), 1000);
    ExpectRanges(reader, sorted ? "all" : "");
  }
}

TEST(ReaderRanges, ValuesThatAreNotFiniteAreLeftToVtk)
{
  for (const std::string value : { "nan", "inf", "-inf", "1e200" }) // whose square is not
  {
    SCOPED_TRACE(value);
    Reader reader({ WriteFile("odd.dump",
      Frame("id x y z vx vy vz q",
        { "1 0 0 0 1 2 3 1", "2 1 1 1 0 " + value + " 0 -2", "3 1 0 2 -7 0 0 5" })) });
    reader->Update();
    ExpectRanges(reader, "v");
  }
}

TEST(ReaderRanges, OfOneRowAndOfNone)
{
  Reader one({ WriteFile("one.dump", Frame("id x y z vx vy vz", { "1 -1 2 3 0.1 0.2 -0.3" })) });
  one->Update();
  ExpectRanges(one);
  Reader none({ WriteFile("none.dump", Frame("id x y z vx vy vz", {})) });
  none->Update();
  ExpectRanges(none, "all");
}

TEST(ReaderRanges, NobodyLooksAtTheValues)
{
  Reader reader({ WriteFile("scans.dump", Frame(Columns, ManyRows(20'001))) });
  reader->Update();
  vtkPolyData* particles = reader.Particles();
  std::vector<vtkDataArray*> arrays = { particles->GetPoints()->GetData() };
  for (int i = 0; i < particles->GetPointData()->GetNumberOfArrays(); ++i)
  {
    arrays.push_back(particles->GetPointData()->GetArray(i));
  }
  for (vtkDataArray* array : arrays)
  {
    if (array) // texts are none
    {
      SCOPED_TRACE(array->GetName());
      {
        const Scans scans(array);
        GatherRanges(particles);
        EXPECT_EQ(scans.count(), 0);
      }
      array->Modified();
      const Scans scans(array);
      GatherRanges(particles);
      EXPECT_GE(scans.count(), 1) << "of what was changed"; // threads of VTK 9.6 may come together
    }
  }
}

TEST(ReaderRanges, WhatTheArraysDoNotKnowIsAskedOfTheValues)
{
  Reader reader(
    { WriteFile("changed.dump", Frame("id x y z radius", { "1 0 0 0 1", "2 .5 0 0 3" })) });
  reader->Update();
  vtkPolyData* particles = reader.Particles();
  vtkDataArray* radius = particles->GetPointData()->GetArray("radius");
  double range[2];
  const auto expect = [&range](double low, double high)
  {
    EXPECT_EQ(range[0], low);
    EXPECT_EQ(range[1], high);
  };

  const auto made = vtk::TakeSmartPointer(radius->NewInstance());
  EXPECT_STREQ(made->GetClassName(), "vtkDoubleArray");
  EXPECT_STREQ(radius->GetClassName(), "vtkDoubleArray");
  EXPECT_TRUE(radius->IsA("vtkDoubleArray"));
  made->DeepCopy(radius);
  made->SetComponent(0, 0, -7.0);
  made->Modified();
  made->GetRange(range);
  expect(-7.0, 3.0);
  radius->GetRange(range);
  expect(1.0, 3.0);

  radius->SetComponent(1, 0, 9.0);
  radius->Modified();
  radius->GetRange(range);
  expect(1.0, 9.0);
  radius->SetNumberOfTuples(1);
  radius->Modified();
  radius->GetRange(range);
  expect(1.0, 1.0);
}

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
TEST(ReaderRanges, WithoutGhosts)
{
  Reader reader(
    { WriteFile("ghosts.dump", Frame("id x y z radius", { "1 0 0 0 1", "2 .5 0 0 3" })) });
  reader->Update();
  vtkPointData* data = reader.Particles()->GetPointData();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->InsertNextValue(0);
  ghosts->InsertNextValue(vtkDataSetAttributes::DUPLICATEPOINT);
  data->AddArray(ghosts);
  data->SetGhostsToSkip(vtkDataSetAttributes::DUPLICATEPOINT);
  double range[2];
  data->GetRange("radius", range, 0);
  EXPECT_EQ(range[0], 1.0);
  EXPECT_EQ(range[1], 1.0);
}
#endif
