// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularContactInput_h
#define vtkGranularContactInput_h

#include "private/local/local_rows.h"

#include "granular/contacts/contact_input.h"

#include <array>
#include <optional>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The contacts of two data objects, between particles and with walls, either of which may be null: lines, or rows of a table without
 * places.
 */
struct GivenContacts
{
  /**
   * Throws UnsupportedError for other data; reading their places does for other cells.
   */
  explicit GivenContacts(const std::array<vtkDataObject*, 2>& inputs);
  GivenContacts(const GivenContacts&) = delete;
  void operator=(const GivenContacts&) = delete;

  std::array<std::optional<LocalRows>, 2> Rows;
  granular::ContactSources Sources;
};
}

#endif
