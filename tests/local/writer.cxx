// SPDX-License-Identifier: BSD-3-Clause
// What vtkGranularLocalWriter writes of lines and tables, and what it refuses.
#include "vtkGranularLocalReader.h"
#include "vtkGranularLocalWriter.h"

#include "../support/whole_file_writers.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkVariantArray.h"

#include <array>
#include <limits>

namespace
{
using LocalWriter = WholeFileWriter<vtkGranularLocalWriter>;
using Integers = std::vector<vtkTypeInt64>;

/// A line from the first to the last of these points.
using Polyline = std::vector<std::array<double, 3>>;

template <class Array = vtkDoubleArray, class Value = double>
void AddValues(
  vtkFieldData* data, const char* name, const std::vector<Value>& values, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const Value value : values)
  {
    array->InsertNextValue(static_cast<typename Array::ValueType>(value));
  }
  data->AddArray(array);
}

void AddIds(vtkFieldData* data, const char* name, const Integers& values)
{
  AddValues<vtkTypeInt64Array>(data, name, values);
}

vtkSmartPointer<vtkPolyData> MakeLines(const std::vector<Polyline>& cells)
{
  auto lines = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> array;
  for (const Polyline& cell : cells)
  {
    vtkNew<vtkIdList> ids;
    for (const auto& point : cell)
    {
      ids->InsertNextId(points->InsertNextPoint(point.data()));
    }
    array->InsertNextCell(ids);
  }
  lines->SetPoints(points);
  lines->SetLines(array);
  AddField(lines, "timestep", { 7 });
  return lines;
}

void AddBox(vtkDataObject* data, double size = 10)
{
  AddField(data, "BoxOrigin", { 0, 0, 0 });
  AddField(data, "BoxVectors", { size, 0, 0, 0, size, 0, 0, 0, size });
  AddText(data, "Boundary", "pp pp ff");
}

/// Two bonds, of the particles 1 and 2, 2 and 3.
vtkSmartPointer<vtkPolyData> MakeBonds()
{
  auto bonds = MakeLines({ { { 0.5, 1, 2 }, { 1.5, 1, 2 } }, { { 1.5, 1, 2 }, { 1.5, 3.25, 2 } } });
  vtkCellData* data = bonds->GetCellData();
  AddIds(data, "id1", { 1, 2 });
  AddIds(data, "id2", { 2, 3 });
  AddValues<vtkIntArray>(data, "btype", std::vector<int>{ 1, -2 });
  AddValues(data, "force", std::vector<double>{ 0, -0.125, 1e-7, 1234567, 4, 5 }, 3);
  AddValues(data, "length", std::vector<double>{ 1, 2.25 });
  return bonds;
}

vtkSmartPointer<vtkTable> MakeTable(const Integers& id1)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  AddIds(table->GetRowData(), "id1", id1);
  AddField(table, "timestep", { 7 });
  return table;
}

void AddColumns(vtkDataObject* data, const std::vector<const char*>& names)
{
  vtkNew<vtkStringArray> array;
  array->SetName("Columns");
  for (const char* name : names)
  {
    array->InsertNextValue(name);
  }
  data->GetFieldData()->AddArray(array);
}

/// A frame of timestep 7 without a box.
std::string Frame(const std::string& columns, const Lines& rows)
{
  std::string text =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ENTRIES\n" + std::to_string(rows.size()) + "\n";
  text += "ITEM: ENTRIES " + columns + " \n";
  for (const std::string& row : rows)
  {
    text += row + " \n";
  }
  return text;
}

/// What is written where nothing is to be said.
std::string Written(vtkDataObject* data, const char* columns = nullptr)
{
  LocalWriter writer(NewName("a.bonds"), data);
  writer->SetColumns(columns);
  const std::string bytes = writer.Bytes();
  EXPECT_EQ(writer.Said->Warnings, Lines{});
  return bytes;
}
}

