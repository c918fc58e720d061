// SPDX-License-Identifier: BSD-3-Clause
// Frames of text dumps, read by plain code.
#ifndef granular_tests_local_text_frames_h
#define granular_tests_local_text_frames_h

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

struct TextFrame
{
  long timestep = 0;
  std::string label;    ///< of the rows, as in ITEM: NUMBER OF ...
  std::string boundary; ///< and the bounds of the box
  double lo[3] = {};
  double hi[3] = {};
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::string bytes; ///< of the whole frame
};

/// All frames of a file with boxes that are not tilted.
inline std::vector<TextFrame> read_text_frames(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error("no file " + path);
  }
  std::vector<TextFrame> frames;
  std::string line;
  const auto next = [&]
  {
    std::getline(file, line);
    frames.back().bytes += line + "\n";
    return std::istringstream(line);
  };
  while (std::getline(file, line))
  {
    TextFrame& frame = frames.emplace_back();
    frame.bytes = line + "\n"; // ITEM: TIMESTEP
    next() >> frame.timestep;
    next();
    frame.label = line.substr(std::string("ITEM: NUMBER OF ").size());
    std::size_t count = 0;
    next() >> count;
    next();
    frame.boundary = line.substr(std::string("ITEM: BOX BOUNDS ").size());
    for (int axis = 0; axis < 3; ++axis)
    {
      next() >> frame.lo[axis] >> frame.hi[axis];
    }
    std::istringstream columns = next();
    std::string word;
    for (int i = 0; columns >> word; ++i)
    {
      if (i > 1) // ITEM: and the label
      {
        frame.columns.push_back(word);
      }
    }
    for (std::size_t row = 0; row < count; ++row)
    {
      std::istringstream words = next();
      std::vector<double>& values = frame.rows.emplace_back();
      for (double value = 0; words >> value;)
      {
        values.push_back(value);
      }
    }
  }
  return frames;
}
#endif
