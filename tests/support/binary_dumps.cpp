// SPDX-License-Identifier: BSD-3-Clause
#include "binary_dumps.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>

namespace binary
{
namespace
{
/// The lowest bytes of an integer.
std::string packed(std::uint64_t value, std::size_t bytes, bool big)
{
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i)
  {
    text += static_cast<char>(value >> (8 * i) & 0xff);
  }
  if (big)
  {
    std::reverse(text.begin(), text.end());
  }
  return text;
}

/// Writes numbers behind each other.
class Writer
{
public:
  Writer(Bytes& to, const Form& form)
    : to_(to)
    , form_(form)
  {
  }

  void integer(const std::string& name, std::int64_t value, std::size_t bytes)
  {
    to_.fields.push_back({ name, to_.bytes.size(), bytes, false });
    to_.bytes += packed(static_cast<std::uint64_t>(value), bytes, form_.big);
  }

  void count(const std::string& name, std::int64_t value)
  {
    this->integer(name, value, form_.wide ? 8 : 4);
  }

  void real(const std::string& name, double value)
  {
    to_.fields.push_back({ name, to_.bytes.size(), 8, true });
    this->value(value);
  }

  void value(double value)
  {
    to_.bytes += packed(std::bit_cast<std::uint64_t>(value), 8, form_.big);
  }

  void text(const std::string& name, const std::string& text)
  {
    this->integer(name, static_cast<std::int64_t>(text.size()), 4);
    to_.bytes += text;
  }

  void raw(const std::string& text) { to_.bytes += text; }

private:
  Bytes& to_;
  const Form& form_;
};

void write_box(Writer& writer, const Form& form, const Frame& frame)
{
  if (form.triclinic)
  {
    writer.integer("triclinic", frame.triclinic, 4);
  }
  else if (frame.triclinic != 0)
  {
    throw std::invalid_argument("a form without tilts");
  }
  for (const std::int32_t flag : frame.boundary)
  {
    if (form.boundary)
    {
      writer.integer("boundary", flag, 4);
    }
  }
  constexpr std::size_t numbers[] = { 6, 9, 12 };
  if (frame.box.size() != numbers[frame.triclinic])
  {
    throw std::invalid_argument("a box of another kind");
  }
  for (const double number : frame.box)
  {
    writer.real("box", number);
  }
}
}

std::int64_t Frame::rows() const
{
  return std::accumulate(chunks.begin(), chunks.end(), std::int64_t{ 0 },
           [](std::int64_t sum, const auto& chunk)
           { return sum + static_cast<std::int64_t>(chunk.size()); }) /
    size_one;
}

std::vector<double> Frame::values(std::size_t column) const
{
  std::vector<double> values;
  for (const std::vector<double>& chunk : chunks)
  {
    for (std::size_t i = column; i < chunk.size(); i += static_cast<std::size_t>(size_one))
    {
      values.push_back(chunk[i]);
    }
  }
  return values;
}

const std::vector<Form>& forms()
{
  static const std::vector<Form> all = []
  {
    const std::vector<Form> little = {
      { "DUMPATOM revision 1", "DUMPATOM", 1, true, true, true, false },
      { "DUMPATOM revision 2", "DUMPATOM", 2, true, true, true, false },
      { "DUMPCUSTOM revision 1", "DUMPCUSTOM", 1, true, true, true, false },
      { "DUMPCUSTOM revision 2", "DUMPCUSTOM", 2, true, true, true, false },
      { "plain", "", 0, true, true, true, false },
      { "plain, 32-bit", "", 0, false, true, true, false },
      { "before 2011, tilts", "", 0, false, true, false, false },
      { "before 2011", "", 0, false, false, false, false },
    };
    std::vector<Form> both;
    for (const bool big : { false, true })
    {
      for (Form one : little)
      {
        one.name += big ? ", big-endian" : ", little-endian";
        one.big = big;
        both.push_back(one);
      }
    }
    return both;
  }();
  return all;
}

const Form& form(std::string_view name)
{
  return *std::find_if(
    forms().begin(), forms().end(), [&](const Form& one) { return one.name == name; });
}

