// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularWriter
 * @brief   Base class of writers: the file, the frames and the ranks.
 *
 * Write() writes what the input shows now, or with WriteTimeSteps all its timesteps, one after the other. A `*` in the name of the file
 * stands for the timestep and a `%` for the rank, one file each, as in the `dump` command. Two frames of one timestep are an error
 * of Write(); another Write() replaces the file.
 *
 * Files are written under a temporary name and renamed when complete. After an error the old file is untouched, Write() returns 0, and
 * GetErrorCode() is not vtkErrorCode::NoError. A killed program leaves the old file or the new one, and a hidden temporary file, which
 * the next Write() of the same file on the same machine removes.
 *
 * A file that a reader of this plugin upstream reads, under any name, is replaced after the last frame. Replacing a file with an
 * incomplete frame, which a simulation may be writing, or with pieces of frames is an error.
 */

#ifndef vtkGranularWriter_h
#define vtkGranularWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkWriter.h"

#include <initializer_list> // for SetChoice
#include <memory>           // for std::unique_ptr

class vtkMultiProcessController;

/**
 * Defines the function that sets a property to one of some choices, which are numbered from 0; another number is an error and changes
 * nothing.
 */
#define vtkGranularSetChoiceMacro(name, ...)                     \
  virtual void Set##name(int choice)                             \
  {                                                              \
    this->SetChoice(#name, this->name, choice, { __VA_ARGS__ }); \
  }

namespace vtkGranularPrivate
{
class FrameWriter;
}

class VTKGRANULAR_EXPORT vtkGranularWriter : public vtkWriter
{
public:
  vtkTypeMacro(vtkGranularWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ParallelModeType
  {
    GATHER = 0,
    MPI_IO = 1
  };

  enum DurableType
  {
    DURABLE_OFF = 0,
    DURABLE_ON = 1,
    DURABLE_AUTOMATIC = 2
  };

  ///@{
  /**
   * Sets the file to write. None by default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * On: all timesteps of the input are written. Off, the default: only the current one.
   */
  vtkSetMacro(WriteTimeSteps, bool);
  vtkGetMacro(WriteTimeSteps, bool);
  vtkBooleanMacro(WriteTimeSteps, bool);
  ///@}

  ///@{
  /**
   * Sets how the ranks write one file. GATHER, the default: the first rank writes; the others send it their rows, one rank
   * after the other and a few rows at a time. MPI_IO: each rank writes its own rows in place, on a file system that all
   * ranks share. The bytes are the same.
   */
  vtkGranularSetChoiceMacro(ParallelMode, "Gather", "MPI-IO");
  vtkGetMacro(ParallelMode, int);
  ///@}

  ///@{
  /**
   * Sets whether a new file survives a crash of the whole system, such as a loss of power. DURABLE_ON: its bytes are on the
   * disk before it gets its name, and the name before Write() returns. DURABLE_OFF: the system writes it when it likes; a crash
   * of the system soon afterwards may leave an empty or incomplete file, a crash of the program may not. DURABLE_AUTOMATIC,
   * the default: on, but off if `*` in the name gives each timestep its file.
   */
  vtkGranularSetChoiceMacro(Durable, "Off", "On", "Automatic");
  vtkGetMacro(Durable, int);
  ///@}

  ///@{
  /**
   * Sets the number of threads. 0, the default: the cores of the machine, divided by the ranks of the Controller on it.
   * The number changes no result. Numbers below 0 are an error and change nothing.
   */
  void SetThreads(int threads);
  vtkGetMacro(Threads, int);
  ///@}

  ///@{
  /**
   * Sets the ranks that write together. All of them must set the controller and the same properties, and call Write()
   * together. An error on one rank is an error on all. Default: the global controller; null: this rank works alone.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * Sets the number of ghost layers that the input is asked for, as in ParaView's writers. 0 by default. It does not
   * change the file: ghost duplicates are left out.
   */
  vtkSetClampMacro(GhostLevel, int, 0, VTK_INT_MAX);
  vtkGetMacro(GhostLevel, int);
  ///@}

  /**
   * Writes the file or files. Returns 1, or 0 after an error or an abort.
   */
  int Write() override;

  /**
   * Returns whether the last Write() was complete.
   */
  vtkGetMacro(Written, bool);

  /**
   * Returns the error of the last Write(), or an empty text if there was none.
   */
  const char* GetErrorMessage();

protected:
  vtkGranularWriter();
  ~vtkGranularWriter() override;

  // Update() writes, too
#ifdef VTK_DEPRECATED_IN_9_7_0
  bool WriteDataAndReturn() override
  {
    return this->Write() != 0;
  }
#else
  void WriteData() override
  {
    this->Write();
  }
#endif

  struct Internals;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  /**
   * Sets a property that is one of some choices, numbered from 0; another number is an error and changes nothing.
   */
  void SetChoice(
    const char* name, int& property, int choice, std::initializer_list<const char*> choices);

  /**
   * Opens the file. Collective; may throw the core's errors.
   */
  virtual std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) = 0;

  char* FileName = nullptr;
  bool WriteTimeSteps = false;
  int ParallelMode = GATHER;
  int Durable = DURABLE_AUTOMATIC;
  int Threads = 0;
  int GhostLevel = 0;
  bool Written = false;

private:
  vtkGranularWriter(const vtkGranularWriter&) = delete;
  void operator=(const vtkGranularWriter&) = delete;

  void WriteFrames();

  std::unique_ptr<Internals> Shared;
};

#endif
