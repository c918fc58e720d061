// SPDX-License-Identifier: BSD-3-Clause
// One reader whose properties change between its updates, while another one reads the same files in a thread of its own and a
// third thread appends to them. Every row that comes out is compared with the formula that made it. Quick here; 10,000 updates with
// GRANULAR_LOAD=full in the environment.
#include "../dump/reader_helpers.h"
#include "../support/observer.h"
#include "load.h"
#include "reader_content.h"

#include "vtkGranularDecompositionReader.h"
#include "vtkGranularEulerReader.h"
#include "vtkGranularLocalReader.h"
#include "vtkGranularRestartReader.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

namespace
{
// ---- a run whose rows follow from their ids ----------------------------------------------------

constexpr double Side = 64; // of the box

int RowsAt(long step)
{
  return 200 + static_cast<int>(step * 131 % 1800);
}

/// Exact in the file's digits.
std::array<double, 3> PlaceOf(long step, long id)
{
  return { static_cast<double>((id * 7 + step) % 512) / 8, static_cast<double>(id % 128) / 2,
    static_cast<double>((id + 3 * step) % 256) / 4 };
}

double RadiusOf(long step, long id)
{
  return static_cast<double>(step * 4096 + id) / 32;
}

/// The id of a row. The ids have an order of their own: the prime makes each id occur once.
long IdOf(long step, long row)
{
  return 1 + (row * 7919 + step) % RowsAt(step);
}

std::string FrameOf(long step)
{
  const int count = RowsAt(step);
  std::ostringstream rows;
  rows.precision(17);
  for (long i = 0; i < count; ++i)
  {
    const long id = IdOf(step, i);
    const std::array<double, 3> place = PlaceOf(step, id);
    rows << id << " 1 " << place[0] << " " << place[1] << " " << place[2] << " 1 0 -1 "
         << RadiusOf(step, id) << "\n";
  }
  const std::string text =
    Frame(step, static_cast<std::size_t>(count), "id type x y z ix iy iz radius", rows.str());
  const std::string box = "pp pp ff\n0 10\n0 10\n0 10\n";
  return std::string(text).replace(text.find(box), box.size(), "pp pp pp\n0 64\n0 64\n0 64\n");
}

// ---- what a reader was asked for ---------------------------------------------------------------

/// The ids that a reader is to show of a step, in their order.
std::vector<long> IdsOf(vtkGranularDumpReader* reader, long step)
{
  std::vector<long> ids;
  for (long row = 0; row < RowsAt(step); ++row)
  {
    const long id = IdOf(step, row);
    if (id % reader->GetStride() == 0)
    {
      ids.push_back(id);
    }
  }
  if (reader->GetSortById())
  {
    std::sort(ids.begin(), ids.end());
  }
  return ids;
}

/// Where a reader is to show a particle.
std::array<double, 3> PointOf(vtkGranularDumpReader* reader, long step, long id)
{
  constexpr double images[] = { 1, 0, -1 };
  const int form = reader->GetCoordinates();
  std::array<double, 3> point = PlaceOf(step, id);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] += form == vtkGranularDumpReader::UNWRAPPED ? images[axis] * Side : 0;
    point[axis] /= form == vtkGranularDumpReader::SCALED ? Side : 1;
    point[axis] -= reader->GetPointOrigin()[axis];
  }
  return point;
}

/// What is wrong with the particles of a reader that was asked for a step, or "".
std::string Wrong(vtkGranularDumpReader* reader, long step)
{
  vtkPolyData* particles = reader->GetOutput();
  const std::string where = " at step " + std::to_string(step);
  vtkDataArray* steps = particles->GetFieldData()->GetArray("timestep");
  if (!steps || steps->GetComponent(0, 0) != static_cast<double>(step))
  {
    return std::string("another frame, or none: ") + reader->GetErrorMessage() + where;
  }
  const std::vector<long> expected = IdsOf(reader, step);
  vtkDataArray* ids = particles->GetPointData()->GetArray("id");
  vtkDataArray* radii = particles->GetPointData()->GetArray("radius");
  vtkDataArraySelection* arrays = reader->GetPointDataArraySelection();
  if (particles->GetNumberOfPoints() != static_cast<vtkIdType>(expected.size()) ||
    arrays->ArrayIsEnabled("id") != (ids ? 1 : 0) ||
    arrays->ArrayIsEnabled("radius") != (radii ? 1 : 0))
  {
    return "other particles or arrays" + where;
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const long id = expected[i];
    const auto row = static_cast<vtkIdType>(i);
    std::array<double, 3> point;
    particles->GetPoint(row, point.data());
    if ((ids && ids->GetComponent(row, 0) != static_cast<double>(id)) ||
      point != PointOf(reader, step, id) ||
      (radii && radii->GetComponent(row, 0) != RadiusOf(step, id)))
    {
      return "id, point or radius of id " + std::to_string(id) + where;
    }
  }
  return "";
}

/// Changes one property of a reader, chosen at random.
void Change(vtkGranularDumpReader* reader, std::mt19937& random)
{
  const auto below = [&random](int count) { return static_cast<int>(random() % count); };
  vtkDataArraySelection* arrays = reader->GetPointDataArraySelection();
  const std::function<void()> changes[] = {
    [&] { reader->SetCoordinates(below(3)); },
    [&] { reader->SetPointPrecision(below(2)); },
    [&] { reader->SetPointOrigin(below(4) / 4., 0, below(2)); },
    [&] { reader->SetSortById(below(2) == 0); },
    [&] { reader->SetVertices(below(3)); },
    [&] { reader->SetStride(1 + below(5)); },
    [&] { reader->SetThreads(below(4)); },
    [&] { reader->SetRefreshOnUpdate(below(2) == 0); },
    [&] { arrays->SetArraySetting("radius", below(2)); },
    [&] { arrays->SetArraySetting("id", below(8) > 0); },
    [&] { arrays->SetArraySetting("type", below(2)); },
    [&] { reader->Refresh(); },
  };
  changes[random() % std::size(changes)]();
}

