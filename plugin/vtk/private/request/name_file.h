// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularNameFile_h
#define vtkGranularNameFile_h

#include "granular/common/error.h"

namespace vtkGranularPrivate
{
/**
 * Runs a function on a file, and names the file in errors.
 */
template <typename Work>
void NameFile(granular::Where where, const Work& work)
{
  try
  {
    work();
  }
  catch (const granular::UnsupportedError& error)
  {
    where.column = error.where().column;
    throw granular::UnsupportedError(error.text(), where);
  }
  catch (const granular::FormatError& error)
  {
    where.column = error.where().column;
    throw granular::FormatError(error.text(), where);
  }
}
}

#endif