// ---- lines and tables ---------------------------------------------------------------------------------

TEST(LocalWriter, LinesAndTheirEnds)
{
  auto bonds = MakeBonds();
  AddBox(bonds);
  LocalWriter writer(NewName("a.bonds"), bonds);
  writer->SetLabel("BONDS");
  writer->SetDialect(vtkGranularLocalWriter::LIGGGHTS);
  const std::string rows = "ITEM: BONDS id1 id2 btype forcex forcey forcez x1 y1 z1 x2 y2 z2 \n"
                           "1 2 1 0 -0.125 1e-07 0.5 1 2 1.5 1 2 \n"
                           "2 3 -2 1234567 4 5 1.5 1 2 1.5 3.25 2 \n";
  const std::string head =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF BONDS\n2\nITEM: BOX BOUNDS pp pp ff\n";
  EXPECT_EQ(writer.Bytes(), head + "0 10\n0 10\n0 10\n" + rows);
  writer->SetDialect(vtkGranularLocalWriter::LAMMPS);
  const std::string side = "0.0000000000000000e+00 1.0000000000000000e+01\n";
  EXPECT_EQ(writer.Bytes(), head + side + side + side + rows);
  EXPECT_EQ(writer.Said->Warnings, Lines{});
}

TEST(LocalWriter, TablesHaveNoEnds)
{
  auto table = MakeTable({ 5, 6 });
  vtkNew<vtkStringArray> kinds;
  kinds->SetName("kind of it");
  kinds->InsertNextValue("soft");
  kinds->InsertNextValue("hard");
  table->AddColumn(kinds);
  AddValues<vtkFloatArray>(table->GetRowData(), "length", std::vector<float>{ 0.5F, 2 });
  AddIds(table->GetRowData(), "row", { 3, 3 }); // of the user's own
  EXPECT_EQ(Written(table), Frame("id1 kind_of_it length row", { "5 soft 0.5 3", "6 hard 2 3" }));
}

/// LIGGGHTS 2 had none.
TEST(LocalWriter, NoBoxIsNoMatter)
{
  EXPECT_EQ(Written(MakeBonds(), "id1 id2"), Frame("id1 id2", { "1 2", "2 3" }));
}

TEST(LocalWriter, IdsHaveAllTheirDigits)
{
  auto table = MakeTable({ 1000001, 2147483649, 9007199254740993 });
  AddValues(table->GetRowData(), "id2", std::vector<double>{ 1000002, 0x1p31, 0x1p53 - 1 });
  AddIds(table->GetRowData(), "mine", { 4294967297, -1000003, 0 });
  AddValues<vtkUnsignedLongLongArray>(table->GetRowData(), "theirs",
    std::vector<unsigned long long>{ 1, 2, std::numeric_limits<long long>::max() });
  EXPECT_EQ(Written(table),
    Frame("id1 id2 mine theirs",
      { "1000001 1000002 4294967297 1", "2147483649 2147483648 -1000003 2",
        "9007199254740993 9007199254740991 0 9223372036854775807" }));
}

TEST(LocalWriter, NumberFormat)
{
  auto table = MakeTable({ 1000001 });
  AddValues(table->GetRowData(), "third", std::vector<double>{ 1.0 / 3 });
  LocalWriter writer(NewName("a.bonds"), table);
  for (const auto& [format, third] : std::vector<std::pair<const char*, const char*>>{
         { "%g", "0.333333" }, { "%.3g", "0.333" }, { "shortest", "0.3333333333333333" } })
  {
    writer->SetNumberFormat(format);
    EXPECT_EQ(writer.Bytes(), Frame("id1 third", { std::string("1000001 ") + third }));
  }
}

// ---- columns ------------------------------------------------------------------------------------------

