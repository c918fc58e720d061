// SPDX-License-Identifier: BSD-3-Clause
// Restart files that are changed field by field and record by record, so that what is behind still fits.
#ifndef granular_tests_fuzz_restart_mutations_h
#define granular_tests_fuzz_restart_mutations_h

#include "mutations.h"

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/formats/restart/header_fields.h"
#include "granular/formats/restart/restart_layout.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace granular::fuzz
{
/// A restart file whose layout is known.
class RestartEditor
{
public:
  RestartEditor(std::string& bytes, const RestartLayout& layout, Random& random)
    : bytes_(bytes)
    , layout_(layout)
    , random_(random)
  {
    this->find_fields();
  }

  void change(std::size_t most)
  {
    const RestartChunk* const chunk = this->some_chunk();
    switch (chunk == nullptr ? below(random_, 2) : below(random_, 8))
    {
      case 0:
        return this->change_field();
      case 1:
        return this->change_middle(most);
      case 2:
        return this->repeat_record(*chunk);
      case 3:
        return this->remove_record(*chunk);
      case 4:
      case 5:
        return this->change_length(*chunk);
      default:
        return this->change_doubles(*chunk);
    }
  }

private:
  struct Field
  {
    std::size_t at = 0;
    FieldKind kind = FieldKind::Int;
    std::size_t size = 0;
  };

  template <typename T>
  T get(std::size_t at) const
  {
    return load<T>(bytes_, at, layout_.swapped);
  }

  template <typename T>
  void put(std::size_t at, T value)
  {
    store(bytes_, at, value, layout_.swapped);
  }

  void find_fields()
  {
    const auto end = static_cast<std::size_t>(layout_.header.end);
    for (std::size_t at = 0; at + 8 <= end;)
    {
      const auto number = static_cast<std::size_t>(this->get<std::int32_t>(at));
      at += 4;
      if (number >= header_fields.size())
      {
        return;
      }
      this->add(at, header_fields[number].kind);
      atoms_ = number == flag::atoms ? fields_.back().at : atoms_;
      if (number == flag::atom_style)
      {
        this->add_styles(at);
      }
    }
  }

  void add(std::size_t& at, FieldKind kind)
  {
    Field field{ at, kind, 4 };
    switch (kind)
    {
      case FieldKind::Text:
        field.at += 4;
        field.size = static_cast<std::size_t>(this->get<std::int32_t>(at));
        at += 4;
        break;
      case FieldKind::Int:
        break;
      case FieldKind::Count:
        field.size = static_cast<std::size_t>(layout_.header.count_bytes);
        break;
      case FieldKind::Real:
        field.size = 8;
        break;
    }
    at += field.size;
    fields_.push_back(field);
  }

  /// What follows the atom style has no flags.
  void add_styles(std::size_t& at)
  {
    if (layout_.header.atom_style == "hybrid")
    {
      this->add(at, FieldKind::Int);
      for (std::size_t i = 0; i < layout_.header.styles.size(); ++i)
      {
        this->add(at, FieldKind::Text);
      }
    }
    for (const RestartStyle& style : layout_.header.styles)
    {
      if (style.name == "bond/gran")
      {
        this->add(at, FieldKind::Int);
        this->add(at, FieldKind::Int);
      }
    }
  }

  const RestartChunk* some_chunk()
  {
    std::vector<const RestartChunk*> full;
    for (const RestartChunk& chunk : layout_.chunks)
    {
      if (chunk.path.empty() && chunk.doubles > 0)
      {
        full.push_back(&chunk);
      }
    }
    return full.empty() ? nullptr : full[below(random_, full.size())];
  }

  void change_field()
  {
    const Field field = fields_[below(random_, fields_.size())];
    if (field.kind == FieldKind::Text)
    {
      store(
        bytes_, field.at + below(random_, field.size), static_cast<char>('a' + below(random_, 26)));
    }
    else if (field.kind == FieldKind::Real)
    {
      this->put(field.at, other_double(random_));
    }
    else if (field.size == 8)
    {
      this->put(field.at, other_integer(this->get<std::int64_t>(field.at), random_));
    }
    else
    {
      this->put(field.at, other_integer(this->get<std::int32_t>(field.at), random_));
    }
  }

  /// Groups, masses, force fields and fixes.
  void change_middle(std::size_t most)
  {
    const auto begin = static_cast<std::size_t>(layout_.header.end);
    const std::size_t end = std::max(begin, static_cast<std::size_t>(layout_.begin));
    std::string middle = bytes_.substr(begin, end - begin);
    mutate_bytes(middle, std::min(most, middle.size() + 64));
    bytes_.replace(begin, end - begin, middle);
  }

  struct Record
  {
    std::size_t at = 0;
    std::size_t doubles = 0;
  };

  Record some_record(const RestartChunk& chunk)
  {
    const auto begin = static_cast<std::size_t>(chunk.offset);
    const std::size_t end = begin + 8 * static_cast<std::size_t>(chunk.doubles);
    std::vector<Record> records;
    for (std::size_t at = begin; at + 8 <= end;)
    {
      const double length = this->get<double>(at);
      const std::size_t left = (end - at) / 8;
      if (!(length >= 1 && length <= static_cast<double>(left)))
      {
        break;
      }
      records.push_back({ at, static_cast<std::size_t>(length) });
      at += 8 * records.back().doubles;
    }
    return records.empty() ? Record{ begin, 0 } : records[below(random_, records.size())];
  }

  /// Doubles and records that are more or fewer.
  void count(const RestartChunk& chunk, std::int64_t doubles, std::int64_t records)
  {
    this->put(static_cast<std::size_t>(chunk.offset) - 4,
      static_cast<std::int32_t>(chunk.doubles + doubles));
    const std::int64_t atoms = layout_.header.atoms + records;
    if (layout_.header.count_bytes == 8)
    {
      this->put(atoms_, atoms);
    }
    else
    {
      this->put(atoms_, static_cast<std::int32_t>(atoms));
    }
  }

  void repeat_record(const RestartChunk& chunk)
  {
    const Record record = this->some_record(chunk);
    bytes_.insert(record.at, std::string(bytes_, record.at, 8 * record.doubles));
    this->count(chunk, static_cast<std::int64_t>(record.doubles), 1);
  }

  void remove_record(const RestartChunk& chunk)
  {
    const Record record = this->some_record(chunk);
    bytes_.erase(record.at, 8 * record.doubles);
    this->count(chunk, -static_cast<std::int64_t>(record.doubles), -1);
  }

  /// One or more doubles more in a record, or fewer, of which its length says, and lengths of parts in it may, too.
  void change_length(const RestartChunk& chunk)
  {
    const Record record = this->some_record(chunk);
    if (record.doubles < 2)
    {
      return;
    }
    const std::size_t place = 1 + below(random_, record.doubles - 1);
    const std::size_t many = 1 + below(random_, 4);
    if (one_in(random_, 2))
    {
      const std::size_t fewer = std::min(many, record.doubles - place);
      bytes_.erase(record.at + 8 * place, 8 * fewer);
      this->put(record.at, static_cast<double>(record.doubles - fewer));
      this->count(chunk, -static_cast<std::int64_t>(fewer), 0);
      return;
    }
    const std::size_t from = record.at + 8 * below(random_, record.doubles);
    std::string more;
    for (std::size_t i = 0; i < many; ++i)
    {
      more.append(bytes_, from, 8);
    }
    bytes_.insert(record.at + 8 * place, more);
    this->put(record.at, static_cast<double>(record.doubles + many));
    this->count(chunk, static_cast<std::int64_t>(many), 0);
  }

  void change_doubles(const RestartChunk& chunk)
  {
    const Record record = this->some_record(chunk);
    for (std::size_t left = below(random_, 3) + 1; left > 0 && record.doubles > 1; --left)
    {
      const std::size_t at = record.at + 8 * (1 + below(random_, record.doubles - 1));
      // whole numbers are doubles in the files of some programs, and their bits in those of others
      one_in(random_, 3)
        ? this->put(at, other_integer(this->get<std::int64_t>(at), random_))
        : this->put(at, one_in(random_, 2) ? this->get<double>(at) + 1 : other_double(random_));
    }
  }

  std::string& bytes_;
  const RestartLayout& layout_;
  Random& random_;
  std::vector<Field> fields_;
  std::size_t atoms_ = 0; ///< where their number is
};

inline void mutate(std::string& bytes, Random& random, std::size_t most)
{
  std::optional<RestartLayout> layout;
  if (!one_in(random, 4))
  {
    Notices notices;
    Progress progress;
    try
    {
      layout = read_layout(*open_memory(bytes), notices, progress);
    }
    catch (const Error&)
    {
      // a file of which nobody knows the parts
    }
  }
  if (!layout)
  {
    mutate_bytes(bytes, most);
    return;
  }
  RestartEditor(bytes, *layout, random).change(most);
}
}

#endif
