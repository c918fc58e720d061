// SPDX-License-Identifier: BSD-3-Clause
// What the tests of readers on several ranks share. The main() here gives VTK its controller.
#ifndef tests_dump_reader_ranks_h
#define tests_dump_reader_ranks_h

#include "reader_helpers.h"

#include "../support/rank_tests.h"

#include "granular/mpi/mpi_communicator.h"

#include "vtkErrorCode.h"
#include "vtkMPIController.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

/// Rows of a fixed width: a copy with another word in it has the same size and the same ends.
inline std::string Rows(int first, int count)
{
  std::string rows;
  char row[64];
  for (int id = first; id < first + count; ++id)
  {
    rows.append(
      row, std::snprintf(row, sizeof row, "%07d 1 0.%06d 0.250000 0.5 ok%d\n", id, id, id % 3));
  }
  return rows;
}

inline std::string GrainsFrame(long step, int count)
{
  return Frame(step, count, "id type x y z element", Rows(1, count));
}

/// What happened on a rank, in words.
inline std::string Outcome(Reader& reader)
{
  std::string text = "code " + std::to_string(reader->GetErrorCode());
  for (const std::string& error : reader.Said->Errors)
  {
    text += ": " + error;
  }
  return text;
}

class ReaderRanks : public testing::Test
{
protected:
  /// Each rank has a folder of its own, and works there: a relative name is another file on each.
  void SetUp() override
  {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path folder =
      std::filesystem::path(GRANULAR_OUTPUT) / test->name() / std::to_string(this->Ranks.rank());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
  }

  static void Write(const std::string& name, const std::string& bytes)
  {
    std::ofstream(name, std::ios::binary | std::ios::trunc) << bytes;
  }

  int Rank() const { return this->Ranks.rank(); }
  int Size() const { return this->Ranks.size(); }

  void UpdateOwnPiece(Reader& reader, double time = 0)
  {
    reader.Said->Errors.clear();
    reader->UpdateTimeStep(time, this->Rank(), this->Size());
  }

  bool OnAny(bool here)
  {
    std::int64_t count = here ? 1 : 0;
    this->Ranks.sum({ &count, 1 });
    return count > 0;
  }

  /// Whether all ranks say the same.
  void ExpectSame(const std::string& text)
  {
    for (const std::string& other : this->Ranks.all_gather(text))
    {
      EXPECT_EQ(text, other);
    }
  }

  /// The ids that the ranks have, one after the other.
  std::vector<vtkTypeInt64> Ids(Reader& reader)
  {
    vtkDataArray* ids = reader.Numbers("id");
    std::string bytes;
    if (ids)
    {
      bytes.assign(static_cast<const char*>(ids->GetVoidPointer(0)),
        static_cast<std::size_t>(ids->GetNumberOfTuples()) * sizeof(vtkTypeInt64));
    }
    std::vector<vtkTypeInt64> all;
    for (const std::string& other : this->Ranks.all_gather(bytes))
    {
      std::vector<vtkTypeInt64> part(other.size() / sizeof(vtkTypeInt64));
      std::copy_n(other.data(), other.size(), reinterpret_cast<char*>(part.data()));
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

  /// All particles of a GrainsFrame are there once, in order, and one box.
  void ExpectWhole(Reader& reader, int count)
  {
    EXPECT_EQ(Outcome(reader), "code 0");
    std::vector<vtkTypeInt64> expected(count);
    std::iota(expected.begin(), expected.end(), 1);
    EXPECT_EQ(this->Ids(reader), expected);
    EXPECT_EQ(reader.Box()->GetNumberOfCells(), this->Rank() == 0 ? 1 : 0);
  }

  /// One error, the same on all ranks, which says this and names the rank; no output.
  void ExpectError(Reader& reader, unsigned long code, const std::string& text, int rank)
  {
    EXPECT_EQ(reader->GetErrorCode(), code);
    EXPECT_EQ(reader.Said->Errors.size(), 1u);
    const std::string said = Outcome(reader);
    EXPECT_NE(said.find(text), std::string::npos) << said;
    EXPECT_NE(said.find("(on rank " + std::to_string(rank) + " of "), std::string::npos) << said;
    this->ExpectSame(said);
    ExpectEmpty(reader);
  }

  granular::MpiCommunicator Ranks{ MPI_COMM_WORLD };
};

inline int RunWithController(int argc, char** argv)
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  const int failed = run_tests_on_ranks(&argc, argv);
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return failed;
}

#endif
