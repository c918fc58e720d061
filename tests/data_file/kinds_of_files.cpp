// SPDX-License-Identifier: BSD-3-Clause
// Data files as people have them: styles, hybrid, labels of types, masses, and what fixes write, with values by hand.
#include "data_run.h"

#include "granular/bytes/compression.h"

#include <algorithm>
#include <map>

namespace
{
using Numbers = std::vector<double>;

/// The values of an array of any type; "points" are those.
Numbers numbers_of(const granular::Table& table, const std::string& name)
{
  const auto as_numbers = [](const auto& values) { return Numbers(values.begin(), values.end()); };
  const int array = table.schema.find_array(name);
  if (array < 0 || name == "points")
  {
    return name == "points" ? points_of(table) : Numbers();
  }
  switch (table.schema.arrays()[static_cast<std::size_t>(array)].type)
  {
    case granular::ValueType::Int64:
      return as_numbers(array_of<std::int64_t>(table, name));
    case granular::ValueType::Int32:
      return as_numbers(array_of<std::int32_t>(table, name));
    default:
      return array_of(table, name);
  }
}

struct Expected
{
  const char* array;
  Numbers values;
};

void expect(DataRun& run, const std::vector<Expected>& expected, const std::string& what = "",
  const granular::DataOptions& options = {})
{
  const granular::Tables frame = run.read({}, options);
  for (const auto& [array, values] : expected)
  {
    const bool of_bonds = std::string_view(array).starts_with("b"); // btype, bond_id
    EXPECT_EQ(numbers_of(of_bonds ? frame.bonds : frame.rows, array), values)
      << what << " " << array;
  }
}

/// A header with counts, the box of 10, and sections.
std::string text_of(const std::string& counts, const std::string& sections)
{
  return "a title\n\n" + counts + "\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\n" + sections;
}

/// The arrays of a text, or the error, or what was said.
std::string told(const std::string& text, const std::string& style = "")
{
  const std::string error = data_error(text, { .atom_style = style });
  return !error.empty()
    ? error
    : names_of(DataRun(write_data(text)).read({}, { .atom_style = style }).rows);
}

std::string said_of(const std::string& text)
{
  DataRun run(write_data(text));
  run.read();
  return run.said();
}

const Numbers diagonal = { 1, 1, 1, 2, 2, 2 };
const std::string labels = "Atom Type Labels\n\n1 C\n12 A\n2 sand\n\n";
}

TEST(DataKinds, ByHand)
{
  const Numbers three = { 1, 1, 1, 2, 2, 2, 3, 3, 3 };
  const std::vector<Expected> bpm = { { "points", three }, { "mol", { 0, 0, 7 } },
    { "type", { 1, 2, 1 } }, { "diameter", { 0.5, 0.4, 0.3 } },
    { "density", { 2000, 2100.5, 1900 } } };
  const std::map<std::string, std::vector<Expected>> files = {
    { "bpm_sphere", bpm },
    { "bpm_sphere_unnamed", bpm },
    { "hybrid",
      { { "points", three }, { "type", { 1, 2, 1 } }, { "diameter", { 0.5, 0.4, 0.3 } },
        { "density", { 2000, 2100.5, 1900 } }, { "mol", { 3, 3, 0 } }, { "btype", { 1, 1 } },
        { "omega", { 1, 2, 3, 0, 0, 0, 0, 0, 9 } }, { "image", Numbers(9) } } },
    { "labels", { { "points", diagonal }, { "type", { 1, 2 } }, { "diameter", { 0.5, 0.4 } } } },
    { "labels_in_rows", { { "points", diagonal }, { "type", { 1, 2 } } } },
    { "type_zero", { { "points", { -1.5, 11.25, 5.5, 1, 1, 1 } }, { "q", { 0, 0 } } } },
    { "masses", { { "type", { 2, 1 } }, { "mass", { 15.9994, 12.011 } } } },
    { "one_ellipsoid",
      { { "shape", { 1, 2, 3, 0, 0, 0 } }, { "quat", { 1, 0, 0, 0, 1, 0, 0, 0 } },
        { "angmom", { 4, 5, 6, 0, 0, 0 } } } },
    { "line", { { "points", { 1, 1, 0 } }, { "type", { 1 } }, { "density", { 1 } } } },
    { "peri",
      { { "points", diagonal }, { "volume", { 0.001, 0.002 } }, { "density", { 2200, 2300 } } } },
    { "no_line_feed", { { "points", { 0, 0, 0, 0.1, 0.1, 0.1 } } } },
  };
  for (const auto& [name, expected] : files)
  {
    DataRun run(good_data("data_file/" + name + ".data"));
    expect(run, expected, name);
  }
}

