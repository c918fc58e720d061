// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/guard.h"

#include "granular/common/error.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <new>
#include <system_error>

namespace vtkGranularPrivate
{
namespace
{
/**
 * A way to a protected method, through a pointer to member taken where it may be named.
 */
struct ErrorCodeAccess : vtkAlgorithm
{
  static void Set(vtkAlgorithm* self, unsigned long code)
  {
    (self->*&ErrorCodeAccess::SetErrorCode)(code);
  }
};

/**
 * Which of VTK's codes says best why a file could not be read or written.
 */
unsigned long FileErrorCode(const granular::IoError& error)
{
  if (error.where().path.empty())
  {
    return vtkErrorCode::NoFileNameError;
  }
  if (error.code() == std::errc{})
  {
    return vtkErrorCode::PrematureEndOfFileError; // it is there, but not what it had been
  }
  return error.code() == std::errc::no_such_file_or_directory ? vtkErrorCode::FileNotFoundError
    : error.code() == std::errc::no_space_on_device           ? vtkErrorCode::OutOfDiskSpaceError
                                                              : vtkErrorCode::CannotOpenFileError;
}
}

void EmptyOutputs(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* output = vtkDataObject::GetData(outputs, port))
    {
      output->Initialize();
    }
  }
}

void SetErrorCode(vtkAlgorithm* self, unsigned long code)
{
  ErrorCodeAccess::Set(self, code);
}

Failure DescribeException(const std::exception_ptr& exception)
{
  try
  {
    std::rethrow_exception(exception);
  }
  catch (const granular::Cancelled&)
  {
    return { Outcome::Cancelled, vtkErrorCode::NoError, {} };
  }
  catch (const granular::IoError& error)
  {
    const bool refused = !error.where().path.empty();
    return { refused ? Outcome::Refused : Outcome::Failed, FileErrorCode(error), error.what() };
  }
  catch (const granular::MemoryError& error)
  {
    return { Outcome::Refused, vtkErrorCode::UnknownError, error.what() };
  }
  catch (const granular::Error& error)
  {
    // without a file it is a property: no fault of a format
    const bool of_file = !error.where().path.empty();
    return { Outcome::Failed, of_file ? vtkErrorCode::FileFormatError : vtkErrorCode::UnknownError,
      error.what() };
  }
  catch (const std::bad_alloc&)
  {
    return { Outcome::Refused, vtkErrorCode::UnknownError,
      "not enough memory: switch arrays off, or use Stride, RegionOfInterest or single-precision "
      "points" };
  }
  catch (const std::exception& error)
  {
    return { Outcome::Failed, vtkErrorCode::UnknownError, error.what() };
  }
}

bool AlgorithmProgress::report(double fraction)
{
  this->Self->UpdateProgress(fraction);
  return !AskedToStop(this->Self);
}
}
