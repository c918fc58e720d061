// SPDX-License-Identifier: BSD-3-Clause
// The reader from C++: its two outputs, what the columns are, lines across faces, runs that grow, errors.
#include "vtkGranularLocalReader.h"

#include "../dump/reader_helpers.h"
#include "../support/observer.h"
#include "../support/vtk_arrays.h"
#include "local_files.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <limits>

namespace
{
using Texts = std::vector<std::string>;
using Pipeline = vtkStreamingDemandDrivenPipeline;

struct LinesReader : Watched<vtkGranularLocalReader>
{
  explicit LinesReader(const Texts& paths)
  {
    this->Get->SetController(nullptr);
    for (const std::string& path : paths)
    {
      this->Get->AddFileName(path.c_str());
    }
  }

  vtkPolyData* Lines() { return this->Get->GetOutput(); }
  vtkTable* Rows() { return this->Get->GetRows(); }

  /// The names of the arrays of an output, in order.
  std::string Names(bool ofRows = false)
  {
    vtkFieldData* data = ofRows ? static_cast<vtkFieldData*>(this->Rows()->GetRowData())
                                : this->Lines()->GetCellData();
    std::string names;
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      names += (i > 0 ? " " : "") + std::string(data->GetAbstractArray(i)->GetName());
    }
    return names;
  }

  vtkAbstractArray* Cells(const char* name)
  {
    return this->Lines()->GetCellData()->GetAbstractArray(name);
  }

  /// The ends of the lines one after the other.
  Values Points()
  {
    Values points;
    for (vtkIdType i = 0; i < this->Lines()->GetNumberOfPoints(); ++i)
    {
      const double* point = this->Lines()->GetPoint(i);
      points.insert(points.end(), point, point + 3);
    }
    return points;
  }

  /// Which arrays may be read; those that are off in brackets.
  std::string Selection()
  {
    vtkDataArraySelection* all = this->Get->GetCellDataArraySelection();
    std::string names;
    for (int i = 0; i < all->GetNumberOfArrays(); ++i)
    {
      const std::string name = all->GetArrayName(i);
      names += (i > 0 ? " " : "") + (all->GetArraySetting(i) ? name : "(" + name + ")");
    }
    return names;
  }

  Values Times()
  {
    this->Get->UpdateInformation();
    vtkInformation* info = this->Get->GetOutputInformation(0);
    const double* steps = info->Get(Pipeline::TIME_STEPS());
    return { steps, steps + info->Length(Pipeline::TIME_STEPS()) };
  }

  /// One error, and nothing in the outputs.
  void ExpectError(const std::string& text)
  {
    this->Get->Update();
    EXPECT_NE(this->Get->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_EQ(this->TakeSaid(), Texts{ text });
    EXPECT_EQ(this->Lines()->GetNumberOfCells(), 0);
    EXPECT_EQ(this->Rows()->GetNumberOfRows(), 0);
    EXPECT_EQ(this->Rows()->GetNumberOfColumns(), 0);
  }
};

Values Field(vtkDataObject* data, const char* name)
{
  return ValuesOf(data->GetFieldData()->GetArray(name));
}

std::string Write(const std::string& columns, const Texts& rows)
{
  return WriteFile("lines.dump", local_frame(columns, rows));
}

const std::string NoBox;
const std::string Box = "BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10";

constexpr const char* FullNames = "x1 y1 z1 x2 y2 z2 id1 id2 btype forcex forcey forcez torquex "
                                  "torquey torquez equilibrium_length";
const Texts FullRows = { "1 2 3 1 2 5 7 8 -1 1 2 3 4 5 6 1.5", "4 4 4 4 8 7 8 9 2 9 8 7 6 5 4 5" };
}

