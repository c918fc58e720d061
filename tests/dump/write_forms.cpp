// SPDX-License-Identifier: BSD-3-Clause
// The 16 forms of dump atom, compared with what fprintf and fwrite make of the same numbers.
#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/reference_dump.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
using namespace granular;

/// The boxes as the header has them: small_box, and some with all digits, which the six of LIGGGHTS may round.
std::vector<ReferenceBox> boxes(bool tilted)
{
  if (!tilted)
  {
    return { { { -1.5, 0, 2 }, { 8.5, 7.75, 10.5 }, 0, 0, 0, false, "pp fs mm" },
      { { -0.1, 1.0 / 3, 1e5 }, { 0.1, 2.0 / 3, 1e5 + 64 }, 0, 0, 0, false, "ff pp sm" } };
  }
  return { { { -1.5, 0, 2 }, { 12.25, 9, 10.5 }, 2.5, -1.5, 1.25, true, "pp fs mm" },
    { { -0.1, 1.0 / 3, 1e5 }, { 0.3, 0.7, 1e5 + 64 }, -0.01, -0.02, 1.0 / 30, true, "pp pp pp" },
    { { -0.1, 1.0 / 3, 7 }, { 0.3, 0.7, 8 }, 0.03, -0.01, -1.0 / 70, true, "mm mm ss" } };
}

ReferenceAtoms atoms_of(const MadeRows& rows, bool image)
{
  return { rows.ids, rows.types, rows.points, image ? rows.images : std::vector<std::int32_t>() };
}

std::string written_atoms(
  const MadeRows& rows, bool image, const DumpFormat& format, std::string* said = nullptr)
{
  const Folder folder;
  FrameHeader header;
  header.timestep = 12345678901;
  header.box = rows.box;
  const Written written =
    write_dump(folder.path("atoms"), Frames{ view_atoms(rows.atoms(image), header) }, format);
  EXPECT_EQ(written.error, "");
  if (said)
  {
    *said = written.said;
  }
  return written.bytes;
}
}

TEST(WriteForms, all)
{
  for (const Form& form : all_forms())
  {
    for (const ReferenceBox& box : boxes(form.tilted))
    {
      const MadeRows rows(3000, box_of(box));
      for (const Dialect dialect : { Dialect::Liggghts, Dialect::Lammps })
      {
        const ReferenceForm reference = { form.atom.scaled, form.atom.image, form.binary,
          dialect == Dialect::Lammps };
        const std::string expected =
          reference_dump(box, atoms_of(rows, true), reference, 12345678901);
        EXPECT_EQ(difference(written_atoms(rows, true, atom_format(form, dialect)), expected), "")
          << form.name() << ", dialect " << static_cast<int>(dialect) << ", x " << box.lo[0];
      }
    }
  }
}

/// The box tells which coordinates a plain binary holds, which does not name its columns.
TEST(WriteForms, read_back_without_names)
{
  for (const Form& form : all_forms())
  {
    for (std::size_t i = 0; form.binary && i < boxes(form.tilted).size(); ++i)
    {
      const ReferenceBox box = boxes(form.tilted)[i];
      const MadeRows rows(500, box_of(box));
      const Decoded got =
        Dump(written_atoms(rows, true, atom_format(form, Dialect::Liggghts))).read();
      ASSERT_EQ(got.rows(), 500) << form.name();
      const std::vector<double> points = got.points();
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        ASSERT_NEAR(points[k], rows.points[k], 1e-9) << form.name() << ", x " << box.lo[0];
      }
    }
  }
}

/// Atoms without counts of images have crossed no face.
TEST(WriteForms, without_images)
{
  for (const Form& form : all_forms())
  {
    const ReferenceBox box = boxes(form.tilted).front();
    const MadeRows rows(100, box_of(box));
    std::string said;
    const std::string written =
      written_atoms(rows, false, atom_format(form, Dialect::Lammps), &said);
    const ReferenceForm reference = { form.atom.scaled, form.atom.image, form.binary, true };
    EXPECT_EQ(
      difference(written, reference_dump(box, atoms_of(rows, false), reference, 12345678901)), "");
    EXPECT_EQ(said.empty(), !form.atom.image) << said;
  }
}

TEST(WriteForms, no_atoms)
{
  for (const Form& form : all_forms())
  {
    const ReferenceBox box = boxes(form.tilted).front();
    const MadeRows rows(0, box_of(box));
    for (const Dialect dialect : { Dialect::Liggghts, Dialect::Lammps })
    {
      const ReferenceForm reference = { form.atom.scaled, form.atom.image, form.binary,
        dialect == Dialect::Lammps };
      EXPECT_EQ(difference(written_atoms(rows, true, atom_format(form, dialect)),
                  reference_dump(box, {}, reference, 12345678901)),
        "")
        << form.name();
    }
  }
}
