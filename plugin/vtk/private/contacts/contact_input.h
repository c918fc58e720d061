// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularContactInput_h
#define vtkGranularContactInput_h

#include "private/local/local_rows.h"

#include "granular/common/progress.h"
#include "granular/contacts/contact_rows.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * Arrays that are read of contacts, besides ids and places.
 */
struct ContactArrays
{
  bool Force = true;
  bool Tangential = false;
  bool Torque = false;
  bool Point = false;
  bool Overlap = false;
};

/**
 * The contacts of a data object: lines, or rows of a table without places. Nothing is copied that lies in memory as the
 * core wants it.
 */
class ContactInput
{
public:
  /**
   * walls: rows name one particle, id2, which touches a wall, whose place is read in any case; otherwise two, id1 and id2.
   * Arrays are read if they are there: `force`, or else the sum of `force_normal` and `force_tangential`; `torque`,
   * `contact_point`, `delta`. Throws Error if ids are missing or arrays have other numbers; UnsupportedError for other
   * data or cells; granular::Cancelled.
   */
  ContactInput(
    vtkDataObject* input, bool walls, const ContactArrays& wanted, granular::Progress& progress);
  ContactInput(const ContactInput&) = delete;
  void operator=(const ContactInput&) = delete;

  const granular::ContactRows& GetRows() const { return this->View; }
  const LocalRows& GetLines() const { return this->Rows; }

private:
  void ReadEnds(vtkDataObject* input);
  void ReadForces(const ContactArrays& wanted);

  LocalRows Rows;
  std::array<std::vector<std::int64_t>, 2> Ids;
  std::vector<double> Ends;
  std::vector<double> Force;
  std::vector<double> Tangential;
  std::vector<double> Torque;
  std::vector<double> Point;
  std::vector<double> Overlap;
  granular::ContactRows View;
};

/**
 * The contacts of two inputs, between particles and with walls, either of which may be null.
 */
struct ContactInputs
{
  /**
   * Throws what ContactInput throws.
   */
  ContactInputs(const std::array<vtkDataObject*, 2>& inputs, const ContactArrays& wanted,
    granular::Progress& progress);

  std::array<std::optional<ContactInput>, 2> Each;
  std::vector<granular::ContactRows> Rows; ///< of those that are there
};
}

#endif