TEST(LocalReaderVtk, BothOutputs)
{
  LinesReader reader({ Write(FullNames, FullRows) });
  reader->Update();
  EXPECT_EQ(reader.TakeSaid(), Texts{});
  vtkPolyData* lines = reader.Lines();
  ASSERT_EQ(lines->GetNumberOfLines(), 2);
  ASSERT_EQ(lines->GetNumberOfCells(), 2);
  EXPECT_EQ(lines->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(reader.Points(), (Values{ 1, 2, 3, 1, 2, 5, 4, 4, 4, 4, 8, 7 }));
  vtkIdType count = 0;
  const vtkIdType* ends = nullptr;
  lines->GetLines()->GetCellAtId(1, count, ends);
  ASSERT_EQ(count, 2);
  EXPECT_EQ(ends[0], 2);
  EXPECT_EQ(ends[1], 3);
  EXPECT_EQ(reader.Names(), "id1 id2 btype force torque equilibrium_length length");
  EXPECT_EQ(reader.Names(true), "id1 id2 btype force torque equilibrium_length");
  EXPECT_EQ(reader.Rows()->GetNumberOfRows(), 2);
  EXPECT_TRUE(vtkTypeInt64Array::SafeDownCast(reader.Cells("id1")));
  EXPECT_TRUE(vtkTypeInt64Array::SafeDownCast(reader.Cells("id2")));
  EXPECT_TRUE(vtkTypeInt32Array::SafeDownCast(reader.Cells("btype")));
  auto* force = vtkDoubleArray::SafeDownCast(reader.Cells("force"));
  ASSERT_TRUE(force);
  ASSERT_EQ(force->GetNumberOfComponents(), 3);
  EXPECT_EQ(ValuesOf(force), (Values{ 1, 2, 3, 9, 8, 7 }));
  EXPECT_EQ(ValuesOf(reader.Cells("torque")), (Values{ 4, 5, 6, 6, 5, 4 }));
  EXPECT_EQ(ValuesOf(reader.Cells("length")), (Values{ 2, 5 }));
  EXPECT_EQ(ValuesOf(reader.Cells("btype")), (Values{ -1, 2 }));
  for (int i = 0; i < reader.Rows()->GetNumberOfColumns(); ++i)
  {
    vtkAbstractArray* column = reader.Rows()->GetColumn(i);
    EXPECT_EQ(column, reader.Cells(column->GetName())) << "no copy";
  }
}

TEST(LocalReaderVtk, FieldData)
{
  LinesReader reader({ WriteFile("a.dump",
    local_frame("id1 id2", { "1 2" }, "BOX BOUNDS pp fs mm\n-1 9\n0 20\n-5 25", "BONDS", 300)) });
  reader->SetPointOrigin(1, 2, 3);
  reader->SetTimestepSize(0.5);
  reader->Update();
  EXPECT_EQ(reader.Times(), Values{ 150 });
  for (vtkDataObject* output :
    { static_cast<vtkDataObject*>(reader.Lines()), static_cast<vtkDataObject*>(reader.Rows()) })
  {
    EXPECT_EQ(Field(output, "BoxOrigin"), (Values{ -1, 0, -5 }));
    EXPECT_EQ(Field(output, "BoxVectors"), (Values{ 10, 0, 0, 0, 20, 0, 0, 0, 30 }));
    EXPECT_EQ(Field(output, "PointOrigin"), (Values{ 1, 2, 3 }));
    EXPECT_EQ(Field(output, "timestep"), Values{ 300 });
    auto text = [&](const char* name)
    { return vtkStringArray::SafeDownCast(output->GetFieldData()->GetAbstractArray(name)); };
    EXPECT_EQ(text("Boundary")->GetValue(0), "pp fs mm");
    EXPECT_EQ(text("Columns")->GetNumberOfValues(), 2);
    EXPECT_EQ(text("Columns")->GetValue(0), "id1");
    EXPECT_EQ(output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 150);
  }
  // ids alone: rows, and no lines
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 0);
  EXPECT_EQ(reader.Rows()->GetNumberOfRows(), 1);
}

TEST(LocalReaderVtk, WithoutABox)
{
  LinesReader reader(
    { WriteFile("a.dump", local_frame("x1 y1 z1 x2 y2 z2", { "0 0 0 0 0 9" }, NoBox)) });
  for (int periodic = 0; periodic < 3; ++periodic)
  {
    reader->SetPeriodicLines(periodic);
    reader->Update();
    EXPECT_EQ(ValuesOf(reader.Cells("length")), Values{ 9 });
    EXPECT_EQ(reader.Points(), (Values{ 0, 0, 0, 0, 0, 9 }));
    for (const char* name : { "BoxOrigin", "BoxVectors", "BoxBounds", "Boundary" })
    {
      EXPECT_FALSE(reader.Lines()->GetFieldData()->GetAbstractArray(name)) << name;
      EXPECT_FALSE(reader.Rows()->GetFieldData()->GetAbstractArray(name)) << name;
    }
  }
  EXPECT_EQ(reader.TakeSaid(), Texts{});
}

