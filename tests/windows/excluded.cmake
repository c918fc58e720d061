# SPDX-License-Identifier: BSD-3-Clause
# Tests of the core that Windows does without, each with the reason.

# faults: calls of libc are taken away, and processes killed; consumer: installs for Linux; fuzz, common: their programs compare compilers
# and instruction sets, and compile the core again; docs: Python, which is not there for Windows.
set(granular_posix_folders faults/CMakeLists.txt consumer/CMakeLists.txt fuzz/CMakeLists.txt common/CMakeLists.txt docs/CMakeLists.txt)

set(granular_posix_tests
  byte_sink locked_file # fork, owners, permissions, limits of a process: tests/windows/files.cpp has what Windows has of that
  growing_run index_threads # fork; files that a process may open
  large_file binary_large # files with holes
  c_misuse) # a thread that ends by pthread_exit

string(JOIN ":" granular_posix_cases
  OpenFile.RefusesWhatIsNoFile CInterface.AFileOfWhichTheSystemDoesNotTellIsAnError # std::filesystem makes no links here
  OpenFile.RefusesAPipeWithoutWaiting # a pipe with a name
  OpenFile.NoPermission CWriting.FilesThatAProgramWritesItself # permissions by bits
  OpenFile.AReplacedFileHasAnotherStamp # std::filesystem does not replace an open file
  Communicator.one_process_opens_a_file Communicator.threads_open_a_file # below a file: Windows says that there is no such folder
  RunIndex.AFileThatDidNotChangeIsNotRead # std::filesystem sets times to the second
  EncodeEuler.bytes_of_printf NumberCells.as_printf NumberCells.whole_numbers_have_all_digits # printf of MinGW prints no sign of NaN
  PrintShortest.ReadsBackAndIsNeverLonger # strtod of MinGW reads 3.839223843572815e-239 as the next number
  ParseDouble.TrapLocaleWithADecimalComma # localedef
  WriteRanks.names # folders with * in their names
  WriteMemory.beside_the_rows) # the most memory that the process had