TEST(LocalWriter, ColumnsThatAreChosen)
{
  auto bonds = MakeBonds();
  AddValues(bonds->GetCellData(), "v_mean", std::vector<double>{ 1, 2, 3, 4 }, 2);
  EXPECT_EQ(Written(bonds, " position2 id2\tforcez  v_mean force y1 length v_mean[2] "),
    Frame("x2 y2 z2 id2 forcez v_mean[1] v_mean[2] forcex forcey forcez y1 length v_mean[2]",
      { "1.5 1 2 2 1e-07 1 2 0 -0.125 1e-07 1 1 2", "1.5 3.25 2 3 5 3 4 1234567 4 5 1 2.25 4" }));
}

TEST(LocalWriter, ColumnsOfTheFileComeFirst)
{
  auto bonds = MakeBonds();
  AddIds(bonds->GetCellData(), "row", { 0, 1 });
  AddColumns(bonds, { "forcez", "x2", "id2", "id1" });
  EXPECT_EQ(Written(bonds),
    Frame("forcez x2 id2 id1 btype forcex forcey x1 y1 z1 y2 z2",
      { "1e-07 1.5 2 1 1 0 -0.125 0.5 1 2 1 2", "5 1.5 3 2 -2 1234567 4 1.5 1 2 3.25 2" }));
  // what the file had is no array that was made of lines
  AddColumns(bonds, { "id1", "length", "btype", "dist" });
  LocalWriter writer(NewName("a.bonds"), bonds);
  EXPECT_EQ(writer.Bytes().find("ITEM: ENTRIES id1 length btype id2 forcex"),
    writer.Bytes().find("ITEM: ENTRIES "));
  EXPECT_EQ(
    writer.Said->Warnings, Lines(2, "columns of the input without an array are left out: dist"));
}

TEST(LocalWriter, AVectorOfAnotherSizeHasNoKnownNames)
{
  auto table = MakeTable({ 1 });
  AddValues(table->GetRowData(), "force", std::vector<double>{ 1, 2 }, 2);
  AddValues(table->GetRowData(), "torque", std::vector<double>{ 3 });
  EXPECT_EQ(Written(table), Frame("id1 force[1] force[2] torque", { "1 1 2 3" }));
  EXPECT_EQ(Written(table, "force torque"), Frame("force[1] force[2] torque", { "1 2 3" }));
}

TEST(LocalWriter, ArraysThatAreNoColumns)
{
  auto table = MakeTable({ 1 });
  vtkNew<vtkVariantArray> variants;
  variants->SetName("anything");
  variants->InsertNextValue(vtkVariant(1));
  table->AddColumn(variants);
  LocalWriter writer(NewName("a.bonds"), table);
  EXPECT_EQ(writer.Bytes(), Frame("id1", { "1" }));
  EXPECT_EQ(writer.Said->Warnings, Lines{ "the array 'anything' of the type variant is left out" });
}

// ---- ends ---------------------------------------------------------------------------------------------

TEST(LocalWriter, PositionsWinOverPoints)
{
  auto bonds = MakeBonds();
  AddValues(bonds->GetCellData(), "position2", std::vector<double>{ 7, 8, 9, 10, 11, 12 }, 3);
  EXPECT_EQ(Written(bonds, "x1 y1 z1 x2 y2 z2"),
    Frame("x1 y1 z1 x2 y2 z2", { "0.5 1 2 7 8 9", "1.5 1 2 10 11 12" }));
  AddValues(bonds->GetCellData(), "position1", std::vector<double>{ 1, 2, 3, 4, 5, 6 }, 3);
  EXPECT_EQ(Written(bonds, "x1 y1 z1 x2 y2 z2"),
    Frame("x1 y1 z1 x2 y2 z2", { "1 2 3 7 8 9", "4 5 6 10 11 12" }));
}

