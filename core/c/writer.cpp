// SPDX-License-Identifier: BSD-3-Clause
#include "writer.h"

#include "granular/common/words.h"
#include "granular/formats/decomposition/decomposition_text.h"
#include "granular/formats/dump/write/dump_writer.h"
#include "granular/formats/euler/euler_text.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"
#include "granular/writing/whole_writer.h"

#include <algorithm>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <utility>

namespace granular_c
{
using namespace granular;

namespace
{
/// Returns a dialect by its name; an empty one and "Automatic" are none.
template <class Value>
std::optional<Value> choose_dialect(
  const granular_format& format, std::initializer_list<std::pair<const char*, Value>> choices)
{
  const std::string word = text_of(format.dialect);
  if (word.empty() || word == "Automatic")
  {
    return std::nullopt;
  }
  std::string list = "Automatic";
  for (const auto& [name, value] : choices)
  {
    if (word == name)
    {
      return value;
    }
    list += std::string(", ") + name;
  }
  throw ArgumentError("expected a dialect of " + list + ", got '" + word + "'");
}

/// As granular_format has it.
WriteOptions options_of(const granular_format& format, const InputFiles& inputs)
{
  if (format.durable < 0 || format.durable > static_cast<int>(Durability::Automatic))
  {
    throw ArgumentError(
      "expected durable of 0, 1 or 2 (automatic), got " + std::to_string(format.durable));
  }
  return { .threads = format.threads > 0 ? format.threads : available_cores(),
    .durable = static_cast<Durability>(format.durable),
    .inputs = &inputs };
}

// ---- cells and subdomains: a text that is made at once -----------------------------------------
/// The values of an array as doubles, so many in each row.
std::vector<double> doubles_of(const FrameView& frame, std::string_view name, int components)
{
  const ArrayView* const array =
    name == points_name ? (frame.points ? &*frame.points : nullptr) : frame.find(name);
  if (array == nullptr || array->size() != components || !is_number(array->type))
  {
    throw ArgumentError("expected an array '" + std::string(name) + "' of numbers with " +
      std::to_string(components) + (components == 1 ? " component" : " components") + ", got " +
      (array == nullptr ? std::string("none") : std::to_string(array->size())));
  }
  std::vector<ValueSource> sources;
  for (int i = 0; i < components; ++i)
  {
    sources.push_back(component_of(*array, i));
  }
  std::vector<std::int64_t> rows(static_cast<std::size_t>(frame.rows));
  std::iota(rows.begin(), rows.end(), std::int64_t{ 0 });
  std::vector<double> values(rows.size() * sources.size());
  load_rows(sources, rows, values.data());
  return values;
}

std::string text_of_cells(
  const FrameView& frame, EulerDialect dialect, Notices& notices, Progress& progress)
{
  EulerCells cells;
  cells.centres = doubles_of(frame, points_name, 3);
  for (std::size_t i = 0; i < cells.centres.size(); ++i)
  {
    cells.centres[i] += frame.point_origin[i % 3];
  }
  for (const EulerArray& array : euler_arrays())
  {
    if (!array.optional || frame.find(array.name) != nullptr)
    {
      cells.*array.values = doubles_of(frame, array.name, array.components);
    }
  }
  return encode_euler(cells, dialect, notices, progress);
}

}

Decomposition decomposition_of(const FrameView& frame)
{
  const std::vector<double> lo = doubles_of(frame, "lo", 3);
  const std::vector<double> hi = doubles_of(frame, "hi", 3);
  Decomposition all;
  all.has_particles = frame.find("nlocal") != nullptr;
  all.has_ranks = frame.find("proc") != nullptr;
  const auto optional = [&](bool there, const char* name)
  {
    return there ? doubles_of(frame, name, 1)
                 : std::vector<double>(static_cast<std::size_t>(frame.rows));
  };
  const std::vector<double> particles = optional(all.has_particles, "nlocal");
  const std::vector<double> ranks = optional(all.has_ranks, "proc");
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    constexpr double most = 9007199254740992; // 2^53
    if (!(particles[i] >= 0 && particles[i] <= most && ranks[i] >= 0 && ranks[i] <= INT32_MAX))
    {
      throw ArgumentError("subdomain " + std::to_string(i) +
        ": expected a number of particles and a rank of at least 0, got " + to_text(particles[i]) +
        " and " + to_text(ranks[i]));
    }
    Subdomain one;
    std::copy_n(lo.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, one.lo.begin());
    std::copy_n(hi.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, one.hi.begin());
    one.particles = static_cast<std::int64_t>(particles[i]);
    one.rank = static_cast<int>(ranks[i]);
    all.subdomains.push_back(one);
  }
  return all;
}

