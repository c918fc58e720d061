// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularTextOf_h
#define vtkGranularTextOf_h

namespace vtkGranularPrivate
{
/**
 * Returns the text of a string property; VTK stores null for an empty one.
 */
inline const char* TextOf(const char* text)
{
  return text ? text : "";
}
}

#endif
