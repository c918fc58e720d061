// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/vtk_series.h"

#include "../support/error_of.h"
#include "../support/own_folder.h"

#include "granular/frames/run_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

using namespace granular;

namespace
{
const std::string hopper = std::string(GRANULAR_DATA) + "/good/hopper/";

using VtkSeries = OwnFolder;

struct Found
{
  std::vector<std::int64_t> steps;
  std::vector<std::size_t> pieces;
  Notices notices;
};

Found find(const std::vector<std::string>& files, RepeatedSteps repeated = RepeatedSteps::Auto)
{
  Found found;
  RunIndex index;
  Progress progress;
  IndexOptions options;
  options.format = &vtk_format();
  options.repeated_steps = repeated;
  index.update(files, options, found.notices, progress);
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    found.steps.push_back(index.first_piece(frame).entry.timestep);
    found.pieces.push_back(index.pieces(frame).size());
  }
  return found;
}
}

TEST_F(VtkSeries, WhoseFilesAre)
{
  const struct
  {
    const char* name;
    bool particles;
    bool mesh;
  } cases[] = {
    { "particles_0.vtk", true, false }, // no points: the box is beside it
    { "particles_4000.vtk", true, false },
    { "particles_boundingBox_4000.vtk", false, false },
    { "packed_2000.vtp", true, false },
    { "ranks_4000.pvtp", true, false },
    { "ranks_4000_1.vtp", true, false },
    { "blocks_0.vtm", true, false },
    { "blocks_4000.vtm", true, false },
    { "blocks_4000/blocks_4000_0.vtp", false, false }, // a mesh, but nothing says whose
    { "blocks_4000/blocks_4000_2.vtu", true, false },
    { "contacts_0.vtk", false, true }, // no points, either
    { "contacts_2000.vtk", false, true },
    { "walls_1500.vtk", false, true },
    { "plate_500.stl", false, true },
    { "funnel.stl", false, false }, // not of a run
    { "dump_2000.liggghts", false, false },
    { "../euler_1000.vtk", false, true }, // the reader of cells is asked before
    { "../decomposition_1000.vtk", false, false },
    { "none_1.vtk", false, false },
  };
  for (const auto& [name, particles, mesh] : cases)
  {
    EXPECT_EQ(is_vtk_particles(hopper + name), particles) << name;
    EXPECT_EQ(is_vtk_mesh(hopper + name), mesh) << name;
  }
}

TEST_F(VtkSeries, Boxes)
{
  const auto box_of = [](const char* name)
  {
    const std::string path = find_box_file(hopper + name);
    return path.substr(std::min(path.size(), hopper.size()));
  };
  EXPECT_EQ(box_of("particles_2000.vtk"), "particles_boundingBox_2000.vtk");
  EXPECT_EQ(box_of("packed_2000.vtp"), "packed_boundingBox_2000.vtr");
  EXPECT_EQ(box_of("ranks_4000.pvtp"), "ranks_boundingBox_4000.pvtr");
  EXPECT_EQ(box_of("walls_1500.vtk"), "");
  std::filesystem::create_directory(this->path("a.1"));
  this->write("a.1/run2_100.x_boundingBox.vtr", "x"); // LAMMPS
  EXPECT_EQ(
    find_box_file(this->path("a.1/run2_100.x.vtu")), this->path("a.1/run2_100.x_boundingBox.vtr"));
}

TEST_F(VtkSeries, StepsAndPieces)
{
  const auto all = [](
                     const std::string& name, const std::vector<int>& steps, const std::string& end)
  {
    std::vector<std::string> files;
    for (const int step : steps)
    {
      files.push_back(hopper + name + std::to_string(step) + end);
    }
    return files;
  };
  EXPECT_EQ(find(all("plate_", { 4000, 500, 0 }, ".stl")).steps,
    (std::vector<std::int64_t>{ 0, 500, 4000 }));
  EXPECT_EQ(
    find(all("particles_", { 0, 2000 }, ".vtk")).steps, (std::vector<std::int64_t>{ 0, 2000 }));
  EXPECT_EQ(find({ hopper + "funnel.stl" }).steps, std::vector<std::int64_t>{ 0 });

  // `%`: two ranks, and a series whose steps count from 0
  std::vector<std::string> ranks;
  std::vector<std::string> counted;
  for (const char* const name : { "r_100_0.vtp", "r_100_1.vtp", "r_200_0.vtp", "r_200_1.vtp" })
  {
    ranks.push_back(this->write(name, "<VTKFile>\n</VTKFile>\n"));
  }
  for (const char* const name : { "run7_0.vtp", "run7_1.vtp", "run7_2.vtp" })
  {
    counted.push_back(this->write(name, "<VTKFile>\n</VTKFile>\n"));
  }
  const Found pieces = find(ranks);
  EXPECT_EQ(pieces.steps, (std::vector<std::int64_t>{ 100, 200 }));
  EXPECT_EQ(pieces.pieces, (std::vector<std::size_t>{ 2, 2 }));
  EXPECT_EQ(find(counted).steps, (std::vector<std::int64_t>{ 0, 1, 2 }));
  const Found merged = find(counted, RepeatedSteps::Merge); // of one timestep
  EXPECT_EQ(merged.steps, (std::vector<std::int64_t>{ 7 }));
  EXPECT_EQ(merged.pieces, (std::vector<std::size_t>{ 3 }));
  EXPECT_EQ(find(ranks, RepeatedSteps::Merge).steps, pieces.steps);
}

// A file that a simulation is still writing is left out, if its end can tell.
TEST_F(VtkSeries, UnfinishedFiles)
{
  const struct
  {
    const char* name;
    std::string content;
    bool whole;
  } cases[] = {
    { "a_2.vtp", "<VTKFile>\n</VTK", false },
    { "a_2.stl", "solid x\n facet normal 0 0 1\n", false },
    { "a_2.stl", "solid x\nendsolid x\n", true },
    { "a_2.vtk", "", false },
    { "a_2.ply", "ply\n", true },
  };
  const std::string first = this->write("a_1.ply", "ply\n");
  for (const auto& [name, content, whole] : cases)
  {
    const std::string path = this->write(name, content);
    EXPECT_EQ(find({ first, path }).steps.size(), whole ? 2U : 1U) << content;
    const std::string error = error_of([&] { find({ path }); });
    EXPECT_EQ(error.empty(), whole) << error;
  }
}