/// Updates a reader at a random time; the times are the steps. Returns what is wrong, or "".
std::string Update(Reader& reader, std::mt19937& random)
{
  const std::vector<double> times = reader.Times();
  if (times.empty() || times.back() != static_cast<double>(times.size() - 1))
  {
    return "no frames, or other times";
  }
  const auto step = static_cast<long>(random() % times.size());
  reader->UpdateTimeStep(static_cast<double>(step));
  return reader.Said->Errors.empty() ? Wrong(reader.Get, step) : reader.Said->Errors.front();
}

/// Updates a reader under change, while a file grows and another reader follows it in a thread of its own. Expects that both find all
/// frames.
void FollowUnderChange(const std::string& file, int count, const char* pool)
{
  constexpr long enough = 25; // frames, of which the file had 20 before
  std::atomic<long> frames = 20;
  std::atomic<bool> stopped = false;
  std::thread appending(
    [&]
    {
      std::ofstream out(file, std::ios::binary | std::ios::app);
      for (bool last = false; !last; ++frames)
      {
        last = stopped;                       // a last frame for both
        out << FrameOf(frames) << std::flush; // a few KiB at a time
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  std::atomic<bool> ended = false;
  std::string wrongOfOther;
  std::size_t framesOfOther = 0;
  std::thread other(
    [&]
    {
      std::mt19937 random(2);
      Reader reader({ file });
      reader->SetController(nullptr);
      reader->RefreshOnUpdateOn();
      for (bool last = false; !last && wrongOfOther.empty();)
      {
        last = ended;
        wrongOfOther = Update(reader, random);
        framesOfOther = reader.Times().size();
      }
    });
  std::mt19937 random(1);
  Reader reader({ file });
  reader->SetController(nullptr);
  std::int64_t memory = 0;
  std::string wrong;
  for (int i = 0; (i < count || frames < enough) && wrong.empty(); ++i)
  {
    memory = i == count / 2 ? status_of_process("VmRSS") : memory; // warm
    Change(reader.Get, random);
    wrong = Update(reader, random);
    EXPECT_EQ(wrong, "") << "update " << i;
  }
  const std::int64_t grown = status_of_process("VmRSS") - memory;
  stopped = true;
  appending.join();
  ended = true;
  other.join();
  reader->Refresh();
  EXPECT_EQ(wrongOfOther, "");
  EXPECT_EQ(framesOfOther, static_cast<std::size_t>(frames));
  EXPECT_EQ(reader.Times().size(), static_cast<std::size_t>(frames));
  std::printf("load | %d updates, pool '%s' | %lld KiB more in the second half | %zu frames\n",
    count, pool, static_cast<long long>(grown / 1024), reader.Times().size());
#ifndef GRANULAR_TEST_SANITIZED
  EXPECT_LT(grown, 8 * mebibyte + count / 2 * 1024); // the pools of both fill as frames come
#endif
}

/// All that a reader of a class shows of a file.
template <class Class>
std::string ContentOf(const std::string& file)
{
  Watched<Class> reader;
  reader->SetController(nullptr);
  reader->AddFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0u) << reader->GetErrorMessage();
  return Content(reader.Get);
}
}

TEST(ChangingUpdates, AreRightAndKeepMemory)
{
  const auto updates = static_cast<int>(size_of_load(600, 10'002));
  for (const char* const pool : { "0", "1", "" }) // MiB; empty: the default
  {
    std::string text;
    for (long step = 0; step < 20; ++step)
    {
      text += FrameOf(step);
    }
    const std::string file = WriteFile("growing.dump", text);
    ::setenv("GRANULAR_POOL_MIB", pool, 1);
    const std::int64_t descriptors = open_descriptors();
    FollowUnderChange(file, updates / 3, pool);
    EXPECT_EQ(open_descriptors(), descriptors);
  }
  ::unsetenv("GRANULAR_POOL_MIB");
}

TEST(ChangingUpdates, ReadersOfAllClassesInTwoThreads)
{
  struct Case
  {
    std::string (*Content)(const std::string&);
    std::string File;
    std::string Expected;
  };
  Case cases[] = {
    { ContentOf<vtkGranularDumpReader>, Good("grains_1000.dump"), "" },
    { ContentOf<vtkGranularLocalReader>, Good("local/chain_bonds.dump"), "" },
    { ContentOf<vtkGranularEulerReader>, Good("euler_1000.vtk"), "" },
    { ContentOf<vtkGranularDecompositionReader>, Good("decomposition_1000.vtk"), "" },
    { ContentOf<vtkGranularRestartReader>, Good("restart/fibres.restart"), "" },
  };
  for (Case& each : cases)
  {
    each.Expected = each.Content(each.File);
  }
  std::atomic<int> wrong = 0;
  const auto read = [&](std::size_t first)
  {
    const auto rounds = static_cast<std::size_t>(size_of_load(20, 500));
    for (std::size_t i = first; i < first + rounds * std::size(cases); ++i)
    {
      const Case& each = cases[i % std::size(cases)];
      wrong += each.Content(each.File) != each.Expected ? 1 : 0;
    }
  };
  std::thread other(read, 2);
  read(0);
  other.join();
  EXPECT_EQ(wrong, 0);
}
