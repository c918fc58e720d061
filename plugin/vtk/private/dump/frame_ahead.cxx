// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/frame_ahead.h"

#include <chrono>
#include <thread>
#include <utility>

namespace vtkGranularPrivate
{
/**
 * A frame that is being decoded. It tells how far it is, and is told to stop.
 */
struct FrameAhead::Work : granular::Progress
{
  FrameAhead::Key Key;
  std::vector<granular::FramePiece> Pieces;
  granular::DumpRequest Request;
  std::atomic<double> Fraction = 0;
  std::atomic<bool> Stop = false;
  std::promise<granular::DumpPart> Promise;
  std::future<granular::DumpPart> Part;
  std::thread Thread;

  bool report(double fraction) override
  {
    this->Fraction = fraction;
    return !this->Stop;
  }

  void Run()
  {
    try
    {
      this->Promise.set_value(
        granular::decode_dump(this->Pieces, this->Request, this->Key.Together, *this));
    }
    catch (...)
    {
      this->Promise.set_exception(std::current_exception());
    }
  }

  /**
   * Throws IoError where reading the files now would: a file may have grown, and on another machine it is
   * another inode.
   */
  void CheckFiles() const
  {
    for (const granular::FramePiece& piece : this->Pieces)
    {
      granular::open_indexed(piece.file);
    }
  }
};

FrameAhead::FrameAhead() = default;

FrameAhead::~FrameAhead()
{
  this->Drop();
}

void FrameAhead::Start(
  const Key& key, std::vector<granular::FramePiece> pieces, const granular::DumpRequest& request)
{
  this->Drop();
  auto work = std::make_unique<Work>();
  work->Key = key;
  work->Pieces = std::move(pieces);
  work->Request = request;
  work->Part = work->Promise.get_future();
  work->Thread = std::thread(&Work::Run, work.get());
  this->Running = std::move(work);
}

std::optional<granular::DumpPart> FrameAhead::Take(const Key& key, granular::Progress& progress)
{
  if (!this->Running || !(this->Running->Key == key))
  {
    this->Drop();
    return std::nullopt;
  }
  try
  {
    while (this->Running->Part.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready)
    {
      progress.step(this->Running->Fraction);
    }
    granular::DumpPart part = this->Running->Part.get();
    this->Running->CheckFiles();
    this->Drop();
    return part;
  }
  catch (const granular::Cancelled&)
  {
    this->Drop();
    throw;
  }
  catch (const std::exception&)
  {
    this->Drop();
    return std::nullopt;
  }
}

void FrameAhead::Drop()
{
  if (this->Running)
  {
    this->Running->Stop = true;
    this->Running->Thread.join();
    this->Running.reset();
  }
}
}