TEST(LocalWriter, PointsOfAllKinds)
{
  const char* const ends = "x1 y1 z1 x2 y2 z2";
  auto line = MakeLines({ { { 0.25, 0.5, -0.5 }, { 1.75, 0.5, 3 } } });
  AddBox(line);
  const auto rows = [&]
  {
    const std::string bytes = Written(line, ends);
    return bytes.substr(bytes.find(ends) + 19);
  };
  AddField(line, "PointOrigin", { 100, 0, -1 });
  EXPECT_EQ(rows(), "100.25 0.5 -1.5 101.75 0.5 2 \n");
  AddText(line, "Coordinates", "Unwrapped"); // and not wrapped now
  EXPECT_EQ(rows(), "100.25 0.5 -1.5 101.75 0.5 2 \n");
  AddText(line, "Coordinates", "Scaled");
  AddField(line, "PointOrigin", { 1, 0, 0 });
  EXPECT_EQ(rows(), "12.5 5 -5 27.5 5 30 \n");
  AddText(line, "Coordinates", "Absolute");
  AddField(line, "PointOrigin", { 0, 0, 0 });
  EXPECT_EQ(rows(), "0.25 0.5 -0.5 1.75 0.5 3 \n");
}

/// From the first point of the first part to the last of the last.
TEST(LocalWriter, PartsOfSplitLinesAreOneRow)
{
  const auto make = []
  {
    return MakeLines({ { { 1, 5, 5 }, { 0, 5, 5 } }, { { 10, 5, 5 }, { 9, 6, 5 } },
      { { 9, 4, 5 }, { 9, 0, 5 } }, { { 9, 10, 5 }, { 10, 9, 5 } }, { { 0, 9, 5 }, { 1, 8, 5 } },
      { { 2, 2, 2 }, { 3, 3, 3 } } });
  };
  auto lines = make();
  AddIds(lines->GetCellData(), "id1", { 4, 4, 5, 5, 5, 6 });
  AddIds(lines->GetCellData(), "row", { 0, 0, 1, 1, 1, 2 });
  AddIds(lines->GetCellData(), "part", { 0, 1, 0, 1, 2, 0 });
  const Lines expected{ "4 1 5 5 9 6 5", "5 9 4 5 1 8 5", "6 2 2 2 3 3 3" };
  EXPECT_EQ(Written(lines), Frame("id1 x1 y1 z1 x2 y2 z2", expected));
  EXPECT_EQ(Written(lines, "row part id1"), Frame("row part id1", { "0 0 4", "1 0 5", "2 0 6" }));
  // rows of several files have the same numbers, and are rows of their own
  AddIds(lines->GetCellData(), "row", { 0, 0, 0, 0, 0, 0 });
  EXPECT_EQ(Written(lines, "id1 x2"), Frame("id1 x2", { "4 9", "5 1", "6 3" }));
  // numbers that are no integers tell nothing
  AddValues(lines->GetCellData(), "part", std::vector<double>{ 0, 1, 0, 1, 2, 0 });
  EXPECT_EQ(Written(lines, "x1"), Frame("x1", { "1", "10", "9", "9", "0", "2" }));
}

TEST(LocalWriterErrors, PartsThatAreNotTogether)
{
  auto lines = MakeLines(std::vector<Polyline>(3, { { 0, 0, 0 }, { 1, 0, 0 } }));
  AddIds(lines->GetCellData(), "part", { 0, 0, 1 });
  EXPECT_EQ(Written(lines, "part x1"), Frame("part x1", { "0 0", "0 0" }));
  for (const Integers& parts : { Integers{ 0, 2, 0 }, Integers{ 1, 0, 0 } })
  {
    AddIds(lines->GetCellData(), "part", parts);
    LocalWriter writer(NewName("a.bonds"), lines);
    writer.ExpectError(vtkErrorCode::UnknownError,
      "expected the parts of each line one after the other, got 1 of other lines or places: with "
      "PeriodicLines MinimumImage lines are whole");
    EXPECT_EQ(Beside(writer->GetFileName()), Lines{});
  }
}

