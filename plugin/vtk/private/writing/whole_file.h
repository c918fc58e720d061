// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularWholeFile_h
#define vtkGranularWholeFile_h

#include "private/writing/writer.h"

#include "granular/bytes/byte_sink.h"
#include "granular/frames/input_files.h"

#include <cstdint>
#include <map>
#include <string>

class vtkPointSet;

namespace vtkGranularPrivate
{
/**
 * The facts that a rank knows about a frame besides its cells.
 */
struct FrameFacts
{
  bool HasCells = false;
  bool HasTimestep = false;
  bool HasTime = false;
  vtkTypeInt64 Timestep = 0; ///< or the number of the frame
  double Time = 0;
  vtkMTimeType Changed = 0; ///< when the data were
};

/**
 * Returns the facts of an input with these points and field data.
 */
FrameFacts MakeFacts(
  vtkDataObject* input, vtkPointSet* points, bool hasCells, const FrameTime& time);

/**
 * Returns the facts that all ranks share: those of the first rank with cells, or of the first rank.
 */
struct SharedFacts : FrameFacts
{
  std::string Key; ///< tells frames apart: one of the same key is the same
};

/**
 * The files that a writer has written, with the frames in them. Only on the first rank.
 */
class WrittenFiles
{
public:
  /**
   * Writes a file, or leaves it if it exists and has the frames with these keys; a notice reports different contents.
   */
  void Write(const std::string& path, const std::string& text, const std::string& keys,
    const std::string& things, bool durable, granular::HeldFiles& held, granular::Notices& notices);

private:
  struct Entry
  {
    std::string Keys;
    std::uint64_t Hash = 0;
    bool Durable = false;
  };

  std::map<std::string, Entry> Files;
};

/**
 * The format of a WholeFile.
 */
struct WholeFileForm
{
  std::string Path;
  granular::Durability Durable;
  std::string Things;    ///< of which there are some in a file, for messages
  std::string Dialect;   ///< in which they are written, if it is not the usual one
  bool TakesAll = false; ///< several frames come one after the other if there is no '*' in the name
};

/**
 * A text file that the first rank writes for all ranks at once: one frame, or a file for each timestep. Each timestep
 * is written once.
 */
class WholeFile : public FrameWriter
{
public:
  WholeFile(WholeFileForm form, granular::Communicator& ranks, const granular::InputFiles& inputs,
    WrittenFiles& past, granular::Notices& ofFile);

  void Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
    granular::Progress& progress) final;
  void Finish() final;

protected:
  /**
   * Takes this rank's part of a frame. Not collective.
   */
  virtual FrameFacts Take(
    vtkDataObject* input, const FrameTime& time, granular::Notices& notices) = 0;

  /**
   * Gathers the parts of all ranks. Collective.
   */
  virtual void Gather(granular::Notices& notices, granular::Progress& progress) = 0;

  /**
   * Returns the text of the file, on the first rank.
   */
  virtual std::string Encode(
    const SharedFacts& facts, granular::Notices& notices, granular::Progress& progress) = 0;

  const WholeFileForm Form;
  granular::Communicator& Ranks;

private:
  void WriteFrame(
    const SharedFacts& facts, granular::Notices& notices, granular::Progress& progress);
  bool IsDurable() const;

  const granular::InputFiles& Inputs;
  granular::HeldFiles Held;
  WrittenFiles& Past;
  granular::Notices& OfFile;
  const bool OneFileAStep;
  std::string Text; ///< of the file of all frames, so far
  std::string Keys;
  std::string LastKey;
};
}

#endif