TEST(LocalReaderVtk, EveryPreset)
{
  struct Case
  {
    int preset;
    const char* row;
    const char* table;
    Values points;
  };
  const Values ends = { 1, 2, 3, 1, 2, 5 };
  const Case cases[] = {
    { vtkGranularLocalReader::BOND_IDS, "7 8 1", "id1 id2 btype", {} },
    { vtkGranularLocalReader::BOND_TYPE_IDS, "1 7 8", "btype id1 id2", {} },
    { vtkGranularLocalReader::BONDS, "1 2 3 1 2 5 7 8 1", "id1 id2 btype", ends },
    { vtkGranularLocalReader::BONDS_FORCE, "1 2 3 1 2 5 7 8 1 1 2 3", "id1 id2 btype force", ends },
    { vtkGranularLocalReader::BONDS_FORCE_TORQUE, "1 2 3 1 2 5 7 8 1 1 2 3 4 5 6 2",
      "id1 id2 btype force torque equilibrium_length", ends },
    { vtkGranularLocalReader::CONTACTS, "1 2 3 1 2 5 7 8 0", "id1 id2 periodic", ends },
    { vtkGranularLocalReader::CONTACTS_FORCE, "1 2 3 1 2 5 7 8 0 1 2 3", "id1 id2 periodic force",
      ends },
    { vtkGranularLocalReader::WALL_CONTACTS, "1 2 3 1 2 5 0 40 8", "mesh triangle id2", ends },
    { vtkGranularLocalReader::WALL_CONTACTS_FORCE, "1 2 3 1 2 5 0 40 8 1 2 3",
      "mesh triangle id2 force", ends },
    { vtkGranularLocalReader::BOND_IDS_FORCE, "7 8 1 2 -20 1 2 3",
      "id1 id2 btype dist engpot force", {} },
    { vtkGranularLocalReader::BOND_TYPE_IDS_FORCE, "1 7 8 2 -20 1 2 3",
      "btype id1 id2 dist engpot force", {} },
  };
  for (const Case& each : cases)
  {
    SCOPED_TRACE(each.table);
    const int count = static_cast<int>(granular::split_words(each.row).size());
    // a column that says what it is does not count
    for (const bool index : { false, true })
    {
      LinesReader reader({ Write((index ? "index " : "") + silent_columns(count),
        { (index ? "1 " : "") + std::string(each.row) }) });
      reader->SetPreset(each.preset);
      EXPECT_EQ(reader->GetPreset(), each.preset);
      reader->Update();
      EXPECT_EQ(reader.TakeSaid(), Texts{});
      EXPECT_EQ(reader.Names(true), (index ? "index " : "") + std::string(each.table));
      EXPECT_EQ(reader.Points(), each.points);
      const auto* id2 = vtkTypeInt64Array::SafeDownCast(reader.Rows()->GetColumnByName("id2"));
      ASSERT_TRUE(id2);
      EXPECT_EQ(id2->GetValue(0), 8);
      vtkAbstractArray* force = reader.Rows()->GetColumnByName("force");
      EXPECT_TRUE(!force || ValuesOf(force) == (Values{ 1, 2, 3 }));
    }
  }
}

TEST(LocalReaderVtk, WrongPresetIsAnErrorAndChangesNothing)
{
  LinesReader reader({});
  EXPECT_EQ(reader->GetPreset(), vtkGranularLocalReader::AUTOMATIC);
  reader->SetPreset(vtkGranularLocalReader::BONDS);
  for (const int wrong : { -5, 1000 })
  {
    reader->SetPreset(wrong);
    EXPECT_EQ(
      reader.TakeSaid(), Texts{ "Preset must be from 0 to 12, got " + std::to_string(wrong) });
    EXPECT_EQ(reader->GetPreset(), vtkGranularLocalReader::BONDS);
  }
}

