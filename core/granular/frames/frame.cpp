// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/frame.h"

#include "granular/common/hash.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace granular
{
namespace
{
void mix(Hash& hash, const Twofold3& vector)
{
  for (const Twofold& component : vector)
  {
    hash.add(&component.hi, sizeof component.hi);
    hash.add(&component.lo, sizeof component.lo);
  }
}
}

ColumnSchema binary_schema(const std::vector<std::string>& names)
{
  ColumnSchema schema(names);
  std::vector<ColumnSchema::TypeChange> integers;
  for (std::size_t column = 0; column < names.size(); ++column)
  {
    if (schema.columns()[column].type == ValueType::Text)
    {
      integers.push_back({ static_cast<int>(column), ValueType::Int32 });
    }
  }
  schema.set_types(integers);
  return schema;
}

std::shared_ptr<const FrameKind> FrameKinds::share(FrameKind kind)
{
  const std::string names =
    kind.guessed ? std::to_string(kind.schema.columns().size()) : kind.schema.text();
  Hash hash;
  hash.add(names.data(), names.size());
  kind.names_hash = hash.value();
  const std::lock_guard lock(mutex_);
  for (const auto& known : kinds_)
  {
    if (*known == kind)
    {
      return last_ = known;
    }
  }
  kinds_.push_back(std::make_shared<const FrameKind>(std::move(kind)));
  return last_ = kinds_.back();
}

std::shared_ptr<const FrameKind> FrameKinds::last() const
{
  const std::lock_guard lock(mutex_);
  return last_;
}

std::uint64_t hash_shape(const FrameHeader& header, const FrameKind& kind)
{
  Hash hash;
  mix(hash, header.box.origin);
  for (const Twofold3& vector : header.box.vectors)
  {
    mix(hash, vector);
  }
  hash.add(header.box.boundary.data(), header.box.boundary.size());
  hash.add(&kind.names_hash, sizeof kind.names_hash);
  return hash.value();
}

Where where_of(const std::string& path, const FrameEntry& entry)
{
  const bool text = entry.kind->is_text();
  return { path, entry.line, text ? -1 : entry.offset };
}

void check_header(const std::string& path, const FrameEntry& entry, const FrameHeader& header,
  const std::vector<std::string>& columns)
{
  const bool same_columns = columns.empty() ||
    std::ranges::equal(columns, entry.kind->schema.columns(), {}, {}, &ColumnInfo::name);
  const double time = header.time.value_or(FrameEntry::no_time);
  const bool same_time = time == entry.time || (std::isnan(time) && std::isnan(entry.time));
  const bool same_units = header.units.empty() || header.units == entry.kind->units;
  if (!same_columns || !same_time || !same_units || header.timestep != entry.timestep ||
    header.rows != entry.rows || hash_shape(header, *entry.kind) != entry.shape)
  {
    throw IoError("the file changed since it was indexed: expected the frame of timestep " +
        std::to_string(entry.timestep) + "; reload the files",
      where_of(path, entry));
  }
}
void check_cells(const FrameEntry& entry, std::int64_t cells, const Where& where)
{
  if (cells != entry.rows)
  {
    throw IoError("the file changed since it was indexed: expected " + std::to_string(entry.rows) +
        " cells, got " + std::to_string(cells) + "; reload the files",
      where);
  }
}
}
