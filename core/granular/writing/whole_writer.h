// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_writing_whole_writer_h
#define granular_writing_whole_writer_h

#include "granular/common/error.h"
#include "granular/frames/input_files.h"
#include "granular/parallel/communicator.h"
#include "granular/writing/file_names.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>

namespace granular
{
/// Writes frames whose text the first rank has as a whole, such as cells and subdomains: one frame to a file, or several one
/// behind the other. A name with '*' gives each frame a file with its timestep for the '*'. Text is compressed if the name ends
/// in .gz or .zst. A file appears when finish() is done, or with '*' when write() is done, but one that is read with finish();
/// until then the old file is untouched. Of the options mode and threads are not used.
///
/// All functions are collective. An error on one rank is thrown on all.
class WholeWriter
{
public:
  /// Returns the text of a frame. Called on the first rank only.
  using Encode = std::function<std::string(Notices& notices)>;

  /// holds_many: the format has room for several frames in a file.
  WholeWriter(std::string path, bool holds_many, const WriteOptions& options, Communicator& ranks);

  /// Adds a frame. Throws Error for a timestep that is written already, UnsupportedError for a second frame of a file that
  /// holds one, IoError, and what encode and InputFiles::has throw. Notices of encode get the name of the file.
  void write(std::int64_t timestep, const Encode& encode, Notices& notices);

  /// Gives the file its name. No frame can be added afterwards.
  void finish();

private:
  std::string encode_frame(const Encode& encode, Notices& notices) const;
  void save(const std::string& path, const std::string& text);

  std::string path_;
  bool holds_many_;
  bool durable_;
  const InputFiles* inputs_;
  Communicator& ranks_;
  HeldFiles held_;
  std::set<std::int64_t> steps_; ///< that were written
  std::string text_;             ///< of a file of all frames, so far
};
}
#endif
