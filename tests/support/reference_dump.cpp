// SPDX-License-Identifier: BSD-3-Clause
#include "reference_dump.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{
/// A file without a name.
class Stream
{
public:
  Stream() = default;
  Stream(const Stream&) = delete;
  ~Stream() { std::fclose(file_); }

  std::FILE* file() const { return file_; }

  template <class Value>
  void write(Value value)
  {
    std::fwrite(&value, sizeof value, 1, file_);
  }

  std::string text()
  {
    std::string text(static_cast<std::size_t>(std::ftell(file_)), '\0');
    std::rewind(file_);
    text.resize(std::fread(text.data(), 1, text.size(), file_));
    return text;
  }

private:
  std::FILE* file_ = std::tmpfile();
};

/// A row as doubles.
std::vector<double> row_of(
  const ReferenceBox& box, const ReferenceAtoms& atoms, const ReferenceForm& form, std::size_t row)
{
  const double* point = atoms.points.data() + 3 * row;
  std::vector<double> values = { static_cast<double>(atoms.ids[row]),
    static_cast<double>(atoms.types[row]), point[0], point[1], point[2] };
  if (form.scaled)
  {
    const std::array<Exact, 3> scaled = box.scaled({ point[0], point[1], point[2] });
    for (std::size_t k = 0; k < 3; ++k)
    {
      values[2 + k] = static_cast<double>(scaled[k].value);
    }
  }
  for (std::size_t k = 0; form.image && k < 3; ++k)
  {
    values.push_back(atoms.images.empty() ? 0 : atoms.images[3 * row + k]);
  }
  return values;
}

void write_text(Stream& stream, const ReferenceBox& box, const ReferenceAtoms& atoms,
  const ReferenceForm& form, std::int64_t timestep)
{
  std::FILE* const file = stream.file();
  std::fprintf(file, "ITEM: TIMESTEP\n%lld\nITEM: NUMBER OF ATOMS\n%zu\n",
    static_cast<long long>(timestep), atoms.ids.size());
  std::fprintf(file, "ITEM: BOX BOUNDS %s%s\n", box.tilted ? "xy xz yz " : "", box.boundary);
  const double tilts[] = { box.xy, box.xz, box.yz };
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::fprintf(file, form.lammps ? "%-1.16e %-1.16e" : "%g %g", box.lo[k], box.hi[k]);
    if (box.tilted)
    {
      std::fprintf(file, form.lammps ? " %-1.16e" : " %g", tilts[k]);
    }
    std::fprintf(file, "\n");
  }
  std::fprintf(file, "ITEM: ATOMS id type %s%s\n", form.scaled ? "xs ys zs" : "x y z",
    form.image ? " ix iy iz" : "");
  for (std::size_t row = 0; row < atoms.ids.size(); ++row)
  {
    const std::vector<double> v = row_of(box, atoms, form, row);
    std::fprintf(file, "%lld %d %g %g %g", static_cast<long long>(atoms.ids[row]), atoms.types[row],
      v[2], v[3], v[4]);
    if (form.image)
    {
      std::fprintf(
        file, " %d %d %d", static_cast<int>(v[5]), static_cast<int>(v[6]), static_cast<int>(v[7]));
    }
    std::fprintf(file, "\n");
  }
}

void write_text_field(Stream& stream, const char* text)
{
  stream.write(static_cast<std::int32_t>(std::strlen(text)));
  std::fputs(text, stream.file());
}

void write_header(Stream& stream, const ReferenceBox& box, const ReferenceForm& form,
  std::int64_t timestep, std::int64_t rows)
{
  if (form.lammps)
  {
    stream.write(std::int64_t{ -8 });
    std::fputs("DUMPATOM", stream.file());
    stream.write(std::int32_t{ 1 });
    stream.write(std::int32_t{ 2 });
  }
  stream.write(timestep);
  stream.write(rows);
  stream.write(std::int32_t{ box.tilted });
  for (const std::size_t at : { 0U, 1U, 3U, 4U, 6U, 7U })
  {
    const char* const flags = "pfsm";
    stream.write(static_cast<std::int32_t>(std::strchr(flags, box.boundary[at]) - flags));
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    stream.write(box.lo[k]);
    stream.write(box.hi[k]);
  }
  if (box.tilted)
  {
    stream.write(box.xy);
    stream.write(box.xz);
    stream.write(box.yz);
  }
  stream.write(std::int32_t{ form.image ? 8 : 5 });
  if (form.lammps)
  {
    write_text_field(stream, "");
    stream.write('\0');
    const std::string coordinates = form.scaled ? "id type xs ys zs" : "id type x y z";
    write_text_field(stream, (coordinates + (form.image ? " ix iy iz" : "")).c_str());
  }
}