TEST(LocalWriter, DuplicatesAreLeftOut)
{
  auto bonds = MakeBonds();
  AddValues<vtkUnsignedCharArray>(bonds->GetCellData(), vtkDataSetAttributes::GhostArrayName(),
    std::vector<int>{ vtkDataSetAttributes::DUPLICATECELL, vtkDataSetAttributes::HIDDENCELL });
  EXPECT_EQ(Written(bonds, "id1 x1"), Frame("id1 x1", { "2 1.5" }));
  auto table = MakeTable({ 1, 2, 3 });
  AddValues<vtkUnsignedCharArray>(
    table->GetRowData(), vtkDataSetAttributes::GhostArrayName(), std::vector<int>{ 0, 1, 0 });
  EXPECT_EQ(Written(table), Frame("id1", { "1", "3" }));
}

// ---- nothing ------------------------------------------------------------------------------------------

TEST(LocalWriter, NoRows)
{
  auto lines = MakeLines({});
  AddIds(lines->GetCellData(), "id1", {});
  AddColumns(lines, { "x1", "y1", "z1", "x2", "y2", "z2", "id1" });
  EXPECT_EQ(Written(lines), Frame("x1 y1 z1 x2 y2 z2 id1", {}));
  lines->GetCellData()->Initialize(); // as filters leave nothing
  EXPECT_EQ(Written(lines), Frame("x1 y1 z1 x2 y2 z2 id1", {}));
  EXPECT_EQ(Written(MakeTable({})), Frame("id1", {}));
}

/// The first output of a reader of a file that does not say where lines are.
TEST(LocalWriter, NoLinesAsTheFileHasNone)
{
  vtkNew<vtkGranularLocalReader> reader;
  reader->AddFileName(Good("local/chain_bonds.dump").c_str());
  LocalWriter writer(NewName("a.bonds"));
  writer->SetInputConnection(reader->GetOutputPort(0));
  writer.ExpectWritten();
  EXPECT_EQ(writer.Said->Warnings,
    Lines{ "the input has no lines, as its file does not say where these are: rows are on the "
           "second output of the reader" });
}

TEST(LocalWriter, WithoutATimestep)
{
  auto bonds = MakeBonds();
  bonds->GetFieldData()->RemoveArray("timestep");
  LocalWriter writer(NewName("a.bonds"), bonds);
  EXPECT_EQ(writer.Bytes().find("ITEM: TIMESTEP\n0\n"), 0u);
  EXPECT_EQ(writer.Said->Warnings,
    Lines{ "the input has no field data 'timestep': frames are counted from 0" });
}

// ---- errors -------------------------------------------------------------------------------------------

TEST(LocalWriterErrors, OtherThanLinesAndTables)
{
  LocalWriter writer(WriteFile("a.bonds", "the old file"));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBonds());
  writer->SetInputDataObject(blocks);
  writer.ExpectUnsupported(
    "expected lines as cells of a vtkDataSet, or a vtkTable with a row for each, got a "
    "vtkMultiBlockDataSet: the filter MergeBlocks makes one of it");
  vtkNew<vtkImageData> image;
  writer->SetInputDataObject(image);
  writer.ExpectUnsupported("expected a vtkPolyData with lines, or a vtkTable, to write, got a "
                           "vtkImageData: the filter ExtractSurface makes lines of it");
  EXPECT_EQ(Content(writer->GetFileName()), "the old file");
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{ "a.bonds" });
}