TEST(DataKinds, ByLammps)
{
  DataRun bonds(good_data("data_file/hybrid_labels.data")); // `Atoms # hybrid`, rows with labels
  const granular::Tables frame = bonds.read();
  EXPECT_EQ(names_of(frame.rows), "id type diameter density mol image radius v omega");
  EXPECT_EQ(frame.rows.type_names, (std::vector<std::string>{ "grain", "shell" }));
  EXPECT_EQ(frame.bonds.type_names, (std::vector<std::string>{ "weak", "strong" }));
  const Numbers types = numbers_of(frame.rows, "type");
  const Numbers diameters = numbers_of(frame.rows, "diameter");
  EXPECT_EQ(std::ranges::count(types, 2), 18);
  for (std::size_t i = 0; i < 75; ++i) // in.bonds gives them by type
  {
    EXPECT_EQ(diameters[i], types[i] == 1 ? 0.003 : 0.0034) << i;
  }
  EXPECT_EQ(frame.bonds.rows, 226);
  EXPECT_EQ(numbers_of(frame.bonds, "btype")[1], 2);

  DataRun properties(good_data("data_file/properties.data"));
  expect(properties,
    { { "i_batch", Numbers(110, 7) }, { "d_heat", Numbers(110, 300.25) },
      { "d2_pos", Numbers(330) } });
  DataRun unbonded(good_data("data_file/hybrid_unbonded.data"));
  EXPECT_EQ(names_of(unbonded.read().rows), "id type diameter density mol image radius v omega");
}

TEST(DataKinds, TheLastLineNeedsNoLineFeed)
{
  const std::string good = text_of(
    "2 atoms", "Atoms # atomic\n\n1 1 1 1 1\n2 1 2 2 2\n\nVelocities\n\n1 0 0 0\n2 0 0 9 # fast");
  const std::vector<Expected> expected = { { "points", diagonal }, { "v", { 0, 0, 0, 0, 0, 9 } } };
  for (const granular::Compression packed :
    { granular::Compression::None, granular::Compression::Gzip, granular::Compression::Zstd })
  {
    DataRun run(write_data(granular::compress(good, packed)));
    expect(run, expected, granular::compress(good, packed).substr(0, 2));
    EXPECT_EQ(run.said(), "");
  }
  EXPECT_EQ(data_error(text_of("2 atoms",
              "Atoms # atomic\n\n1 1 1 1 1\n2 1 2 2 2\n\nVelocities\n\n1 0 0 0\n1 0 0 9")),
    ":16: column 'id': expected one row of each particle in the section Velocities, got another "
    "one of particle 1; the first is in line 15");
  std::string open = granular::compress(good, granular::Compression::Gzip);
  open.resize(open.size() - 8); // the trailer, which proves that nothing more comes
  EXPECT_NE(
    data_error(open).find("got 1, then a last line without its line feed"), std::string::npos);
}

TEST(DataKinds, NamedStyles)
{
  const auto arrays = [](const std::string& style, const std::string& row)
  { return told(text_of("1 atoms", "Atoms # " + style + "\n\n" + row + "\n")); };
  EXPECT_EQ(arrays("tri", "1 7 2 1 2500 3 4 5"), "id mol type triangleflag density");
  EXPECT_EQ(arrays("body", "1 2 1 0.5 3 4 5 0 0 0"), "id type bodyflag mass image");
  EXPECT_EQ(arrays("dipole", "1 2 0 3 4 5 1 0 0"), "id type q mu");
  EXPECT_EQ(arrays("electron", "1 2 0 -1 0.5 3 4 5"), "id type q spin eradius");
  EXPECT_EQ(arrays("spin", "1 2 3 4 5 0 0 1 2.2"), "id type spx spy spz sp");
  EXPECT_EQ(arrays("edpd", "1 2 300 1e5 3 4 5"), "id type edpd_temp edpd_cv");
  EXPECT_EQ(arrays("rheo", "1 2 0 1000 3 4 5"), "id type status rho");
  EXPECT_EQ(arrays("template", "1 2 7 1 3 3 4 5"), "id type mol template_index template_atom");
  EXPECT_EQ(arrays("dielectric", "1 7 2 0 3 4 5 0 0 1 1 1 1 1 0"),
    "id mol type q mu area ed em epsilon curvature");
  EXPECT_EQ(arrays("smd", "1 2 7 1e-3 2 0.1 0.1 3 4 5 3 4 6"),
    "id type mol volume mass kradius cradius x0 y0 z0");
  for (const char* style : { "sphere/omp", "sphere/kk", "sphere/kk/host", "sphere of my script" })
  {
    EXPECT_EQ(arrays(style, "1 2 0.3 2500 3 4 5"), "id type diameter density radius") << style;
  }
  EXPECT_EQ(
    arrays("hybrid/kk my own", "1 2 3 4 5 0.003 2500.5"), "id type diameter density radius");
  EXPECT_EQ(
    arrays("hybrid charge sphere", "1 2 3 4 5 -1 0.3 2500"), "id type q diameter density radius");
  EXPECT_EQ(arrays("hybrid dipole full", "1 2 3 4 5 0 1 0 0 7"), "id type q mu mol");
  const std::string hybrid = text_of("1 atoms", "Atoms # hybrid\n\n1 2 3 4 5 0.3 2500 7\n");
  EXPECT_EQ(told(hybrid, "hybrid sphere bond"), "id type diameter density mol radius");
  EXPECT_EQ(told(hybrid, "hybrid sphere/omp charge"), "id type diameter density q radius");
  EXPECT_NE(
    told(hybrid, "hybrid sphere glue").find("or hybrid, got 'sphere glue'"), std::string::npos);
}