void write_binary(Stream& stream, const ReferenceBox& box, const ReferenceAtoms& atoms,
  const ReferenceForm& form, std::int64_t timestep)
{
  const std::size_t rows = atoms.ids.size();
  write_header(stream, box, form, timestep, static_cast<std::int64_t>(rows));
  const std::size_t most = form.chunk_rows > 0 ? static_cast<std::size_t>(form.chunk_rows) : rows;
  const std::size_t chunks = rows == 0 ? 1 : (rows + most - 1) / most;
  stream.write(static_cast<std::int32_t>(chunks));
  for (std::size_t chunk = 0; chunk < chunks; ++chunk)
  {
    const std::size_t first = chunk * most;
    const std::size_t end = std::min(rows, first + most);
    stream.write(static_cast<std::int32_t>((end - first) * (form.image ? 8 : 5)));
    for (std::size_t row = first; row < end; ++row)
    {
      for (const double value : row_of(box, atoms, form, row))
      {
        stream.write(value);
      }
    }
  }
}
}

std::array<Exact, 3> ReferenceBox::corner() const
{
  if (!tilted)
  {
    return { Exact(lo[0]), Exact(lo[1]), Exact(lo[2]) };
  }
  return { Exact(lo[0]) - least({ 0.0, xy, xz, Exact(xy) + xz }), Exact(lo[1]) - least({ 0.0, yz }),
    Exact(lo[2]) };
}

std::array<std::array<Exact, 3>, 3> ReferenceBox::matrix() const
{
  const std::array<Exact, 3> first = this->corner();
  std::array<std::array<Exact, 3>, 3> h;
  h[0][0] = Exact(hi[0]) - greatest({ 0.0, xy, xz, Exact(xy) + xz }) - first[0];
  h[1][1] = Exact(hi[1]) - greatest({ 0.0, yz }) - first[1];
  h[2][2] = Exact(hi[2]) - first[2];
  h[0][1] = xy;
  h[0][2] = xz;
  h[1][2] = yz;
  return h;
}

std::array<Exact, 3> ReferenceBox::scaled(const std::array<Exact, 3>& point) const
{
  const std::array<Exact, 3> first = this->corner();
  const std::array<std::array<Exact, 3>, 3> h = this->matrix();
  std::array<Exact, 3> lambda;
  lambda[2] = (point[2] - first[2]) / h[2][2];
  lambda[1] = (point[1] - first[1] - h[1][2] * lambda[2]) / h[1][1];
  lambda[0] = (point[0] - first[0] - h[0][1] * lambda[1] - h[0][2] * lambda[2]) / h[0][0];
  return lambda;
}

granular::Box box_of(const ReferenceBox& box)
{
  using granular::Box;
  const granular::Vector3 lo = { box.lo[0], box.lo[1], box.lo[2] };
  const granular::Vector3 hi = { box.hi[0], box.hi[1], box.hi[2] };
  Box made =
    box.tilted ? Box::from_tilted_bounds(lo, hi, box.xy, box.xz, box.yz) : Box::from_bounds(lo, hi);
  made.boundary = box.boundary;
  return made;
}

std::string reference_dump(const ReferenceBox& box, const ReferenceAtoms& atoms,
  const ReferenceForm& form, std::int64_t timestep)
{
  Stream stream;
  form.binary ? write_binary(stream, box, atoms, form, timestep)
              : write_text(stream, box, atoms, form, timestep);
  return stream.text();
}