TEST(LocalReaderVtk, ColumnMap)
{
  const std::string path = Write(silent_columns(9), { "1 2 3 1 2 5 7 8 0" });
  LinesReader reader({ path });
  EXPECT_STREQ(reader->GetColumnMap(), "");
  reader->SetColumnMap("pos id");
  EXPECT_STREQ(reader->GetColumnMap(), "pos id");
  reader->Update();
  EXPECT_EQ(reader.Names(), "id1 id2 periodic length");
  reader->SetColumnMap("x1 y1 z1, x2 y2 z2, batom1, batom2, mine");
  reader->Update();
  EXPECT_EQ(reader.Names(), "id1 id2 mine length");
  EXPECT_EQ(ValuesOf(reader.Cells("mine")), Values{ 0 });
  reader->SetColumnMap("id1=c_a[7] id2=8");
  reader->Update();
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 0);
  EXPECT_EQ(ValuesOf(reader.Rows()->GetColumnByName("id1")), Values{ 7 });
  EXPECT_EQ(ValuesOf(reader.Rows()->GetColumnByName("id2")), Values{ 8 });
  EXPECT_EQ(reader.TakeSaid(), Texts{});
  // it goes before the preset, and gives way to it when it is empty
  reader->SetPreset(vtkGranularLocalReader::WALL_CONTACTS);
  reader->Update();
  EXPECT_TRUE(reader.Rows()->GetColumnByName("id1"));
  reader->SetColumnMap(nullptr);
  reader->Update();
  EXPECT_EQ(reader.Names(), "mesh triangle id2 length");
  reader->SetPreset(vtkGranularLocalReader::AS_NAMED);
  reader->Update();
  EXPECT_EQ(reader.Names(true), "c_a");
  EXPECT_EQ(reader.TakeSaid(), Texts{});
}

TEST(LocalReaderVtk, Errors)
{
  const std::string path = Write(silent_columns(3), { "1 2 1", "1 3 1" });
  LinesReader reader({ path });
  reader.ExpectError(path +
    ":1: expected columns whose names say what they hold, got c_a[1] c_a[2] c_a[3]; several "
    "presets fit the values: BondIds (id1 id2 btype) BondTypeIds (btype id1 id2); set Preset or "
    "ColumnMap");
  reader->SetPreset(vtkGranularLocalReader::CONTACTS);
  reader.ExpectError(path +
    ":1: expected the 9 columns of the preset Contacts (x1 y1 z1 x2 y2 z2 id1 id2 periodic), got "
    "3: c_a[1] c_a[2] c_a[3]");
  reader->SetColumnMap("id1 id2");
  reader.ExpectError(path +
    ":1: expected a name for each of 3 columns in the column map, got 2: id1 id2; the columns are "
    "c_a[1] c_a[2] c_a[3]");
  reader->SetColumnMap("id1=c_b[1]");
  reader.ExpectError(path +
    ":1: expected a column, or its number from 1 to 3, in the column map, got 'c_b[1]'; the "
    "columns are c_a[1] c_a[2] c_a[3]");
  reader->SetColumnMap("");
  reader->SetPreset(vtkGranularLocalReader::BOND_IDS);
  reader->Update();
  EXPECT_EQ(reader.Rows()->GetNumberOfRows(), 2);
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.TakeSaid(), Texts{});
}

TEST(LocalReaderVtk, ErrorsOfRows)
{
  const auto error = [](const std::string& columns, const Texts& rows, const std::string& text)
  {
    const std::string path = Write(columns, rows);
    LinesReader reader({ path });
    reader.ExpectError(path + text);
  };
  error("id1 id2", { "1 2", "1 2.5" }, ":11: column 'id2': expected an integer, got '2.5'");
  error("id1 id2", { "1 2", "1 1e20" }, ":11: column 'id2': expected an integer, got '1e20'");
  error("id1 id2 btype", { "1 2 3", "1 2" }, ":11: expected 3 words in a row, got 2");
  error("x1 y1 z1 x2 y2 z2", { "1 1 1 2 2 2", "1 1 one 2 2 2" },
    ":11: column 'z1': expected a number, got 'one'");
  error("id1 id2 c_d", { "1 2 0.5", "1 3 x" }, ":11: column 'c_d': expected a number, got 'x'");
  error("id1 id2 dist", { "1 2 far" }, ":10: column 'dist': expected a number, got 'far'");
  // where rows tell what the columns are, too
  error(
    silent_columns(3), { "1 2 1", "1 x 1" }, ":11: column 'c_a[2]': expected a number, got 'x'");
}

