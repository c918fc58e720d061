// SPDX-License-Identifier: BSD-3-Clause
// Values of particles: against the dumps that the programs wrote of the same step, and by hand.
#include "granular/formats/dump/grammar/dump_files.h"

#include "data_run.h"

#include "../support/counting_source.h"

#include <map>

namespace
{
using Numbers = std::vector<double>;
using Ids = std::vector<std::int64_t>;

granular::Table dump_of(const std::string& path, bool sorted)
{
  granular::RunIndex index;
  granular::IndexOptions options;
  options.format = &granular::dump_format();
  granular::Notices notices;
  granular::Progress progress;
  index.update({ path }, options, notices, progress);
  granular::Request request;
  request.sort_by_id = sorted;
  return granular::read_dump(index.pieces(0), request, notices, progress);
}

void expect_near(const Numbers& found, const Numbers& wanted, const std::string& what)
{
  ASSERT_EQ(found.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    // LAMMPS writes 16 digits here
    EXPECT_NEAR(found[i], wanted[i], 1e-15 * (1 + std::abs(wanted[i]))) << what << " " << i;
  }
}

std::string three(const std::string& style, const std::string& rows, const std::string& velocities)
{
  return data_text(3, "Atoms # " + style + "\n\n" + rows + "\nVelocities\n\n" + velocities);
}

const std::string rows = "3 1 3 0 0 0 0 -1\n1 1 1 0 0 0 2 0\n2 2 2 0 0 0 0 0\n";
}

TEST(DataParticles, AsTheProgramsDumpThem)
{
  const std::map<std::string, std::vector<std::string>> arrays = {
    { "sphere", { "v", "omega", "radius" } }, { "ellipsoid", { "v", "angmom" } },
    { "full", { "v", "q" } }, { "granular", { "v", "omega", "radius", "density" } }
  };
  for (const auto& [style, names] : arrays)
  {
    DataRun run(good_data("data_file/" + style + ".data"));
    granular::Request request;
    request.sort_by_id = true;
    request.threads = 2;
    const granular::Table found = run.read(request).rows;
    const granular::Table wanted = dump_of(good_data("data_file/" + style + ".dump"), true);
    EXPECT_EQ(found.rows, wanted.rows);
    EXPECT_EQ(array_of<std::int64_t>(found, "id"), array_of<std::int64_t>(wanted, "id")) << style;
    EXPECT_EQ(array_of<std::int32_t>(found, "type"), array_of<std::int32_t>(wanted, "type"))
      << style;
    expect_near(points_of(found), points_of(wanted), style);
    for (const std::string& name : names)
    {
      expect_near(array_of(found, name), array_of(wanted, name), style + " " + name);
    }
    if (style != "granular")
    {
      EXPECT_EQ(array_of<std::int32_t>(found, "image"), array_of<std::int32_t>(wanted, "image"))
        << style;
      EXPECT_EQ(found.header.box.corner(1, 1, 1), wanted.header.box.corner(1, 1, 1)) << style;
      EXPECT_EQ(found.header.timestep, wanted.header.timestep) << style;
      EXPECT_EQ(found.header.box.boundary, "pp pp ff") << style; // image counts along x and y
      EXPECT_EQ(run.said(), "") << style;
    }
  }
}

TEST(DataParticles, VelocitiesInAnyOrder)
{
  DataRun run(write_data(three("atomic", rows, "2 2 2 2\n3 3 3 3\n1 1 1 1\n")));
  const granular::Tables frame = run.read();
  EXPECT_EQ(array_of(frame.rows, "v"), (Numbers{ 3, 3, 3, 1, 1, 1, 2, 2, 2 }));
  EXPECT_EQ(frame.rows.header.box.boundary, "ff pp pp");
  granular::Request request;
  request.sort_by_id = true;
  EXPECT_EQ(array_of(run.read(request).rows, "v"), (Numbers{ 1, 1, 1, 2, 2, 2, 3, 3, 3 }));
  request.stride = 2;
  EXPECT_EQ(array_of(run.read(request).rows, "v"), (Numbers{ 2, 2, 2 }));
}

TEST(DataParticles, TwoOfOneIdHaveOneVelocity)
{
  const std::string path =
    write_data(three("atomic", "3 1 3 0 0\n2 1 1 0 0\n2 2 2 0 0\n", "2 2 2 2\n3 3 3 3\n1 1 1 1\n"));
  DataRun run(path);
  EXPECT_EQ(array_of(run.read().rows, "v"), (Numbers{ 3, 3, 3, 2, 2, 2, 2, 2, 2 }));
  EXPECT_EQ(run.said(),
    "rows of the section Velocities that are left out, as their particle is not there: 1\n"
    "particles that have the id of another one, and its velocity: 1\n");

  DataRun other(path);
  granular::Request request;
  request.wanted = [](std::string_view name, bool) { return name == "id"; };
  other.read(request);
  EXPECT_EQ(other.said(), "");
}

