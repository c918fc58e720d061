// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: the bits of one rank, also where messages are cut.
#include "granular/mpi/mpi_communicator.h"

#include "plain_sums.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace
{
/// Compares the sums of the particles of this rank.
void check_scenes(granular::Communicator& ranks)
{
  for (const bool ends : { true, false })
  {
    made::SceneForm form;
    form.known = { ends, true, true, ends, !ends, true };
    form.far_ids = ends;
    form.ghosts = true;
    form.missing = true;
    const made::Scene scene = make_scene(form, ends ? 31 : 32);
    const made::Found expected = sum_all(scene);
    for (const made::Place& place :
      { made::Place(made::anywhere), made::Place(made::on_last), made::Place(made::in_turn) })
    {
      made::Found found = empty_for(scene);
      sum_part(scene, made::everything(), place, made::anywhere, ranks, found, nullptr);
      std::vector<made::Sums> own;
      std::vector<made::Sums> wanted;
      for (std::size_t i = 0; i < scene.grains.size(); ++i)
      {
        if (place(i, ranks.size()) == ranks.rank())
        {
          own.push_back(found.grains[i]);
          wanted.push_back(expected.grains[i]);
        }
      }
      EXPECT_EQ(count_different(own, wanted), 0);
      EXPECT_EQ(found.counts, expected.counts);
    }
  }
}
}

TEST(ContactRanks, AnyPlaces)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  check_scenes(ranks);
}

TEST(ContactRanks, SmallMessages)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD, 1001);
  check_scenes(ranks);
}
