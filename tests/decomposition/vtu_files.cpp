// SPDX-License-Identifier: BSD-3-Clause
// .vtu files in every form that VTK's writer has, by hand, and wrong.
#include "grid_files.h"

#include "granular/formats/decomposition/vtu_grids.h"

#include <gtest/gtest.h>

#include <algorithm>

using granular::Subdomain;

namespace
{
struct Form
{
  const char* name;
  std::int64_t last_count;
};

/// Points of four and of eight bytes, headers of 32 and 64 bits, counts of 32 and 64.
constexpr Form forms[] = { { "text", 2147483647 }, { "inline", std::int64_t{ 1 } << 40 },
  { "inline_zlib", 2147483647 }, { "inline_zlib_big_endian", 2147483647 },
  { "appended_base64", 2147483647 }, { "appended_base64_zlib", std::int64_t{ 1 } << 40 },
  { "appended_raw", 2147483647 }, { "appended_raw_zlib", std::int64_t{ 1 } << 40 },
  { "blocks_raw_zlib", 2147483647 }, { "pieces", 2147483647 }, { "pieces_raw_zlib", 2147483647 } };

/// One voxel, by hand.
std::string one_voxel()
{
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells="1">
<CellData>
<DataArray type="Int32" Name="nlocal" format="ascii">
5</DataArray>
<DataArray type="Int32" Name="proc" format="ascii">3</DataArray>
</CellData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 1 1 0
0 0 1 1 0 1 0 1 1 1 1 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">11</DataArray></Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";
}

const std::vector<Subdomain> unit_box = { { { 0, 0, 0 }, { 1, 1, 1 }, 5, 3 } };

/// A change of it, and what is said behind its name when it is read.
struct Bad
{
  const char* what;
  const char* with;
  const char* said;
};

constexpr Bad bad_files[] = {
  // claims
  { "Points=\"8\"", "Points=\"300000000\"",
    ":4: expected at most 16777216 cells, with eight points each, got 1 with 300000000" },
  { "Points=\"8\"", "Points=\"10000000000000\"",
    ":4: expected at most 16777216 cells, with eight points each, got 1 with 10000000000000" },
  { "Points=\"8\"", "Points=\"100000000\"",
    ":10: expected 300000000 numbers, got 48 bytes of text" },
  { "Points=\"8\"", "Points=\"7\"",
    ":12: expected the end of the array behind 21 numbers, got '1'" },
  { "Points=\"8\"", "Points=\"0\"",
    ":11: expected the end of the array behind 0 numbers, got '0'" },
  { "Points=\"8\"", "Points=\"9\"", ":10: expected 27 numbers, got 48 bytes of text" },
  { "Points=\"8\"", "Points=\"-8\"",
    ":4: expected a number of at least 0 as NumberOfPoints, got '-8'" },
  { " NumberOfPoints=\"8\"", "", ":4: expected a number of at least 0 as NumberOfPoints, got ''" },
  { "Cells=\"1\"", "Cells=\"300000000\"",
    ":4: expected at most 16777216 cells, with eight points each, got 300000000 with 8" },
  { "Cells=\"1\"", "Cells = \"300000000\"",
    ":4: expected at most 16777216 cells, with eight points each, got 300000000 with 8" },
  { "Cells=\"1\"", "Cells\t=\n\"10000000000000\"",
    ":4: expected at most 16777216 cells, with eight points each, got 10000000000000 with 8" },
  { "Cells=\"1\"", "Cells=\"16777216\"",
    ":15: column 'types': expected 16777216 numbers, got 2 bytes of text" },
  { "Cells=\"1\"", "Cells=\"one\"",
    ":4: expected a number of at least 0 as NumberOfCells, got 'one'" },
  { "Name=\"nlocal\"", "Name=\"nlocal\" NumberOfComponents=\"2000000000\"",
    ":6: column 'nlocal': expected NumberOfComponents 1, got 2000000000" },
  { "NumberOfComponents=\"3\"", "", ":10: expected NumberOfComponents 3, got 1" },
  // cells
  { "5 6 7", "5 6 700000000", ":13: expected points from 0 to 7 in cell 0, got 700000000" },
  { "5 6 7", "5 6 -7000000", ":13: expected points from 0 to 7 in cell 0, got -7000000" },
  { "5 6 7", "5 6 8", ":13: expected points from 0 to 7 in cell 0, got 8" },
  { "5 6 7", "5 6", ":13: column 'connectivity': expected 8 numbers, got 13 bytes of text" },
  { "5 6 7", "5 7 6",
    ":13: expected the corners of a box along the axes, in the order of a voxel or a hexahedron, "
    "got cell 0 with others" },
  { ">8<", ">800000000<",
    ":14: expected offsets of eight points a cell, 8 behind cell 0, got 800000000" },
  { ">8<", ">-8<", ":14: expected offsets of eight points a cell, 8 behind cell 0, got -8" },
  { ">11<", ">42<", ":15: expected the cell type of a voxel (11) or a hexahedron (12), got 42" },
  { ">11<", ">255<", ":15: expected the cell type of a voxel (11) or a hexahedron (12), got 255" },
  { "\n5<", "\nx<", ":7: expected a whole number (1 of 1), got 'x'" },
  { "\n5<", "\n5.5<", ":7: expected a whole number (1 of 1), got '5.5'" },
  { "\n5<", "\n-5<", ":7: expected a number 'nlocal' from 0 to 9223372036854775807, got -5" },
  { ">3<", ">3000000000<", ":8: expected a number 'proc' from 0 to 2147483647, got 3000000000" },
  { "1 1 1<", "1 1 up<", ":12: expected a number (24 of 24), got 'up'" },
  { "Name=\"types\"", "Name=\"kinds\"",
    ":4: expected an array Cells types in a piece with cells, got none" },
  { "Name=\"types\"", "Name=\"offsets\"",
    ":15: expected one array Cells offsets in a piece, got another" },
  // forms
  { "type=\"UInt8\"", "type=\"String\"",
    ":15: expected the type Int8 or UInt8 or Int16 or UInt16 or Int32 or UInt32 or Int64 or UInt64 "
    "or Float32 or Float64, got 'String'" },
  { "format=\"ascii\"", "format=\"text\"",
    ":6: expected the format ascii or binary or appended, got 'text'" },
  { "format=\"ascii\"", "format=\"appended\"",
    ":6: expected a number of at least 0 as offset, got ''" },
  { "format=\"ascii\"", "format=\"appended\" offset=\"100\"",
    ":6: column 'nlocal': expected an offset up to 0, got 100" },
  { "format=\"ascii\"", "format=\"binary\"",
    ":6: column 'nlocal': expected 4 bytes in base64, got others or fewer" },
  { "LittleEndian", "MiddleEndian",
    ":2: expected the byte_order LittleEndian or BigEndian, got 'MiddleEndian'" },
  { "version=\"0.1\"", "header_type=\"UInt16\"",
    ":2: expected the header_type UInt32 or UInt64, got 'UInt16'" },
  { "version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\"",
    ":2: expected values without compression or with vtkZLibDataCompressor, got "
    "'vtkLZ4DataCompressor'; save the file with zlib or as ASCII" },
  // tags
  { "</Cells>", "</Cels>", ":15: expected </Cells>, got '</Cels>'" },
  { "</Cells>", "", ":16: expected </Cells>, got '</Piece>'" },
  { "<Cells>", "", ":15: expected </Piece>, got '</Cells>'" },
  { "<Cells>", "<Cells a>",
    ":13: expected a value in quotes of 'a', got '<Cells a><DataArray "
    "type=\"Int32\" Name=\"c...'" },
  { "<Cells>", "< Cells>",
    ":13: expected a name in a tag, got '< Cells><DataArray type=\"Int32\" "
    "Name=\"co...'" },
  { "<Cells>", "<Cells/ >",
    ":13: expected '>' at the end of a tag, got '<Cells/ ><DataArray "
    "type=\"Int32\" Name=\"c...'" },
  { "<Cells>", "<!--<Cells>", ":13: expected '-->', got the end of the file" },
  { "</VTKFile>", "</VTKFile></VTKFile>", ":18: expected no more tags, got '</VTKFile>'" },
};
}

