// SPDX-License-Identifier: BSD-3-Clause
// Includes the public headers of the core. Only these, and the headers that they include, are installed.
#ifndef granular_granular_h
#define granular_granular_h

// ---- files and ranks ----------------------------------------------------------------------------
#include "granular/bytes/byte_sink.h"
#include "granular/bytes/byte_source.h"
#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"

// ---- particles ----------------------------------------------------------------------------------
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/formats/dump/read/dump_reader.h"
#include "granular/formats/dump/write/dump_writer.h"
#include "granular/packing/packing.h"

// ---- particles and bonds of data files -------------------------------------------------------------
#include "granular/formats/data_file/data_file.h"
#include "granular/formats/data_file/read_data.h"

// ---- contacts and bonds -------------------------------------------------------------------------
#include "granular/formats/local/local_file.h"
#include "granular/formats/local/local_reader.h"
#include "granular/formats/restart/restart_file.h"
#include "granular/formats/restart/restart_reader.h"
#include "granular/lines/join.h"

// ---- cells and subdomains -----------------------------------------------------------------------
#include "granular/averages/average.h"
#include "granular/formats/decomposition/decomposition_file.h"
#include "granular/formats/decomposition/decomposition_text.h"
#include "granular/formats/euler/euler_file.h"
#include "granular/formats/euler/euler_text.h"
#include "granular/formats/grid_dump/grid_dump.h"
#include "granular/subdomains/count_particles.h"
#endif