// A particle without a row is a point, as LAMMPS has it.
TEST(DataParticles, Ellipsoids)
{
  const auto text = [](const std::string& shapes)
  {
    return "a title\n\n3 atoms\n2 ellipsoids\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\n"
           "Atoms # ellipsoid\n\n3 1 1 2 3 0 0\n1 1 0 2 1 0 0\n2 2 1 2 2 0 0\n\nEllipsoids\n\n" +
      shapes;
  };
  DataRun run(write_data(text("2 4 5 6 0.5 -0.5 0.5 -0.5 8 2.5\n3 1 2 3 1 0 0 0 2 20\n")));
  const granular::Table frame = run.read().rows;
  EXPECT_EQ(array_of(frame, "shape"), (Numbers{ 1, 2, 3, 0, 0, 0, 4, 5, 6 }));
  EXPECT_EQ(array_of(frame, "quat"), (Numbers{ 1, 0, 0, 0, 1, 0, 0, 0, 0.5, -0.5, 0.5, -0.5 }));
  EXPECT_EQ(array_of(frame, "blockiness"), (Numbers{ 2, 20, 2, 2, 8, 2.5 }));
  EXPECT_EQ(frame.schema.text().substr(frame.schema.text().find("shapex")),
    "shapex shapey shapez quatw quati quatj quatk block1 block2");
  granular::Request request;
  request.wanted = [](std::string_view name, bool) { return name == "quat"; };
  EXPECT_EQ(names_of(run.read(request).rows), "quat");
  EXPECT_EQ(run.said(), "");

  const auto error = [&](const std::string& shapes) { return data_error(text(shapes)); };
  EXPECT_EQ(error("3 1 2 3 1 0 0 0\n"),
    ":15: expected 2 rows in the section Ellipsoids, got 1, then the end of the file");
  EXPECT_EQ(error("3 1 2 3 1 0 0\n2 1 2 3 1 0 0\n"),
    ":15: expected rows of 8 or 10 words in the section Ellipsoids, got 7");
  EXPECT_EQ(error("3 1 2 3 1 0 0 0\n3 1 2 3 1 0 0 0\n"),
    ":18: column 'id': expected one row of each particle in the section Ellipsoids, got another "
    "one of particle 3; the first is in line 17");
  DataRun some(write_data(text("3 1 2 3 1 0 0 0 8 8\n2 1 2 3 1 0 0 0\n")));
  EXPECT_EQ(array_of(some.read().rows, "shape"), (Numbers{ 1, 2, 3, 0, 0, 0, 1, 2, 3 }));
  EXPECT_NE(some.said().find("got more in some rows"), std::string::npos) << some.said();
  DataRun stranger(write_data(text("2 4 5 6 1 0 0 0\n4 1 2 3 1 0 0 0\n")));
  EXPECT_EQ(array_of(stranger.read().rows, "shape"), (Numbers{ 0, 0, 0, 0, 0, 0, 4, 5, 6 }));
  EXPECT_EQ(stranger.said(),
    "rows of the section Ellipsoids that are left out, as their particle is not there: 1\n");
}

TEST(DataParticles, FilesAreLookedThroughOnce)
{
  const std::string row = "1 1 0.5 0 0\n";
  const DataRun run(write_data(data_text(1, "Atoms # atomic\n\n" + row)));
  const auto bytes_for_layout = [&](const std::string& text)
  {
    const CountingSource source(text);
    granular::Progress progress;
    granular::find_data_layout(run.file(), source, progress);
    return source.bytes_read();
  };
  EXPECT_EQ(bytes_for_layout(data_text(1, "Atoms # atomic\n\n" + row)), 0);
  const std::string longer = data_text(1, "Atoms # atomic\n\n\n\n" + row);
  write_data(longer); // behind the back of the index
  EXPECT_GT(bytes_for_layout(longer), 0);
}

