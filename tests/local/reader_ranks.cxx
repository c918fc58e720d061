// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: what goes wrong on one rank is an error of all; afterwards all rows are there again.
#include "vtkGranularLocalReader.h"

#include "../dump/reader_ranks.h"
#include "../support/observer.h"
#include "local_files.h"

#include "vtkCellData.h"
#include "vtkTable.h"

#include <sys/resource.h>

namespace
{
constexpr int Many = 300000;

/// Lines across a face, each of which becomes two.
const std::string& Text()
{
  static const std::string text = []
  {
    char row[64];
    std::string all = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n" + std::to_string(Many) +
      "\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10\nITEM: ENTRIES x1 y1 z1 x2 y2 z2 id1 id2\n";
    for (int i = 0; i < Many; ++i)
    {
      all.append(row, std::snprintf(row, sizeof row, "9.5 1 1 0.5 1 1 %07d 0000001\n", i));
    }
    return all;
  }();
  return text;
}

struct LinesReader : Watched<vtkGranularLocalReader>
{
  LinesReader()
  {
    this->Get->AddFileName("run.dump");
    this->Get->SetThreads(1);
    this->Get->SetPeriodicLines(vtkGranularLocalReader::SPLIT);
  }
};

class LocalReaderRanks : public ReaderRanks
{
protected:
  void Update(LinesReader& reader) { reader->UpdateTimeStep(0, this->Rank(), this->Size()); }

  /// Both parts of each line are on one rank, with its number in the frame.
  void ExpectAll(LinesReader& reader)
  {
    reader.ExpectSaid("");
    vtkDataArray* rows = reader->GetOutput()->GetCellData()->GetArray("row");
    vtkDataArray* ids = reader->GetOutput()->GetCellData()->GetArray("id1");
    ASSERT_TRUE(rows && ids);
    std::int64_t wrong = 0;
    for (vtkIdType i = 0; i < rows->GetNumberOfTuples(); ++i)
    {
      wrong += rows->GetComponent(i, 0) != ids->GetComponent(i, 0) ? 1 : 0;
    }
    std::int64_t sums[] = { rows->GetNumberOfTuples(), reader->GetRows()->GetNumberOfRows(),
      wrong };
    this->Ranks.sum(sums);
    EXPECT_EQ(sums[0], 2 * Many);
    EXPECT_EQ(sums[1], Many);
    EXPECT_EQ(sums[2], 0);
  }

  void ExpectFailed(LinesReader& reader, const std::string& text, int rank)
  {
    EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(reader->GetRows()->GetNumberOfColumns(), 0);
    const std::vector<std::string> said = reader.TakeSaid();
    ASSERT_EQ(said.size(), 1u);
    const std::string& error = said[0];
    EXPECT_NE(error.find(text), std::string::npos) << error;
    EXPECT_NE(error.find("(on rank " + std::to_string(rank) + " of "), std::string::npos) << error;
    this->ExpectSame(error);
  }
};
}

TEST_F(LocalReaderRanks, ARowIsDamagedOnOne)
{
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    const int row = (2 * rank + 1) * Many / (2 * this->Size());
    std::string text = Text();
    const std::size_t start = text.find("z2 id1 id2\n") + 11 + static_cast<std::size_t>(row) * 32;
    Write("run.dump", this->Rank() == rank ? text.replace(start, 7, "9.5 111") : text);
    LinesReader reader;
    this->Update(reader);
    this->ExpectFailed(
      reader, "run.dump:" + std::to_string(row + 10) + ": expected 8 words in a row, got 7", rank);
    Write("run.dump", Text());
    reader->Modified();
    this->Update(reader);
    this->ExpectAll(reader);
  }
}

TEST_F(LocalReaderRanks, MemoryRunsOutOnOne)
{
  Write("run.dump", Text());
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    for (const long megabytes : { 1, 4, 12 }) // on the way to the table, and to the lines
    {
      LinesReader reader;
      reader->UpdateInformation();
      rlimit before = {};
      getrlimit(RLIMIT_AS, &before);
      if (this->Rank() == rank)
      {
        long pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        rlimit less = before;
        less.rlim_cur = static_cast<rlim_t>(pages) * 4096 + (static_cast<rlim_t>(megabytes) << 20);
        setrlimit(RLIMIT_AS, &less);
      }
      this->Update(reader);
      setrlimit(RLIMIT_AS, &before);
      this->ExpectFailed(reader, "out of memory", rank);
      reader->Modified();
      this->Update(reader);
      this->ExpectAll(reader);
    }
  }
}

int main(int argc, char** argv)
{
  return RunWithController(argc, argv);
}