// A file that names no style, and a name that is not known: a guess needs the header and all rows.
TEST(DataKinds, Guesses)
{
  const auto guess = [](const std::string& counts, const std::string& sections)
  { return told(text_of(counts, "Atoms\n\n" + sections + "\n")); };
  const std::string rows = "1 1 2 3 4 5\n2 3 1 3 4 5";
  EXPECT_NE(guess("2 atoms", rows).find("those of charge bond angle molecular fit all rows"),
    std::string::npos);
  EXPECT_EQ(guess("2 atoms\n2 atom types", rows), "id mol type"); // a type of 3 is none
  EXPECT_EQ(guess("2 atoms\n1 bond types", rows), "id mol type");
  EXPECT_EQ(guess("2 atoms", "1 1 2 3 4 5\n2 1 0.5 3 4 5"), "id type q");
  EXPECT_EQ(guess("2 atoms\n1 ellipsoids",
              "1 1 0 2500 1 1 1\n2 1 1 2500 2 2 2\n\nEllipsoids\n\n2 1 2 3 1 0 0 0"),
    "id type ellipsoidflag density shape quat");
  EXPECT_EQ(guess("1 atoms\n1 lines", "1 7 1 1 2500 1 1 0"), "id mol type lineflag density");
  EXPECT_EQ(guess("1 atoms\n1 bodies", "1 1 1 2500 1 1 1"), "id type bodyflag mass");
  EXPECT_EQ(guess("1 atoms", "1 1 0.5 2500 1 1 1\n\nVelocities\n\n1 0 0 0"), // no omega
    ":8: expected the atom style as in 'Atoms # sphere', got none, and rows of 7 words; those of "
    "edpd peri fit all rows: set AtomStyle");
  EXPECT_NE(
    guess("1 atoms", "1 1 3 4 500").find("none that is known fits all rows"), std::string::npos);

  const auto hybrid = [](const std::string& counts, const std::string& sections)
  { return told(text_of(counts, "Atoms # hybrid\n\n" + sections + "\n")); };
  EXPECT_EQ(
    hybrid("1 atoms\n1 ellipsoids", "1 2 3 4 5 1 2500 -0.5 0 0 0\n\nEllipsoids\n\n1 1 2 3 1 0 0 0"),
    "id type ellipsoidflag density q image shape quat");
  EXPECT_EQ(hybrid("1 atoms\n1 bond types", "1 2 3 4 5 70 0.5 2500"),
    "id type mol diameter density radius");
  EXPECT_EQ(hybrid("1 atoms", "1 2 3 4 5 0.3 2500 7"),
    ":8: expected the sub-styles as in 'Atoms # hybrid sphere bond', got none, and rows of 8 "
    "words; "
    "those of hybrid sphere charge, hybrid sphere bond fit all rows: set "
    "AtomStyle");
  EXPECT_EQ(hybrid("1 atoms\n1 bond types", "1 2 3 4 5 7 -0.5 0.3 2500.5 0 0 0"),
    "id type mol q diameter density image radius"); // full sphere
  EXPECT_NE(hybrid("1 atoms", "1 2 3 4 5 0.3 2500.5 -1.5 0.5 0.5 0.1 0 0 0")
              .find("those of hybrid sphere dipole, hybrid sphere spin, hybrid dipole sphere"),
    std::string::npos);
  EXPECT_EQ(
    told(text_of("1 atoms", "Atoms # oxdna\n\n1 2 3 4 5\n")).find("fit"), std::string::npos);
}