TEST(VtuFiles, InEveryForm)
{
  for (const Form& form : forms)
  {
    SCOPED_TRACE(form.name);
    const std::string path = std::string("good/decomposition/") + form.name + ".vtu";
    GridFile file(data_file(path));
    ASSERT_EQ(file.frames(), 1u) << file.defect();
    EXPECT_EQ(file.entry().rows, 3);
    const granular::Decomposition all = file.read();
    EXPECT_TRUE(all.has_particles && all.has_ranks);
    EXPECT_EQ(all.subdomains, boxes_of_three(form.last_count, { 0, 1, 2 }));
    EXPECT_EQ(file.told() + file.said() + file.defect(), "");
    EXPECT_TRUE(granular::is_decomposition_file(std::string(GRANULAR_DATA) + "/" + path));
  }
}

TEST(VtuFiles, TagsInAnyForm)
{
  const std::string good = one_voxel();
  EXPECT_EQ(GridFile(good).read().subdomains, unit_box);
  const std::string changed[] = { replaced(good, "=", " =\n\t"), replaced(good, "\"", "'"),
    replaced(good, "\n", "\r\n"), "\xef\xbb\xbf" + good, "\n \n" + good, good + "\n\n",
    replaced(good, "<Cells>", "<!-- <Cells> -->\n<Cells >"),
    replaced(good, "<Cells>", "<Other a='>'/><Cells>"),
    replaced(good, "<?xml version=\"1.0\"?>\n", ""),
    replaced(good, "<CellData>", "<PointData/><FieldData><DataArray/></FieldData><CellData>"),
    replaced(good, " byte_order=\"LittleEndian\"", ""), replaced(good, "\"proc\"", "\"procID\""),
    replaced(good, "</Piece>", "</Piece><Piece NumberOfPoints='0' NumberOfCells='0'/>") };
  for (const std::string& text : changed)
  {
    GridFile file(text);
    ASSERT_EQ(file.frames(), 1u) << text;
    EXPECT_EQ(file.read().subdomains, unit_box) << text;
  }
}

