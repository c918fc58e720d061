// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/guard.h"

#include "private/request/abort.h"

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

void ReportError(vtkAlgorithm* self, unsigned long code, const std::string& text)
{
  vtkErrorWithObjectMacro(self, << text);
  SetErrorCode(self, code);
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

Outcome ReportException(
  vtkAlgorithm* self, vtkInformationVector* outputs, const std::exception_ptr& exception)
{
  EmptyOutputs(outputs);
  try
  {
    std::rethrow_exception(exception);
  }
  catch (const granular::Cancelled&)
  {
    MarkStopped(self, true);
    return Outcome::Cancelled;
  }
  catch (const granular::IoError& error)
  {
    ReportError(self, FileErrorCode(error), error.what());
    return error.where().path.empty() ? Outcome::Failed : Outcome::Refused;
  }
  catch (const granular::Error& error)
  {
    // without a file it is memory that ran out on some rank, or a property: no fault of a format
    ReportError(self,
      error.where().path.empty() ? vtkErrorCode::UnknownError : vtkErrorCode::FileFormatError,
      error.what());
  }
  catch (const std::bad_alloc&)
  {
    ReportError(self, vtkErrorCode::UnknownError,
      "not enough memory: switch arrays off, or use Stride, RegionOfInterest or single-precision "
      "points");
  }
  catch (const std::exception& error)
  {
    ReportError(self, vtkErrorCode::UnknownError, error.what());
  }
  return Outcome::Failed;
}

bool AlgorithmProgress::report(double fraction)
{
  this->Self->UpdateProgress(fraction);
  return !AskedToStop(this->Self);
}
}