namespace
{
// ---- the styles --------------------------------------------------------------------------------
using Writer = std::unique_ptr<granular_writer>;

Writer blank_writer(RowKind kind, const std::string& path, const granular_format& format)
{
  return Writer(
    new granular_writer{ kind, path, Caller(format.progress, format.notice, format.user) });
}

DumpFormat rows_format(const std::string& path, DumpStyle style, const granular_format& given)
{
  DumpFormat format = format_of_name(path, text_of(given.columns), text_of(given.numbers));
  format.style = style;
  format.dialect = choose_dialect<Dialect>(
    given, { { "LIGGGHTS", Dialect::Liggghts }, { "LAMMPS", Dialect::Lammps } });
  format.atom = { given.scaled != 0, given.image != 0 };
  const std::string label = text_of(given.label);
  format.counted = label == "Automatic" ? "" : label;
  format.units = given.write_units != 0;
  format.time = given.write_time != 0;
  format.sort_by_id = given.sort_by_id != 0;
  return format;
}

template <DumpStyle style>
Writer create_rows(const std::string& path, const granular_format& format)
{
  Writer made =
    blank_writer(style == DumpStyle::Local ? RowKind::Lines : RowKind::Particles, path, format);
  DumpFormat form = rows_format(path, style, format);
  const auto rows = std::make_shared<DumpWriter>(
    path, std::move(form), options_of(format, made->inputs), made->alone);
  made->write = [rows](const FrameView& frame, Notices& notices, Progress& progress)
  { rows->write(frame, notices, progress); };
  made->finish = [rows] { rows->finish(); };
  return made;
}

/// encode: returns the text of a frame.
template <class Encode>
Writer create_text(RowKind kind, const std::string& path, const granular_format& format,
  bool holds_many, Encode encode)
{
  Writer made = blank_writer(kind, path, format);
  const auto text =
    std::make_shared<WholeWriter>(path, holds_many, options_of(format, made->inputs), made->alone);
  made->write = [text, encode](const FrameView& frame, Notices& notices, Progress& progress)
  {
    text->write(
      frame.header.timestep, [&](Notices& own) { return encode(frame, own, progress); }, notices);
  };
  made->finish = [text] { text->finish(); };
  return made;
}

Writer create_cells(const std::string& path, const granular_format& format)
{
  const EulerDialect dialect = choose_dialect<EulerDialect>(format,
    { { "LIGGGHTS", EulerDialect::Liggghts },
      { "Wide",
        EulerDialect::Wide } }).value_or(EulerDialect::Automatic);
  return create_text(RowKind::Cells, path, format, false,
    [dialect](const FrameView& frame, Notices& notices, Progress& progress)
    { return text_of_cells(frame, dialect, notices, progress); });
}

Writer create_subdomains(const std::string& path, const granular_format& format)
{
  const bool is_public =
    choose_dialect<bool>(format, { { "INL", false }, { "PUBLIC", true } }).value_or(false);
  return create_text(RowKind::Subdomains, path, format, is_public,
    [is_public, is_xml = path.ends_with(".vtu")](
      const FrameView& frame, Notices& notices, Progress& progress)
    {
      const Decomposition all = decomposition_of(frame);
      return is_public ? encode_grid(all, notices)
        : is_xml       ? encode_vtu(all, frame.header.time, progress)
                       : encode_voxels(all, progress);
    });
}

struct Style
{
  std::string_view name;
  std::string_view ending; ///< of files that have this style unless another is given
  Writer (*create)(const std::string& path, const granular_format& format);
};

constexpr Style styles[] = {
  { "custom", "", create_rows<DumpStyle::Custom> },
  { "atom", "", create_rows<DumpStyle::Atom> },
  { "local", ".bonds", create_rows<DumpStyle::Local> },
  { "euler", ".euler", create_cells },
  { "decomposition", ".decomposition", create_subdomains },
};

const Style& find_style(const std::string& path, const std::string& name)
{
  if (name.empty())
  {
    std::string_view plain = path;
    for (const std::string_view packed : { ".gz", ".zst" })
    {
      plain.remove_suffix(plain.ends_with(packed) ? packed.size() : 0);
    }
    const auto found = std::ranges::find_if(styles,
      [&](const Style& style) { return !style.ending.empty() && plain.ends_with(style.ending); });
    return found == std::end(styles) ? styles[0] : *found;
  }
  const auto found = std::ranges::find(styles, name, &Style::name);
  if (found == std::end(styles))
  {
    throw ArgumentError(
      "expected a style of " + join_words(styles, ", ", &Style::name) + ", got '" + name + "'");
  }
  return *found;
}
}

std::unique_ptr<granular_writer> create_writer(
  const std::string& path, const granular_format& format)
{
  return find_style(path, text_of(format.style)).create(path, format);
}
}

void granular_writer::add_inputs(const std::shared_ptr<const granular::RunIndex>& other)
{
  if (other && other != index)
  {
    inputs.add(*other);
    index = other;
  }
}

void granular_writer::expect_frames() const
{
  if (failed || frames == 0)
  {
    throw granular::ArgumentError(failed
        ? "expected a writer whose frames are whole, got one that failed in a frame before"
        : "expected at least one frame, got none",
      { path });
  }
}