TEST(LocalWriterErrors, OtherCells)
{
  LocalWriter writer(
    NewName("a.bonds"), MakeLines({ { { 0, 0, 0 }, { 1, 0, 0 } }, Polyline(3, { 0, 0, 0 }) }));
  writer.ExpectUnsupported("expected lines of two points each to write, got 3 points in line 1");
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0 });
  cells->InsertNextCell({ 1 });
  const std::string expected = "expected lines to write and no other cells, got 2 ";
  using Setter = void (vtkPolyData::*)(vtkCellArray*);
  for (const auto& [set, name] :
    std::vector<std::pair<Setter, const char*>>{ { &vtkPolyData::SetVerts, "vertices" },
      { &vtkPolyData::SetPolys, "polygons" }, { &vtkPolyData::SetStrips, "triangle strips" } })
  {
    auto bonds = MakeLines({ { { 0, 0, 0 }, { 1, 0, 0 } } });
    (bonds->*set)(cells);
    writer->SetInputDataObject(bonds);
    writer.ExpectUnsupported(expected + name);
  }
}

TEST(LocalWriterErrors, Properties)
{
  LocalWriter writer(WriteFile("a.bonds", "the old file"), MakeBonds());
  const std::string word = "expected one word for what the rows are called, as ENTRIES, CONTACTS "
                           "or BONDS, and not that of another section, got '";
  const auto expect = [&](const std::string& text)
  { writer.ExpectError(vtkErrorCode::UnknownError, text); };
  for (const auto& [label, shown] :
    { std::pair{ "MY BONDS", "MY BONDS" }, { "ATOMS", "ATOMS" }, { "TIMESTEP", "TIMESTEP" },
      { "BOX", "BOX" }, { "BONDS ", "BONDS " }, { "BONDS\n", "BONDS\\n" }, { "B\x7f", "B\\x7f" } })
  {
    writer->SetLabel(label);
    writer.ExpectUnsupported(word + shown + "'");
  }
  writer->SetLabel("BONDS");
  writer->SetColumns("id1 id3");
  expect("column 'id3': expected an array to make it from, got none: there are id1, id2, btype, "
         "force, length, position1, position2");
  writer->SetColumns(nullptr);
  writer->SetNumberFormat("%d");
  expect(
    "expected a number format of Automatic, %g, %.Ng with N from 1 to 17, or shortest, got '%d'");
  writer->SetNumberFormat("%g");
  auto scaled = MakeBonds();
  AddText(scaled, "Coordinates", "Scaled");
  writer->SetInputDataObject(scaled);
  EXPECT_EQ(writer->Write(), 0);
  ASSERT_EQ(writer.Said->Errors.size(), 1u);
  EXPECT_NE(writer.Said->Errors[0].find("box"), std::string::npos) << writer.Said->Errors[0];
  auto wrong = MakeBonds();
  AddIds(wrong->GetCellData(), "btype", { 1 });
  writer->SetInputDataObject(wrong);
  expect("column 'btype': expected a value for each of 2 rows, got 1");
  EXPECT_EQ(Content(writer->GetFileName()), "the old file");
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{ "a.bonds" });
  writer->SetInputDataObject(MakeTable({ 1 }));
  EXPECT_NE(writer.Bytes().find("ITEM: BONDS id1 \n1 \n"), std::string::npos);
}

TEST(LocalWriterErrors, BinaryNames)
{
  LocalWriter writer(NewName("a.bin"), MakeBonds());
  writer.ExpectUnsupported(
    "expected text for local data, got a binary dump: no program reads that");
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{});
}

TEST(LocalWriterErrors, OutOfRangeChangesNothing)
{
  LocalWriter writer("a.bonds");
  writer->SetDialect(3);
  EXPECT_EQ(writer.Said->Errors,
    Lines{ "expected Dialect 0 (LIGGGHTS) or 1 (LAMMPS) or 2 (Automatic), got 3" });
  EXPECT_EQ(writer->GetDialect(), vtkGranularLocalWriter::AUTOMATIC);
  std::ostringstream out;
  writer->Print(out);
  for (const char* name : { "FileName: a.bonds", "Dialect: 2", "Label: Automatic", "Columns: \n",
         "NumberFormat: Automatic" })
  {
    EXPECT_NE(out.str().find(name), std::string::npos) << name;
  }
}
