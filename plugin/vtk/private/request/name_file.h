// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularNameFile_h
#define vtkGranularNameFile_h

#include "granular/common/error.h"

namespace vtkGranularPrivate
{
/**
 * Does work on what is read from, or to be written to, a file, and says in errors which it is.
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
