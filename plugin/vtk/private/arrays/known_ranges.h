// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularKnownRanges_h
#define vtkGranularKnownRanges_h

#include "granular/memory/value_range.h"

#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkVersion.h"

#include <algorithm>
#include <cmath>

namespace vtkGranularPrivate
{
/**
 * An interface for setting the ranges of an array.
 */
class RangeHolder
{
public:
  virtual ~RangeHolder() = default;

  virtual void SetKnown(const granular::ValueRange& range) = 0;
};

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
/**
 * A VTK array that answers with the ranges that were set, for all tuples, until Modified() or a change of the number of
 * values. VTK also keeps ranges in information keys, but vtkPoints and, from VTK 9.3 on, vtkFieldData call these
 * methods directly. It has the class name of its superclass, and NewInstance() makes an array of that class: copies
 * have no ranges set.
 */
template <typename Array>
class KnownRanges
  : public Array
  , public RangeHolder
{
public:
  static KnownRanges* New() { VTK_STANDARD_NEW_BODY(KnownRanges); }

  void SetKnown(const granular::ValueRange& range) override
  {
    this->Range = range;
    this->Time = this->GetMTime();
    this->Values = this->GetNumberOfValues();
  }

  bool ComputeScalarRange(double* ranges) override
  {
    return this->GiveComponents(ranges, nullptr) || this->Array::ComputeScalarRange(ranges);
  }
  bool ComputeScalarRange(
    double* ranges, const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return this->GiveComponents(ranges, ghosts) ||
      this->Array::ComputeScalarRange(ranges, ghosts, ghostsToSkip);
  }
  bool ComputeFiniteScalarRange(double* ranges) override
  {
    return this->GiveComponents(ranges, nullptr) || this->Array::ComputeFiniteScalarRange(ranges);
  }
  bool ComputeFiniteScalarRange(
    double* ranges, const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return this->GiveComponents(ranges, ghosts) ||
      this->Array::ComputeFiniteScalarRange(ranges, ghosts, ghostsToSkip);
  }
  bool ComputeVectorRange(double range[2]) override
  {
    return this->GiveLength(range, nullptr) || this->Array::ComputeVectorRange(range);
  }
  bool ComputeVectorRange(
    double range[2], const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return this->GiveLength(range, ghosts) ||
      this->Array::ComputeVectorRange(range, ghosts, ghostsToSkip);
  }
  bool ComputeFiniteVectorRange(double range[2]) override
  {
    return this->GiveLength(range, nullptr) || this->Array::ComputeFiniteVectorRange(range);
  }
  bool ComputeFiniteVectorRange(
    double range[2], const unsigned char* ghosts, unsigned char ghostsToSkip) override
  {
    return this->GiveLength(range, ghosts) ||
      this->Array::ComputeFiniteVectorRange(range, ghosts, ghostsToSkip);
  }

protected:
  KnownRanges() = default;
  ~KnownRanges() override = default;

private:
  KnownRanges(const KnownRanges&) = delete;
  void operator=(const KnownRanges&) = delete;

  bool Knows(const unsigned char* ghosts)
  {
    return !ghosts && this->Range.known() && this->GetMTime() == this->Time &&
      this->GetNumberOfValues() == this->Values &&
      this->Range.components().size() == static_cast<std::size_t>(this->GetNumberOfComponents());
  }

  bool GiveComponents(double* ranges, const unsigned char* ghosts)
  {
    if (!this->Knows(ghosts))
    {
      return false;
    }
    for (const granular::ValueRange::Bounds& bounds : this->Range.components())
    {
      ranges = std::copy(bounds.begin(), bounds.end(), ranges);
    }
    return true;
  }

  bool GiveLength(double range[2], const unsigned char* ghosts)
  {
    if (!this->Knows(ghosts) || this->Range.components().size() == 1)
    {
      return false;
    }
    range[0] = std::sqrt(this->Range.squares()[0]);
    range[1] = std::sqrt(this->Range.squares()[1]);
    return true;
  }

  granular::ValueRange Range;
  vtkMTimeType Time = 0;
  vtkIdType Values = 0;
};
#endif

/**
 * Returns a new array whose ranges can be set. VTK 9.1 has other methods: there, arrays have only the keys.
 */
template <typename Array>
vtkSmartPointer<Array> MakeArray()
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  return vtkSmartPointer<Array>::Take(KnownRanges<Array>::New());
#else
  return vtkSmartPointer<Array>::New();
#endif
}
}

#endif
