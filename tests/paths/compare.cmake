# SPDX-License-Identifier: BSD-3-Clause
# Two frames compared: lines, fragments, particles, the class.

granular_add_gtest(paths_compare_lines SOURCES compare_lines.cpp LABEL core)
granular_add_gtest(paths_fragments SOURCES fragments.cpp LABEL core)
granular_add_gtest(paths_compare_particles SOURCES compare_particles.cpp LABEL core)
granular_add_gtest(paths_compare_core_ranks SOURCES compare_core_ranks.cpp LABEL core RANKS 1 2 3)
granular_add_gtest(paths_compare_filter SOURCES compare.cxx LABEL vtk)
granular_add_pv_test(paths_compare SCRIPT compare.py
  EXPECT "12 particles moved more than a quarter of a period.*as they say")
foreach(ranks IN ITEMS 1 2 3)
  granular_add_pv_test(paths_compare_${ranks} SCRIPT compare_ranks.py RANKS ${ranks}
    EXPECT "expected each id once.*got id 7 in rows.*all there")
endforeach()
granular_add_pv_test(paths_compare_sym SCRIPT compare_ranks.py RANKS 2 SYM
  EXPECT "expected each id once.*got id 7 in rows.*all there")
