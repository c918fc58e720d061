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
#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"
#include "granular/dump/write/dump_writer.h"
#include "granular/packing/packing.h"

// ---- particles and bonds of data files -------------------------------------------------------------
#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"

// ---- contacts and bonds -------------------------------------------------------------------------
#include "granular/local/join.h"
#include "granular/local/local_file.h"
#include "granular/local/local_reader.h"
#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

// ---- cells and subdomains -----------------------------------------------------------------------
#include "granular/decomposition/count_particles.h"
#include "granular/decomposition/decomposition_file.h"
#include "granular/decomposition/decomposition_text.h"
#include "granular/euler/average.h"
#include "granular/euler/euler_file.h"
#include "granular/euler/euler_text.h"
#endif
