// SPDX-License-Identifier: BSD-3-Clause
#include "private/arrays/arrays.h"

#include "granular/memory/value_range.h"
#include "granular/numbers/number.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationInformationVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkType.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkVersion.h"
#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

namespace vtkGranularPrivate
{
namespace
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

template <typename Array>
vtkSmartPointer<Array> TakeBlock(granular::Block& block, vtkIdType tuples, int components)
{
  auto array = MakeArray<Array>();
  array->SetNumberOfComponents(components);
  if (tuples > 0)
  {
    auto* values = static_cast<typename Array::ValueType*>(block.release());
    array->SetArray(values, tuples * components, 0, vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
    array->SetArrayFreeFunction(granular::Block::free);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> TakeTexts(const granular::TableArray& texts, vtkIdType rows)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetNumberOfValues(rows);
  const auto* indices = static_cast<const vtkTypeInt32*>(texts.block.data());
  for (vtkIdType i = 0; i < rows; ++i)
  {
    array->SetValue(i, texts.words[indices[i]]);
  }
  return array;
}

/**
 * Components of three are axes, and shown as X, Y and Z anyway; others keep the file's names.
 */
void NameComponents(vtkAbstractArray* array, const granular::ArrayInfo& info,
  const std::vector<granular::ColumnInfo>& columns)
{
  if (info.components() == 1 || info.columns.front() < 0 || // that is made of no columns
    (info.components() == 3 && columns[info.columns.front()].name.find('[') == std::string::npos))
  {
    return;
  }
  for (int i = 0; i < info.components(); ++i)
  {
    array->SetComponentName(i, columns[info.columns[i]].name.c_str());
  }
}

/**
 * 0, step, 2 step and so on.
 */
template <typename Index>
vtkSmartPointer<Index> CountUp(
  vtkIdType count, vtkIdType step, const std::shared_ptr<granular::BlockPool>& pool)
{
  using Value = typename Index::ValueType;
  granular::Block block(static_cast<std::size_t>(count) * sizeof(Value), pool);
  auto* values = static_cast<Value*>(block.data());
  for (vtkIdType i = 0; i < count; ++i)
  {
    values[i] = static_cast<Value>(i * step);
  }
  return TakeBlock<Index>(block, count, 1);
}

template <typename Index>
vtkSmartPointer<vtkCellArray> MakeCellsOf(
  vtkIdType cells, vtkIdType size, const std::shared_ptr<granular::BlockPool>& pool)
{
  auto made = vtkSmartPointer<vtkCellArray>::New();
  made->SetData(
    CountUp<Index>(cells + 1, size, pool).Get(), CountUp<Index>(cells * size, 1, pool).Get());
  return made;
}

/**
 * Tells an array what VTK would find out by looking at all its values, one component after the other and
 * more than once, each time that its range is asked for first. Modified() makes it forget.
 */
void SetRange(vtkDataArray* array, const granular::ValueRange& range)
{
  if (!range.known())
  {
    return;
  }
  vtkInformation* info = array->GetInformation();
  for (vtkInformationInformationVectorKey* key :
    { vtkAbstractArray::PER_COMPONENT(), vtkAbstractArray::PER_FINITE_COMPONENT() })
  {
    vtkNew<vtkInformationVector> components;
    for (const granular::ValueRange::Bounds& bounds : range.components())
    {
      vtkNew<vtkInformation> component;
      component->Set(vtkDataArray::COMPONENT_RANGE(), bounds.data(), 2);
      components->Append(component);
    }
    info->Set(key, components);
  }
  if (range.components().size() > 1)
  {
    const double lengths[] = { std::sqrt(range.squares()[0]), std::sqrt(range.squares()[1]) };
    info->Set(vtkDataArray::L2_NORM_RANGE(), lengths, 2);
    info->Set(vtkDataArray::L2_NORM_FINITE_RANGE(), lengths, 2);
  }
  if (auto* holder = dynamic_cast<RangeHolder*>(array))
  {
    holder->SetKnown(range);
  }
}

vtkSmartPointer<vtkAbstractArray> TakeValues(granular::TableArray& array, vtkIdType rows)
{
  const int components = array.info.components();
  switch (array.info.type)
  {
    case granular::ValueType::Int32:
      return TakeBlock<vtkTypeInt32Array>(array.block, rows, components);
    case granular::ValueType::Int64:
      return TakeBlock<vtkTypeInt64Array>(array.block, rows, components);
    case granular::ValueType::Float64:
      return TakeBlock<vtkDoubleArray>(array.block, rows, components);
    default:
      return TakeTexts(array, rows);
  }
}

void Describe(vtkAbstractArray* taken, const granular::TableArray& array,
  const std::vector<granular::ColumnInfo>& columns)
{
  taken->SetName(array.info.name.c_str());
  NameComponents(taken, array.info, columns);
  if (auto* numbers = vtkDataArray::SafeDownCast(taken))
  {
    SetRange(numbers, array.range);
  }
}

/**
 * Changes of cells or of the arrays behind them that were announced.
 */
vtkMTimeType TimeOf(vtkCellArray* cells)
{
  return std::max({ cells->GetMTime(), cells->GetOffsetsArray()->GetMTime(),
    cells->GetConnectivityArray()->GetMTime() });
}

constexpr const char* PoolVariable = "GRANULAR_POOL_MIB";

/**
 * More than the arrays of a frame that fits in memory together with what is made from it, so that all of
 * it comes back; and little enough to wait for a next frame. 0 if the system does not say what it has.
 */
std::size_t DefaultPoolLimit()
{
  vtksys::SystemInformation system;
  const long long kib = system.GetProcMemoryAvailable();
  return static_cast<std::size_t>(std::max(kib, 0LL)) / 8 * 1024;
}

std::size_t PoolLimit(granular::Notices& notices)
{
  const char* value = std::getenv(PoolVariable);
  if (!value || !*value)
  {
    return DefaultPoolLimit();
  }
  const std::string text = value;
  std::int64_t mib = -1;
  if (!granular::parse_int64(text.data(), text.data() + text.size(), mib) || mib < 0)
  {
    granular::Notice notice;
    notice.text = std::string("expected a number of MiB in ") + PoolVariable + ", got '" + text +
      "'; memory is kept as if it were not set";
    notices.push_back(notice);
    return DefaultPoolLimit();
  }
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() >> 20;
  return static_cast<std::size_t>(std::min(mib, most)) << 20;
}
}

vtkSmartPointer<vtkAbstractArray> TakeArray(
  granular::TableArray& array, vtkIdType rows, const std::vector<granular::ColumnInfo>& columns)
{
  const auto taken = TakeValues(array, rows);
  Describe(taken, array, columns);
  return taken;
}

void AddTaken(vtkFieldData* data, granular::TableArray& array, vtkIdType rows,
  const std::vector<granular::ColumnInfo>& columns)
{
  const auto taken = TakeValues(array, rows);
  data->AddArray(taken);
  Describe(taken, array, columns);
}

void AddNew(vtkFieldData* data, vtkAbstractArray* array)
{
  const std::string name = array->GetName();
  array->SetName(nullptr);
  data->AddArray(array);
  array->SetName(name.c_str());
}

vtkSmartPointer<vtkPoints> TakePoints(
  granular::Block& block, vtkIdType rows, bool single, const granular::ValueRange& range)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  vtkSmartPointer<vtkDataArray> values;
  if (single)
  {
    values = TakeBlock<vtkFloatArray>(block, rows, 3);
  }
  else
  {
    values = TakeBlock<vtkDoubleArray>(block, rows, 3);
  }
  values->SetName("Points");
  points->SetData(values);
  SetRange(values, range);
  return points;
}

vtkSmartPointer<vtkDoubleArray> TakeDoubles(
  const char* name, granular::Block& block, vtkIdType tuples, int components)
{
  auto array = TakeBlock<vtkDoubleArray>(block, tuples, components);
  array->SetName(name);
  return array;
}

vtkSmartPointer<vtkAbstractArray> TakeTuples(vtkAbstractArray* array, vtkIdList* tuples)
{
  auto taken = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  taken->SetName(array->GetName());
  taken->SetNumberOfComponents(array->GetNumberOfComponents());
  taken->CopyComponentNames(array);
  taken->SetNumberOfTuples(tuples->GetNumberOfIds());
  array->GetTuples(tuples, taken);
  return taken;
}

vtkSmartPointer<vtkAbstractArray> MakeDoubles(const char* name, const std::vector<double>& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTuple(values.data());
  return array;
}

vtkSmartPointer<vtkAbstractArray> MakeStrings(
  const char* name, const std::vector<std::string>& values)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (const std::string& value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

vtkSmartPointer<vtkCellArray> TakeCells(granular::Block& connectivity, vtkIdType cells, int size)
{
  auto taken = vtkSmartPointer<vtkCellArray>::New();
  if (cells > 0)
  {
    auto offsets = CountUp<vtkTypeInt64Array>(cells + 1, size, connectivity.pool());
    auto corners = TakeBlock<vtkTypeInt64Array>(connectivity, cells * size, 1);
    taken->SetData(offsets.Get(), corners.Get());
  }
  return taken;
}

vtkSmartPointer<vtkCellArray> MakeCells(
  vtkIdType cells, vtkIdType size, const std::shared_ptr<granular::BlockPool>& pool)
{
  if (cells * size == 0)
  {
    return vtkSmartPointer<vtkCellArray>::New();
  }
  return cells * size < VTK_TYPE_INT32_MAX ? MakeCellsOf<vtkTypeInt32Array>(cells, size, pool)
                                           : MakeCellsOf<vtkTypeInt64Array>(cells, size, pool);
}

VertexCache::VertexCache() = default;

VertexCache::~VertexCache() = default;

vtkSmartPointer<vtkCellArray> VertexCache::Get(
  vtkIdType points, bool onePerPoint, const std::shared_ptr<granular::BlockPool>& pool)
{
  const bool same = this->Cells && this->Points == points && this->OnePerPoint == onePerPoint &&
    this->Cells->GetNumberOfCells() == (onePerPoint ? points : std::min<vtkIdType>(points, 1)) &&
    this->Cells->GetNumberOfConnectivityIds() == points && TimeOf(this->Cells) == this->Time;
  if (!same)
  {
    this->Cells = nullptr; // into the pool, if nobody else has it
    this->Cells = MakeCells(onePerPoint ? points : 1, onePerPoint ? 1 : points, pool);
    this->Points = points;
    this->OnePerPoint = onePerPoint;
    this->Time = TimeOf(this->Cells);
  }
  return this->Cells;
}

std::shared_ptr<granular::BlockPool> MakePool(granular::Notices& notices)
{
  const std::size_t limit = PoolLimit(notices);
  return limit > 0 ? std::make_shared<granular::BlockPool>(limit) : nullptr;
}
}