TEST(DataKinds, LabelsOfTypes)
{
  const std::string rows = "Atoms # atomic\n\n1 A 1 1 1\n2 sand 2 2 2\n";
  DataRun run(write_data(text_of("2 atoms\n1 bonds",
    labels +
      "Bond Type Labels\n\n3 glue\n\nMasses\n\nA 0.5\nsand 2 # heavy\n\nPair Coeffs # "
      "zero\n\nA\nsand\n\n" +
      "Atoms # bond\n\n1 7 A 1 1 1\n2 7 sand 2 2 2\n\nBonds\n\n1 glue 2 1\n")));
  expect(run,
    { { "type", { 12, 2 } }, { "mass", { 0.5, 2 } }, { "points", diagonal }, { "btype", { 3 } } });
  EXPECT_EQ(run.said(), "");
  EXPECT_EQ(run.read().rows.type_names[11], "A");
  EXPECT_EQ(run.read().bonds.type_names, (std::vector<std::string>{ "", "", "glue" }));
  granular::Request few;
  few.wanted = [](std::string_view name, bool) { return name == "mass"; };
  EXPECT_EQ(array_of(run.read(few).rows, "mass"), (Numbers{ 0.5, 2 }));
  EXPECT_EQ(names_of(run.read(few).rows), "mass");
  EXPECT_EQ(told(text_of("2 atoms", labels + "Atoms\n\n1 A 1 1 1\n2 sand 2 2 2\n")), "id type");
  EXPECT_EQ(told(text_of("2 atoms", labels + "Atoms # atomic\n\n1 A 1 1 1\n2 glass 2 2 2\n")),
    ":17: column 'type': expected a type or its label, got 'glass'");
  EXPECT_EQ(told(text_of("2 atoms", "Masses\n\n1 heavy\n\n" + rows)),
    ":10: expected a type and its mass, got '1 heavy'");
  EXPECT_EQ(told(text_of("2 atoms", "Masses\n\n1 2.5\n\n" + rows)), // no labels in the file
    ":14: column 'type': expected a number, got 'A'");
  EXPECT_EQ(told(text_of("2 atoms", "Atom Type Labels\n\n1\n\n" + rows)),
    ":10: expected a type and its label, got '1'");
}

TEST(DataKinds, SectionsOfFixes)
{
  const auto text = [](const std::string& section)
  { return text_of("2 atoms", "Atoms # atomic\n\n1 1 1 1 1\n2 1 2 2 2\n\n" + section); };
  DataRun run(
    write_data(text("glue # i_flag d_pos\n\n2 -5 1 2.5 3\n1 7 4 5 6\n\nMolecules\n\n1 3\n2 4\n")));
  expect(
    run, { { "i_flag", { 7, -5 } }, { "d2_pos", { 4, 5, 6, 1, 2.5, 3 } }, { "mol", { 3, 4 } } });
  EXPECT_EQ(run.said(), ""); // flags are integers
  EXPECT_EQ(said_of(text("p # d_a d_b\n\n1 1 2 3\n2 4 5 6\n")),
    "the section p has 3 values a particle and 2 names: the columns are taken for id d_a d2_b[1] "
    "d2_b[2]\n");
  EXPECT_EQ(
    names_of(DataRun(write_data(text("p # d_a i_b\n\n1 1.5 2.5 3\n2 4 5 6\n"))).read().rows),
    "id type d2_a i_b");
  EXPECT_EQ(said_of(text("p # d_a i2_b\n\n1 1 2 3\n2 4 5 6\n")), "");
  EXPECT_EQ(numbers_of(DataRun(write_data(text("p # d_a\n\n1 0.5\n"))).read().rows, "d_a"),
    (Numbers{ 0.5, 0 }));
  EXPECT_EQ(said_of(text("p # d_a\n\n1 1 2\n2 3 4\n")), ""); // of one name all are
  EXPECT_EQ(
    said_of(text("Lines\n\n1 0 0 1 1\n\nBond Coeffs\n\n1 2\n\nmine # a b\n\n1 2 3\n2 3 4\n")),
    "sections that are not read: Lines (1 rows), mine (2 rows)\n");
  EXPECT_EQ(
    data_error(text("p # d_a\n\n1 fast\n")), ":15: column 'd_a': expected a number, got 'fast'");
}

TEST(DataKinds, BoxesThatTheHeaderLacks)
{
  const std::string path =
    write_data("t\n\n1 atoms\n1 atom types\n\nAtoms # atomic\n\n1 1 0 0 0\n");
  EXPECT_TRUE(granular::is_data_file(path));
  const granular::Box box = DataRun(path).read().rows.header.box;
  EXPECT_EQ(box.corner(0, 0, 0), (granular::Vector3{ -0.5, -0.5, -0.5 }));
  EXPECT_EQ(box.corner(1, 1, 1), (granular::Vector3{ 0.5, 0.5, 0.5 }));
  const granular::Box general =
    DataRun(write_data("t\n\n0 atoms\n2 0 0 avec\n0.5 3 0 bvec\n")).read().rows.header.box;
  EXPECT_EQ(general.corner(1, 1, 1), (granular::Vector3{ 2.5, 3, 1 }));
}
