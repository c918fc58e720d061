// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_binary_dumps_h
#define granular_tests_support_binary_dumps_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Binary dumps as programs write them, put together byte by byte: dump_atom.cpp and dump_custom.cpp
/// of LIGGGHTS and LAMMPS, now and then.
namespace binary
{
/// A layout: which fields there are, of which size, in which byte order.
struct Form
{
  std::string name;
  std::string magic;     ///< DUMPATOM, DUMPCUSTOM or none
  int revision = 0;      ///< of forms with magic
  bool wide = true;      ///< timestep and number of atoms are 64-bit
  bool triclinic = true; ///< has the flag
  bool boundary = true;  ///< has the flags of the faces
  bool big = false;      ///< big-endian

  bool named() const { return revision > 1; } ///< has units, time and names of columns
  int most_triclinic() const { return !magic.empty() ? 2 : triclinic ? 1 : 0; }
};

/// Both magic words in both revisions, plain, plain with 32-bit integers, and the two from before 2011;
/// each in both byte orders.
const std::vector<Form>& forms();

/// The form of that name, "plain, little-endian".
const Form& form(std::string_view name);

struct Frame
{
  std::int64_t timestep = 0;
  std::int32_t triclinic = 0;
  std::array<std::int32_t, 6> boundary = {};
  /// As they stand in the file: xlo xhi ylo yhi zlo zhi, and xy xz yz of triclinic 1; of triclinic
  /// 2 a b c origin.
  std::vector<double> box = { 0, 1, 0, 1, 0, 1 };
  std::int32_t size_one = 0;
  std::string units;
  std::optional<double> time;
  std::string columns;
  std::vector<std::vector<double>> chunks = { {} }; ///< values of rows

  std::int64_t rows() const;
  std::vector<double> values(std::size_t column) const;
};

/// A number in the bytes.
struct Field
{
  std::string name;
  std::size_t offset;
  std::size_t bytes;
  bool real; ///< a double
};

/// What is written, and where.
struct Bytes
{
  std::string bytes;
  std::vector<Field> fields;     ///< of the headers, in their order
  std::vector<std::size_t> ends; ///< of the frames
  std::size_t first_value = 0;   ///< of the last frame that has values

  const Field& field(const std::string& name) const; ///< the first of that name
};

void add(Bytes& bytes, const Form& form, const Frame& frame);
Bytes write(const Form& form, const std::vector<Frame>& frames);

/// Replaces a number, cut to its size; a real one by the double of that value.
std::string with_field(
  const Bytes& bytes, const Form& form, const Field& field, std::int64_t value);
std::string with_real(const Bytes& bytes, const Form& form, const Field& field, double value);

/// A number that may be changed, as it stands.
std::int64_t integer_at(const std::string& bytes, const Form& form, const Field& field);

/// Some rows of "id type x y z ix iy iz vx vy vz radius" in three chunks, the middle one empty; the
/// values name their step, row and column.
Frame particles(const Form& form, std::int64_t step, std::int64_t rows, std::int32_t triclinic = 0);

inline constexpr const char* particle_columns = "id type x y z ix iy iz vx vy vz radius";

/// Their column names, for forms that do not hold them.
std::string names_for(const Form& form);
}
#endif