TEST(LocalReaderVtk, ArraysThatAreRead)
{
  LinesReader reader({ Write(FullNames, FullRows) });
  reader->UpdateInformation();
  EXPECT_EQ(
    reader.Selection(), "(position1) (position2) id1 id2 btype force torque equilibrium_length");
  vtkDataArraySelection* arrays = reader->GetCellDataArraySelection();
  arrays->DisableAllArrays();
  arrays->EnableArray("force");
  arrays->EnableArray("position2");
  reader->Update();
  EXPECT_EQ(reader.Names(), "position2 force length");
  EXPECT_EQ(reader.Names(true), "position2 force");
  EXPECT_EQ(ValuesOf(reader.Cells("position2")), (Values{ 1, 2, 5, 4, 8, 7 }));
  arrays->DisableAllArrays();
  reader->Update();
  EXPECT_EQ(reader.Names(), "length");
  EXPECT_EQ(reader.Points().size(), 12u);
  EXPECT_EQ(reader.TakeSaid(), Texts{});
}

// From 9.5 to 0.5: once around.
TEST(LocalReaderVtk, PeriodicLines)
{
  LinesReader reader({ Write("x1 y1 z1 x2 y2 z2 id1 id2 tag",
    { "1 1 1 2 1 1 1 2 a", "9.5 1 1 0.5 1 1 2 3 b", "3 3 3 3 3 5 4 5 a" }) });
  reader->SetPointOrigin(1, 0, 0);
  reader->Update();
  EXPECT_EQ(reader.Points(), (Values{ 0, 1, 1, 1, 1, 1, 8.5, 1, 1, 9.5, 1, 1, 2, 3, 3, 2, 3, 5 }));
  EXPECT_EQ(ValuesOf(reader.Cells("length")), (Values{ 1, 1, 2 }));
  reader->SetPeriodicLines(vtkGranularLocalReader::SPLIT);
  reader->Update();
  EXPECT_EQ(reader.Points(),
    (Values{ 0, 1, 1, 1, 1, 1, 8.5, 1, 1, 9, 1, 1, -1, 1, 1, -0.5, 1, 1, 2, 3, 3, 2, 3, 5 }));
  EXPECT_EQ(ValuesOf(reader.Cells("row")), (Values{ 0, 1, 1, 2 }));
  EXPECT_TRUE(vtkTypeInt64Array::SafeDownCast(reader.Cells("row")));
  EXPECT_EQ(ValuesOf(reader.Cells("part")), (Values{ 0, 0, 1, 0 }));
  EXPECT_TRUE(vtkTypeInt32Array::SafeDownCast(reader.Cells("part")));
  EXPECT_EQ(ValuesOf(reader.Cells("length")), (Values{ 1, 1, 1, 2 })) << "of all parts";
  EXPECT_EQ(ValuesOf(reader.Cells("id2")), (Values{ 2, 3, 3, 5 }));
  auto* tags = vtkStringArray::SafeDownCast(reader.Cells("tag"));
  ASSERT_TRUE(tags && tags->GetNumberOfValues() == 4);
  EXPECT_EQ(tags->GetValue(2), "b");
  EXPECT_EQ(tags->GetValue(3), "a");
  EXPECT_EQ(reader.Rows()->GetNumberOfRows(), 3);
  reader->SetPeriodicLines(vtkGranularLocalReader::AS_WRITTEN);
  reader->Update();
  EXPECT_EQ(reader.Points(), (Values{ 0, 1, 1, 1, 1, 1, 8.5, 1, 1, -0.5, 1, 1, 2, 3, 3, 2, 3, 5 }));
  EXPECT_EQ(ValuesOf(reader.Cells("length")), (Values{ 1, 9, 2 }));
  EXPECT_FALSE(reader.Cells("row"));
  EXPECT_FALSE(reader.Cells("part"));
  reader->SetPointOrigin(std::numeric_limits<double>::infinity(), 0, 0);
  reader.TakeSaid();
  reader.ExpectError("PointOrigin must be finite");
}

