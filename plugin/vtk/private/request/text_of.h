// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularTextOf_h
#define vtkGranularTextOf_h

namespace vtkGranularPrivate
{
/**
 * The text of a string property, which is null where it is empty.
 */
inline const char* TextOf(const char* text)
{
  return text ? text : "";
}
}

#endif