TEST(DataParticles, WhatDumpsCanDo)
{
  DataRun run(write_data(three("atomic", rows, "2 2 2 2\n3 3 3 3\n1 1 1 1\n")));
  granular::Request request;
  request.coordinates = granular::Coordinates::Unwrapped;
  EXPECT_EQ(points_of(run.read(request).rows), (Numbers{ 3, 0, -10, 1, 20, 0, 2, 0, 0 }));
  request.coordinates = granular::Coordinates::Scaled;
  EXPECT_EQ(points_of(run.read(request).rows), (Numbers{ 0.3, 0, 0, 0.1, 0, 0, 0.2, 0, 0 }));
  request = {};
  request.point_origin = { 1, 1, 1 };
  request.region = { 1.5, 9, 1, -1, 1, -1 };
  const granular::Table some = run.read(request).rows;
  EXPECT_EQ(points_of(some), (Numbers{ 2, -1, -1, 1, -1, -1 }));
  EXPECT_EQ(array_of(some, "v"), (Numbers{ 3, 3, 3, 2, 2, 2 }));
  EXPECT_EQ(run.read({}, { .boundary = "p f f" }).rows.header.box.boundary, "pp ff ff");
  request = {};
  request.wanted = [](std::string_view name, bool) { return name == "v"; };
  EXPECT_EQ(names_of(run.read(request).rows), "v"); // by ids that nobody sees
  request.wanted = [](std::string_view name, bool) { return name == "type"; };
  EXPECT_EQ(names_of(run.read(request).rows), "type");
}

// A rank alone that wants pieces: each particle and bond once.
TEST(DataParticles, Pieces)
{
  DataRun run(good_data("data_file/full.data"));
  const granular::Tables whole = run.read();
  for (const int pieces : { 2, 3, 7, 50 })
  {
    Ids ids;
    Numbers v;
    Ids bonds;
    for (int piece = 0; piece < pieces; ++piece)
    {
      granular::Request request;
      request.piece = piece;
      request.pieces = pieces;
      const granular::Tables part = run.read(request);
      const auto add = [](auto& all, const auto& some)
      { all.insert(all.end(), some.begin(), some.end()); };
      add(ids, array_of<std::int64_t>(part.rows, "id"));
      add(v, array_of(part.rows, "v"));
      add(bonds, array_of<std::int64_t>(part.bonds, "bond_id"));
      EXPECT_EQ(part.bonds.lines.count, part.bonds.rows);
      EXPECT_EQ(part.rows.header.rows, 40);
    }
    EXPECT_EQ(ids, array_of<std::int64_t>(whole.rows, "id")) << pieces;
    EXPECT_EQ(v, array_of(whole.rows, "v")) << pieces;
    EXPECT_EQ(bonds, (Ids{ 1, 2, 3 })) << pieces;
  }
}

TEST(DataParticles, Errors)
{
  const auto velocities = [](const std::string& text)
  { return data_error(three("atomic", rows, text)); };
  EXPECT_EQ(velocities("2 2 2 2\n4 3 3 3\n1 1 1 1\n"),
    ":15: expected a row of particle 3 in the section Velocities, got none");
  EXPECT_EQ(velocities("2 2 2 2\n3 3 3 3\n\n2 1 1 1\n"),
    ":20: column 'id': expected one row of each particle in the section Velocities, got another "
    "one of particle 2; the first is in line 17");
  EXPECT_EQ(velocities("2 2 2 2\n3 3 fast 3\n1 1 1 1\n"),
    ":18: column 'vy': expected a number, got 'fast'");
  EXPECT_EQ(velocities("2 2 2 2\n3 3 3\n1 1 1 1\n"), ":18: expected 4 words in a row, got 3");
  EXPECT_EQ(velocities("2 2 2 2\n3.5 3 3 3\n1 1 1 1\n"),
    ":18: column 'id': expected an integer, got '3.5'");
  EXPECT_EQ(data_error(data_text(2, "Atoms # atomic\n\n1 1 0 0 0\n2 1 0 0\n")),
    ":12: expected 5 words in a row, got 4");
  EXPECT_EQ(data_error(data_text(2, "Atoms # atomic\n\n1 1 0 0 0\n2 1 0 0 # 0\n")),
    ":12: expected 5 words in a row, got 4");
  EXPECT_EQ(data_error(data_text(2, "Atoms # atomic\n\n1 1 0 0 0\n2 C 0 0 0\n")),
    ":12: column 'type': expected a number, got 'C'");
  EXPECT_EQ(data_error(data_text(1, "Atoms # sphere\n\n1 1 0,3 1 0 0 0\n")),
    ":11: column 'diameter': expected a number, got '0,3'");
  EXPECT_NE(data_error(data_text(0, ""), { .boundary = "periodic" })
              .find("expected boundaries as in 'pp pp ff'"),
    std::string::npos);
}