// What the lines have of their own is not what the file calls so: that is there, too, and the table has it as it is.
TEST(LocalReaderVtk, ColumnsNamedLikeArraysOfLines)
{
  const std::string path = Write("x1 y1 z1 x2 y2 z2 length length_2 row part",
    { "1 1 1 2 1 1 10 20 30 a", "9.5 1 1 0.5 1 1 11 21 31 b" });
  LinesReader reader({ path });
  reader->Update();
  EXPECT_EQ(reader.TakeSaid(), Texts{});
  EXPECT_EQ(reader.Names(), "length length_2 row part length_3");
  EXPECT_EQ(ValuesOf(reader.Cells("length_3")), (Values{ 1, 1 }));
  EXPECT_EQ(ValuesOf(reader.Cells("length")), (Values{ 10, 11 }));
  EXPECT_EQ(ValuesOf(reader.Cells("row")), (Values{ 30, 31 }));
  reader->SetPeriodicLines(vtkGranularLocalReader::SPLIT);
  reader->Update();
  EXPECT_EQ(reader.TakeSaid().size(), 1u); // of row and part
  EXPECT_EQ(reader.Names(), "length length_2 row_2 part_2 row part length_3");
  EXPECT_EQ(ValuesOf(reader.Cells("row")), (Values{ 0, 1, 1 }));
  EXPECT_EQ(ValuesOf(reader.Cells("row_2")), (Values{ 30, 31, 31 }));
  EXPECT_EQ(reader.Cells("part_2")->GetVariantValue(2).ToString(), "b");
  EXPECT_EQ(reader.Names(true), "length length_2 row part");
  EXPECT_EQ(ValuesOf(reader.Rows()->GetColumnByName("length")), (Values{ 10, 11 }));
}

// Ends need all of x y z.
TEST(LocalReaderVtk, EndsThatAreNotComplete)
{
  LinesReader reader({ Write("x1 y1 x2 y2 id1 id2", { "1 1 2 2 1 2" }) });
  reader->Update();
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 0);
  EXPECT_EQ(reader.Names(true), "x1 y1 x2 y2 id1 id2");
}

TEST(LocalReaderVtk, FramesWithoutRows)
{
  const std::string path = WriteFile("a.dump",
    local_frame(FullNames, {}, Box, "ENTRIES", 10) +
      local_frame(FullNames, FullRows, Box, "ENTRIES", 20) +
      local_frame(FullNames, {}, Box, "ENTRIES", 30));
  LinesReader reader({ path });
  EXPECT_EQ(reader.Times(), (Values{ 10, 20, 30 }));
  for (int periodic = 0; periodic < 3; ++periodic)
  {
    reader->SetPeriodicLines(periodic);
    const std::string row = periodic == vtkGranularLocalReader::SPLIT ? "row part " : "";
    for (const double time : { 10.0, 20.0, 30.0, 10.0 })
    {
      reader->UpdateTimeStep(time);
      EXPECT_EQ(reader.Lines()->GetNumberOfCells(), time == 20 ? 2 : 0);
      EXPECT_EQ(reader.Names(), "id1 id2 btype force torque equilibrium_length " + row + "length");
      EXPECT_EQ(Field(reader.Lines(), "timestep"), Values{ time });
      EXPECT_EQ(reader.Cells("force")->GetNumberOfComponents(), 3);
    }
  }
  EXPECT_EQ(reader.TakeSaid(), Texts{});
}

// What the columns are is seen in the frame with most rows, whichever is shown first.
TEST(LocalReaderVtk, TheFirstFrameHasTheArraysOfAll)
{
  LinesReader reader({ local_file("contacts.dump") });
  reader->UpdateTimeStep(0);
  EXPECT_EQ(reader.Names(), "id1 id2 periodic force length");
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 0);
  EXPECT_EQ(reader.TakeSaid(), Texts{}) << "the forces push: there is no doubt";
}

// The same columns with torques: c_fc[10] to c_fc[12] turn and do not push.
TEST(LocalReaderVtk, TorquesLookLikeForces)
{
  std::vector<std::string> rows;
  for (int i = 1; i <= 12; ++i)
  {
    const std::string x = std::to_string(i);
    rows.push_back(x + " 1 1 " + x + " 1 2 " + x + " " + std::to_string(i + 100) + " 0 0.5 -0.5 0");
  }
  const std::string path = WriteFile("torques.dump",
    local_frame(silent_columns(12), {}, Box, "ENTRIES", 1) +
      local_frame(silent_columns(12), rows, Box, "ENTRIES", 2));
  LinesReader reader({ path });
  for (const double time : { 1.0, 2.0, 1.0 })
  {
    reader->UpdateTimeStep(time);
  }
  EXPECT_EQ(reader.TakeSaid(),
    Texts{ path +
      ":1: the columns are not named: taken for the preset ContactsForce (x1 y1 z1 x2 y2 z2 id1 "
      "id2 periodic forcex forcey forcez), which fits the values; set Preset to it if that is "
      "right, otherwise name the columns in ColumnMap, such as torque, not force" });
}