const Field& Bytes::field(const std::string& name) const
{
  const auto found = std::find_if(
    fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  if (found == fields.end())
  {
    throw std::out_of_range("no field " + name);
  }
  return *found;
}

void add(Bytes& bytes, const Form& form, const Frame& frame)
{
  Writer writer(bytes, form);
  if (!form.magic.empty())
  {
    writer.integer("magic length", -static_cast<std::int64_t>(form.magic.size()), 8);
    writer.raw(form.magic);
    writer.integer("endian", 1, 4);
    writer.integer("revision", form.revision, 4);
  }
  writer.count("timestep", frame.timestep);
  writer.count("atoms", frame.rows());
  write_box(writer, form, frame);
  writer.integer("size_one", frame.size_one, 4);
  if (form.named())
  {
    writer.text("units length", frame.units);
    writer.integer("time flag", frame.time ? 1 : 0, 1);
    if (frame.time)
    {
      writer.real("time", *frame.time);
    }
    writer.text("columns length", frame.columns);
  }
  writer.integer("nchunk", static_cast<std::int64_t>(frame.chunks.size()), 4);
  bool empty = true;
  for (const std::vector<double>& chunk : frame.chunks)
  {
    writer.integer("n", static_cast<std::int64_t>(chunk.size()), 4);
    bytes.first_value = empty && !chunk.empty() ? bytes.bytes.size() : bytes.first_value;
    empty = empty && chunk.empty();
    for (const double value : chunk)
    {
      writer.value(value);
    }
  }
  bytes.ends.push_back(bytes.bytes.size());
}

Bytes write(const Form& form, const std::vector<Frame>& frames)
{
  Bytes bytes;
  for (const Frame& frame : frames)
  {
    add(bytes, form, frame);
  }
  return bytes;
}

std::string with_field(const Bytes& bytes, const Form& form, const Field& field, std::int64_t value)
{
  if (field.real)
  {
    return with_real(bytes, form, field, static_cast<double>(value));
  }
  std::string changed = bytes.bytes;
  changed.replace(
    field.offset, field.bytes, packed(static_cast<std::uint64_t>(value), field.bytes, form.big));
  return changed;
}

std::string with_real(const Bytes& bytes, const Form& form, const Field& field, double value)
{
  std::string changed = bytes.bytes;
  changed.replace(field.offset, 8, packed(std::bit_cast<std::uint64_t>(value), 8, form.big));
  return changed;
}

std::int64_t integer_at(const std::string& bytes, const Form& form, const Field& field)
{
  std::string digits = bytes.substr(field.offset, field.bytes);
  if (!form.big)
  {
    std::reverse(digits.begin(), digits.end());
  }
  std::int64_t value = static_cast<signed char>(digits.at(0));
  for (const char digit : digits.substr(1))
  {
    value = value * 256 + static_cast<unsigned char>(digit);
  }
  return value;
}

Frame particles(const Form& form, std::int64_t step, std::int64_t rows, std::int32_t triclinic)
{
  Frame frame;
  frame.timestep = step;
  frame.triclinic = triclinic;
  frame.boundary = { 0, 0, 1, 2, 3, 3 };
  frame.box = { -1.5, 2.25, 0.125, 4, -8, -0.5 };
  if (triclinic == 1)
  {
    frame.box.insert(frame.box.end(), { 0.5, -0.25, 0.75 });
  }
  if (triclinic == 2)
  {
    frame.box = { 3, 0.5, 0.25, -0.5, 4, 0.125, 0.75, -0.25, 5, -1, -2, -3 };
  }
  frame.size_one = 12;
  if (form.named())
  {
    frame.units = "si";
    frame.time = 0.5 * static_cast<double>(step);
    frame.columns = particle_columns;
  }
  frame.chunks = { {}, {}, {} };
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const auto s = static_cast<double>(step);
    const auto r = static_cast<double>(row);
    std::vector<double>& chunk = frame.chunks[row < (rows + 1) / 2 ? 0 : 2];
    chunk.insert(chunk.end(),
      { 100 * s + r + 1, 1 + static_cast<double>(row % 3), 0.1 * r, 1e-3 * r + s, -r / 3, r, -r, 0,
        1e300 * r, -1e-300 * r, s / 7, 0.0025 + r });
  }
  return frame;
}

std::string names_for(const Form& form)
{
  return form.named() ? "" : particle_columns;
}
}
