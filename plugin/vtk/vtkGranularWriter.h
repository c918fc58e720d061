// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularWriter
 * @brief   Base class of writers: the file, the frames and the ranks.
 *
 * Write() writes what the input shows now, or with WriteTimeSteps all its timesteps, one after the other. A `*` in the name of the file
 * stands for the timestep and a `%` for the rank, one file each, as in the `dump` command.
 *
 * Files are written under a temporary name and renamed when complete. After an error the old file is untouched, Write() returns 0, and
 * GetErrorCode() is not vtkErrorCode::NoError.
 */

#ifndef vtkGranularWriter_h
#define vtkGranularWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkWriter.h"

#include <initializer_list> // for SetChoice
#include <memory>           // for std::unique_ptr

class vtkMultiProcessController;

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

  ///@{
  /**
   * The file to write. None by default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * On: all time steps of the input are written. Off, the default: the one that it shows.
   */
  vtkSetMacro(WriteTimeSteps, bool);
  vtkGetMacro(WriteTimeSteps, bool);
  vtkBooleanMacro(WriteTimeSteps, bool);
  ///@}

  ///@{
  /**
   * How the processes write one file. GATHER, the default: the first one writes, and the others send it
   * their rows, one after the other and a few at a time. MPI_IO: each writes its own where they belong;
   * needs a file system that all of them see. The bytes are the same.
   */
  void SetParallelMode(int mode);
  vtkGetMacro(ParallelMode, int);
  ///@}

  ///@{
  /**
   * How many threads make the bytes. 0, the default: the cores of the machine, divided by the processes of
   * the Controller that run on it. Changes how fast it goes and nothing else. Below 0 is an error and
   * changes nothing.
   */
  void SetThreads(int threads);
  vtkGetMacro(Threads, int);
  ///@}

  ///@{
  /**
   * The processes that write together: all of them must set it, set the same properties, and call Write().
   * What goes wrong on one of them is an error of all. The global controller by default; null: this process is
   * alone, whatever others do.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /**
   * How many layers of other processes' cells to ask the input for, as ParaView's writers may. 0 by default. It
   * changes nothing in the file: points that are duplicates are left out.
   */
  vtkSetClampMacro(GhostLevel, int, 0, VTK_INT_MAX);
  vtkGetMacro(GhostLevel, int);
  ///@}

  /**
   * Writes. Returns 1, or 0 after an error, or if it was aborted.
   */
  int Write() override;

  /**
   * Whether the last Write() wrote all that it should.
   */
  vtkGetMacro(Written, bool);

  /**
   * Returns the error of the last Write(), as it was told, or an empty text if there was none.
   */
  const char* GetErrorMessage();

protected:
  vtkGranularWriter();
  ~vtkGranularWriter() override;

  void WriteData() override { this->Write(); } ///< Update() writes, too

  struct Internals;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  /**
   * Sets a property that is one of some choices, numbered from 0; another number is an error and changes nothing.
   */
  void SetChoice(
    const char* name, int& property, int choice, std::initializer_list<const char*> choices);

  /**
   * Opens the file. Called by all processes together; may throw what the core does.
   */
  virtual std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) = 0;

  char* FileName = nullptr;
  bool WriteTimeSteps = false;
  int ParallelMode = GATHER;
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
