// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularErrors_h
#define vtkGranularErrors_h

#include "granular/common/error.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"

#include <string>

namespace vtkGranularPrivate
{
/**
 * Returns the input as a data set of a type. Throws UnsupportedError if it has another type, with the expected one ("a
 * vtkPointSet to write") and the actual one.
 */
template <typename Type>
Type* ExpectData(vtkDataObject* input, const char* expected, const granular::Where& where = {})
{
  Type* const data = Type::SafeDownCast(input);
  if (!data)
  {
    const bool composite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
    throw granular::UnsupportedError("expected " + std::string(expected) + ", got " +
        (input ? std::string("a ") + input->GetClassName() : "nothing") +
        (composite ? ": the filter MergeBlocks makes one of it" : ""),
      where);
  }
  return data;
}

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
