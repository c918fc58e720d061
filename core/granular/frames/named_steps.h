// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_named_steps_h
#define granular_frames_named_steps_h

#include "granular/frames/file_index.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
/// A number in a name, without leading zeros, so that 007 equals 7.
struct NameNumber
{
  std::string text;

  bool operator==(const NameNumber&) const = default;
  bool operator<(const NameNumber& other) const
  {
    return std::pair(text.size(), text) < std::pair(other.text.size(), other.text);
  }
};

/// The name of a file without its numbers, and the numbers.
struct NumberedName
{
  std::string rest; ///< with folder, without what compression adds
  std::vector<NameNumber> numbers;
};

NumberedName split_name(std::string_view path);

/// Files whose names differ only in numbers: the numbers of each file, by its index in the list of files.
using Family = std::map<std::uint32_t, std::vector<NameNumber>>;

/// Returns all files, grouped by the common part of their names.
std::map<std::string, Family> families_of(const std::vector<FileIndex>& files);

/// The files of a family by the value of one number, for given values of the other numbers.
using Siblings = std::map<std::vector<NameNumber>, std::map<NameNumber, std::uint32_t>>;

Siblings group_by_others(const Family& family, std::size_t at);

/// Gives timesteps to the frames of files that do not contain them (see FileFormat). The timestep is the last number in
/// the name of the file that differs between files whose names differ only in numbers and that does not count pieces.
/// Frames of a file with several frames, or of a file without a number, are numbered from 0.
///
/// A number counts pieces if it runs from 0 without gaps, equally far for each value of the other numbers, and if there
/// are several such numbers, or the contents show that the files are pieces: frames with a shape other than
/// FrameEntry::whole, or no frame in any file but the first. A notice reports frames that are numbered in several
/// files.
void name_steps(std::vector<FileIndex>& files, Notices& notices);

/// Tells name_steps that files are pieces, also where all are of one timestep.
void mark_pieces(std::vector<FileIndex>& files);
}
#endif