TEST(VtuFiles, ADamagedArrayIsAnErrorOfThatFile)
{
  const Folder folder;
  const std::string bad =
    "<Cells><DataArray type=\"Int46\" Name=\"types\">11</DataArray></Cells><CellData>";
  EXPECT_TRUE(granular::is_decomposition_file(
    folder.write("a.vtu", replaced(one_voxel(), "<CellData>", bad))));
}

// What one piece does not have nobody knows.
TEST(VtuFiles, ArraysOfSomePieces)
{
  std::string good = one_voxel();
  const std::size_t first = good.find("<Piece");
  const std::size_t last = good.find("</Piece>") + 8;
  const std::string piece = good.substr(first, last - first);
  good.insert(last, replaced(piece, "\"nlocal\"", "\"other\""));
  GridFile file(good);
  const granular::Decomposition all = file.read();
  EXPECT_FALSE(all.has_particles);
  EXPECT_TRUE(all.has_ranks);
  EXPECT_EQ(all.subdomains,
    (std::vector<Subdomain>{
      { { 0, 0, 0 }, { 1, 1, 1 }, 0, 3 }, { { 0, 0, 0 }, { 1, 1, 1 }, 0, 3 } }));
  GridFile none(replaced(good, "\"proc\"", "\"other\""));
  EXPECT_FALSE(none.read().has_ranks);
  EXPECT_EQ(none.read().subdomains[1].rank, 1);
}

// All pieces are counted, however long the first ones are.
TEST(VtuFiles, PiecesBehindTheHead)
{
  std::string good = one_voxel();
  const std::size_t first = good.find("<Piece");
  const std::size_t last = good.find("</Piece>") + 8;
  const std::string piece = good.substr(first, last - first);
  good.insert(first, replaced(piece, "5</", std::string(granular::vtu_head_bytes, ' ') + "4</"));
  GridFile file(good);
  EXPECT_EQ(file.entry().rows, 2);
  EXPECT_EQ(file.read().subdomains[0].particles, 4);
  EXPECT_EQ(file.read().subdomains[1].particles, 5);
  const Folder folder;
  EXPECT_TRUE(granular::is_decomposition_file(folder.write("a.vtu", good)));
}

TEST(VtuFiles, Wrong)
{
  for (const Bad& bad : bad_files)
  {
    const std::string good = one_voxel();
    ASSERT_NE(good.find(bad.what), std::string::npos) << bad.what;
    std::string text = good;
    text.replace(good.find(bad.what), std::string(bad.what).size(), bad.with);
    GridFile file(text);
    ASSERT_EQ(file.frames(), 1u) << bad.with << file.defect();
    EXPECT_EQ(file.error(), std::string("memory") + bad.said) << bad.with;
  }
}

// ---- what is of others -------------------------------------------------------------------------------

TEST(VtuFiles, OfOthers)
{
  const Folder folder;
  const auto is_one = [&](const std::string& text)
  { return granular::is_decomposition_file(folder.write("a.vtu", text)); };
  const std::string good = one_voxel();
  EXPECT_TRUE(is_one(good));
  EXPECT_TRUE(is_one(replaced(good, "\"proc\"", "\"procID\"")));
  EXPECT_TRUE(is_one(replaced(replaced(good, "2 3 4 5 6 7", "3 2 4 5 7 6"), ">11<", ">12<")));
  EXPECT_TRUE(is_one(replaced(good, "5 6 7", "5 6 8")));    // damaged
  EXPECT_TRUE(is_one(replaced(good, "</Cells>", "</Ce>"))); // damaged
  EXPECT_FALSE(is_one(replaced(good, "\"nlocal\"", "\"other\"")));
  EXPECT_FALSE(is_one(replaced(good, "\"proc\"", "\"other\"")));
  EXPECT_FALSE(is_one(replaced(good, "\"8\"", "\"9\"")));
  EXPECT_FALSE(is_one(replaced(good, "\"8\"", "\"0\"")));
  EXPECT_FALSE(is_one(replaced(good, ">11<", ">10<")));
  EXPECT_FALSE(is_one(replaced(good, "5 6 7", "5 7 6")));
  EXPECT_FALSE(is_one(replaced(good, "1 1 1<", "1 1 2<")));
  EXPECT_FALSE(is_one(replaced(good, "version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\"")));
  std::string tetrahedron = replaced(replaced(good, " 4 5 6 7<", "<"), ">11<", ">10<");
  tetrahedron = replaced(replaced(tetrahedron, ">8<", ">4<"), "\"8\"", "\"4\"");
  EXPECT_FALSE(is_one(replaced(tetrahedron, "\n0 0 1 1 0 1 0 1 1 1 1 1<", "<")));
}