TEST(LocalReaderVtk, ColumnsThatChange)
{
  const std::string path = WriteFile("a.dump",
    local_frame("id1 id2", { "1 2" }, Box, "ENTRIES", 1) +
      local_frame("x1 y1 z1 x2 y2 z2 id1 id2 c_f", { "1 1 1 1 1 3 5 6 0.5" }, Box, "ENTRIES", 2) +
      local_frame(silent_columns(16),
        { "1 1 1 2 1 1 7 8 1 0 0 5 0 0 0 1", "2 1 1 3 1 1 8 9 2 0 0 5 0 0 0 1" }, Box, "BONDS", 3));
  LinesReader reader({ path });
  reader->UpdateTimeStep(1);
  EXPECT_EQ(
    reader.Selection(), "id1 id2 (position1) (position2) c_f btype force torque equilibrium_length")
    << "frame by frame";
  EXPECT_EQ(reader.Names(true), "id1 id2");
  reader->UpdateTimeStep(2);
  EXPECT_EQ(reader.Names(), "id1 id2 c_f length");
  reader->UpdateTimeStep(3);
  EXPECT_EQ(reader.Names(), "id1 id2 btype force torque equilibrium_length length");
  EXPECT_EQ(reader.TakeSaid(), Texts{});
  // of a preset that is not that of all frames those that it does not fit are errors
  reader->SetPreset(vtkGranularLocalReader::BONDS_FORCE_TORQUE);
  reader->UpdateTimeStep(3);
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 2);
  reader->UpdateTimeStep(2);
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 0);
  const Texts said = reader.TakeSaid();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].rfind(path + ":11: expected the 16 columns of the preset", 0), 0u) << said[0];
  reader->UpdateTimeStep(3);
  EXPECT_EQ(reader.Lines()->GetNumberOfCells(), 2);
}

TEST(LocalReaderVtk, AGrowingRun)
{
  const std::string names = silent_columns(3);
  const std::string path = WriteFile("a.dump", local_frame(names, {}, Box, "ENTRIES", 0));
  LinesReader reader({ path });
  reader->RefreshOnUpdateOn();
  reader->Update();
  EXPECT_EQ(reader.Times(), Values{ 0 });
  EXPECT_EQ(reader.Names(true), "c_a") << "nothing is known yet";
  const std::string next =
    local_frame(names, { "1 1 2", "1 2 3", "1 3 4", "2 4 5" }, Box, "ENTRIES", 5);
  std::ofstream(path, std::ios::app | std::ios::binary) << next.substr(0, next.size() - 4);
  EXPECT_EQ(reader.Times(), Values{ 0 }) << "not complete";
  std::ofstream(path, std::ios::app | std::ios::binary) << next.substr(next.size() - 4);
  EXPECT_EQ(reader.Times(), (Values{ 0, 5 }));
  for (const double time : { 5.0, 0.0 })
  {
    reader->UpdateTimeStep(time);
    EXPECT_EQ(reader.Names(true), "btype id1 id2");
    EXPECT_EQ(reader.Rows()->GetNumberOfRows(), time == 5 ? 4 : 0);
  }
  std::filesystem::remove(path);
  WriteFile("a.dump", local_frame("id1 id2", { "1 2" }, Box, "ENTRIES", 7));
  EXPECT_EQ(reader.Times(), Values{ 7 });
  reader->Update();
  EXPECT_EQ(reader.Names(true), "id1 id2");
}

TEST(LocalReaderVtk, CanReadFile)
{
  for (const char* name : { "contacts.dump", "chain_bonds.dump", "label.dump" })
  {
    EXPECT_TRUE(vtkGranularLocalReader::CanReadFile(local_file(name).c_str())) << name;
  }
  for (const std::string& path : { Good("grains.dump"), Good("grains.bin"), Good("euler_1000.vtk"),
         local_file("pieces_3000.2.dump"), local_file("chain.data"), std::string("/"),
         std::string("/no/such") })
  {
    EXPECT_FALSE(vtkGranularLocalReader::CanReadFile(path.c_str())) << path;
  }
  EXPECT_FALSE(vtkGranularLocalReader::CanReadFile(nullptr));
}
