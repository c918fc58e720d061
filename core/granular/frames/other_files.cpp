// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/other_files.h"

#include "granular/common/error.h"
#include "granular/common/words.h"
#include "granular/frames/file_index.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
constexpr const char* converted =
  "if a dump command wrote it, OVITO converts it to a dump; or run again with `dump custom`";
constexpr const char* archived = "unpack it, and open the files in it";
constexpr const char* unpacked = "unpack it first; only gzip and Zstandard need no unpacking";
constexpr const char* opened =
  "GranularVTKParticleReader opens particles in it, and GranularMeshReader walls,";
constexpr const char* downloaded = "a download has probably gone wrong; download the file itself";
// the listing of a folder in Python looks for the names of these functions
constexpr const char* logged = "vtkgranular.read_log reads it in Python";
constexpr const char* tabled = "vtkgranular.read_table reads it in Python";
constexpr const char* run = "run it, and open the files that its dump commands write";

/// The beginning of a file, and the file.
struct Head
{
  std::string_view bytes;
  const ByteSource& source;
};

/// Other than a binary dump, which may begin with a timestep of these bytes: it has 0 in the upper halves of the timestep and of the
/// number of rows, and behind them a box.
bool is_no_dump(const Head& head)
{
  const std::string_view zeros("\0\0\0\0", 4);
  const std::string_view rest = head.bytes.substr(4, 96);
  return rest.size() < 12 || rest.substr(0, 4) != zeros || rest.substr(8, 4) != zeros ||
    rest.find_first_not_of('\0') == rest.npos;
}

/// 80 bytes of any text, the number of triangles, and 50 bytes for each.
bool is_binary_stl(const Head& head)
{
  std::uint32_t triangles = 0;
  if (head.source.compressed() || head.bytes.size() < 84)
  {
    return false;
  }
  std::memcpy(&triangles, head.bytes.data() + 80, sizeof triangles);
  return triangles > 0 && head.source.stamp().size == 84 + std::int64_t{ 50 } * triangles;
}

/// The number of particles, a line of any text, and rows of a word and three numbers.
bool is_xyz(const Head& head)
{
  constexpr std::string_view digits = "0123456789";
  std::string_view rest = head.bytes;
  std::vector<std::string_view> lines;
  while (lines.size() < 3)
  {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    lines.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const std::vector<std::string_view> count = split_words(lines[0]);
  const std::vector<std::string_view> row = split_words(lines[2]);
  const auto is_number = [](std::string_view word)
  { return word.find_first_not_of("0123456789+-.e") == word.npos; };
  return count.size() == 1 && count[0].find_first_not_of(digits) == digits.npos &&
    (lines[1].find("properties=") != rest.npos ||
      (row.size() > 3 && std::all_of(row.begin() + 1, row.begin() + 4, is_number)));
}

/// Readers for a file under its usual name.
enum class Taken : std::uint8_t
{
  No,
  Yes, ///< by ParaView, or by a reader of ours for the sake of the error
  Vtk  ///< by a reader for VTK files; some files are read by kinds of their own
};

/// Signs of a file: those that are given must all be there.
struct Sign
{
  std::size_t at;          ///< of `begins`
  std::string_view begins; ///< may be empty
  std::string_view holds;  ///< somewhere in the first bytes
  const char* what;
  const char* advice;
  Taken taken = Taken::No;
  bool (*fits)(const Head& head) = nullptr;
};

// clang-format off
constexpr Sign binary[] = {
  { 0, "LammpS RestartT", "", "a restart file of LAMMPS",
    "`lmp -restart2data FILE NEW.data` makes a data file of it in full precision; open that", Taken::Yes },
  { 4, "1AY&SY", "", "a file packed by bzip2", unpacked },
  { 0, "\xfd" "7zXZ", "", "a file packed by xz", unpacked },
  { 0, "\x04\x22\x4d\x18", "", "a file packed by lz4", unpacked, Taken::No, is_no_dump },
  { 0, "7z\xbc\xaf", "", "a 7z archive", archived },
  { 257, "ustar", "", "a tar archive", archived },
  { 0, "\x1f\x8b\x08", "", "gzip data", "unpack it once" },
  { 0, "\x28\xb5\x2f\xfd", "", "Zstandard data", "unpack it once" },
  { 0, "PK\x03\x04", ".npy", "arrays of numpy (.npz)", "numpy.load reads it in Python", Taken::No, is_no_dump },
  { 0, "PK\x03\x04", "", "a zip archive", archived, Taken::No, is_no_dump },
  { 0, "CDF\x01", "", "a NetCDF file", converted, Taken::No, is_no_dump },
  { 0, "CDF\x02", "", "a NetCDF file", converted, Taken::No, is_no_dump },
  { 0, "CDF\x05", "", "a NetCDF file", converted, Taken::No, is_no_dump },
  { 0, "\x89HDF\r\n", "_NCProperties", "a NetCDF file (HDF5)", converted },
  { 0, "\x89HDF\r\n", "VTKHDF", "a VTK file", "ParaView opens it under a name like NAME.hdf (VTKHDFReader in Python)", Taken::Vtk },
  { 0, "\x89HDF\r\n", "", "an HDF5 file (as H5MD is)", "h5py reads it in Python; or run again with `dump custom`" },
  { 0, "", "", "a mesh (binary STL)", "GranularMeshReader opens it under a name like NAME.stl", Taken::Yes, is_binary_stl },
};

/// In small letters, as texts are compared.
constexpr Sign texts[] = {
  { 0, "# vtk datafile", "", "a VTK file", " under a name like NAME.vtk", Taken::Vtk },
  { 0, "<", " type='polydata'", "a VTK file", " under a name like NAME.vtp", Taken::Vtk },
  { 0, "<", " type='unstructuredgrid'", "a VTK file", " under a name like NAME.vtu", Taken::Vtk },
  { 0, "<", " type='imagedata'", "a VTK file", "ParaView opens it under a name like NAME.vti (XMLImageDataReader in Python)", Taken::Vtk },
  { 0, "<", " type='rectilineargrid'", "a VTK file", "ParaView opens it under a name like NAME.vtr (XMLRectilinearGridReader in Python)", Taken::Vtk },
  { 0, "<", " type='structuredgrid'", "a VTK file", "ParaView opens it under a name like NAME.vts (XMLStructuredGridReader in Python)", Taken::Vtk },
  { 0, "<", " type='vtkmultiblockdataset'", "a VTK file", " under a name like NAME.vtm", Taken::Vtk },
  { 0, "<", " type='vtkpartitioneddataset'", "a VTK file", "ParaView opens it under a name like NAME.vtpd (XMLPartitionedDatasetReader in Python)", Taken::Vtk },
  { 0, "<", " type='vtkpartitioneddatasetcollection'", "a VTK file", "ParaView opens it under a name like NAME.vtpc (XMLPartitionedDatasetCollectionReader in Python)",
    Taken::Vtk },
  { 0, "<", " type='collection'", "a VTK file", "ParaView opens it under a name like NAME.pvd (PVDReader in Python)", Taken::Vtk },
  { 0, "<", " type='ppolydata'", "a VTK file", " under a name like NAME.pvtp", Taken::Vtk },
  { 0, "<", " type='punstructuredgrid'", "a VTK file", " under a name like NAME.pvtu", Taken::Vtk },
  { 0, "<", " type='pimagedata'", "a VTK file", "ParaView opens it under a name like NAME.pvti (XMLPartitionedImageDataReader in Python)", Taken::Vtk },
  { 0, "<", " type='prectilineargrid'", "a VTK file", "ParaView opens it under a name like NAME.pvtr (XMLPartitionedRectilinearGridReader in Python)", Taken::Vtk },
  { 0, "<", " type='pstructuredgrid'", "a VTK file", "ParaView opens it under a name like NAME.pvts (XMLPartitionedStructuredGridReader in Python)", Taken::Vtk },
  { 0, "<", "<vtkfile", "a VTK file", "ParaView opens it", Taken::Vtk }, // of a type that is newer than this table
  { 0, "solid", "facet", "a mesh (STL)", "GranularMeshReader opens it under a name like NAME.stl", Taken::Yes },
  { 0, "ply\n", "", "a mesh (PLY)", "GranularMeshReader opens it under a name like NAME.ply", Taken::Yes },
  { 0, "<", "<!doctype html", "a web page", downloaded },
  { 0, "<", "<html", "a web page", downloaded },
  { 0, "number of particles =", "", "a file of AtomEye (`dump cfg`)", converted },
  { 0, "---", "natoms:", "a file of `dump yaml`", "PyYAML reads it in Python; or run again with `dump custom`" },
  { 0, "---", "keywords:", "a thermo table in YAML", logged },
  { 0, "#", "\nkeywords:", "averages of a fix in YAML", tabled },
  { 0, "#", "# timestep", "averages of a fix (ave/time, ave/chunk, ave/histo)", tabled },
  { 0, "# fix print output", "", "a table of fix print", tabled },
  { 0, "lammps (", "", "a log of LAMMPS", logged },
  { 0, "liggghts (", "", "a log of LIGGGHTS", logged },
  { 0, "", "\nlammps (", "a log of LAMMPS", logged },
  { 0, "", "\nliggghts (", "a log of LIGGGHTS", logged },
  { 0, "", "\nper mpi rank memory", "a log of LAMMPS", logged },
  { 0, "", "\nmemory usage per processor", "a log of LAMMPS or LIGGGHTS", logged },
  { 0, "step ", "", "a thermo table", logged },
  { 0, "", "\natom_style", "an input script of LAMMPS or LIGGGHTS", run },
  { 0, "", "\nread_data", "an input script of LAMMPS or LIGGGHTS", run },
  { 0, "", "", "an xyz file", converted, Taken::Yes, is_xyz },
};

// clang-format on

template <std::size_t Count>
const Sign* find_sign(const Sign (&signs)[Count], const Head& head)
{
  const auto found = std::ranges::find_if(signs,
    [&](const Sign& sign)
    {
      return head.bytes.substr(std::min(sign.at, head.bytes.size())).starts_with(sign.begins) &&
        head.bytes.find(sign.holds) != head.bytes.npos && (!sign.fits || sign.fits(head));
    });
  return found == std::end(signs) ? nullptr : &*found;
}

/// Returns the text at the beginning of a file in small letters, with one kind of quotes, without blanks and a mark before it.
std::string plain_text(std::string_view text)
{
  text.remove_prefix(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  text = text.substr(0, text.find('\0'));
  const auto first = std::ranges::find_if_not(text, is_blank);
  std::string small(first, text.end());
  std::ranges::transform(small, small.begin(),
    [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  std::ranges::replace(small, '"', '\'');
  return small;
}

/// Returns true for the beginning of a dump or a data file, whatever stands in its title or before its first frame.
bool is_of_run(std::string_view text)
{
  return text.starts_with("ITEM: ") || text.find("\nITEM: ") != text.npos ||
    text.find(" xlo xhi") != text.npos;
}
}

std::optional<OtherFile> find_other(const ByteSource& source, bool may_be_rows)
{
  constexpr std::int64_t enough = 16384;
  const std::string bytes = read_up_to(source, enough);
  const Sign* sign = find_sign(binary, { bytes, source });
  if (!sign && !may_be_rows && !is_of_run(bytes))
  {
    sign = find_sign(texts, { plain_text(bytes), source });
  }
  if (!sign)
  {
    return {};
  }
  const bool packed = source.compressed();
  const bool is_taken = sign->taken != Taken::No;
  const bool is_vtk = sign->taken == Taken::Vtk;
  const bool is_unpacked =
    sign->advice == downloaded || std::string_view(sign->advice).starts_with("unpack");
  return OtherFile{ sign->what + std::string(packed ? " inside gzip or Zstandard: " : ": ") +
      (packed && !is_unpacked ? "unpack it, and " : "") + (*sign->advice == ' ' ? opened : "") +
      sign->advice,
    is_vtk, is_taken && !packed };
}

void refuse_other(const ByteSource& source, const char* expected, bool reads_vtk, bool may_be_rows)
{
  const std::optional<OtherFile> other = find_other(source, may_be_rows);
  if (other && !(other->is_vtk && reads_vtk))
  {
    throw UnsupportedError(
      std::string("expected ") + expected + ", got " + other->text, { source.path() });
  }
}

bool is_refused_file(const std::string& path) noexcept
{
  return looks_so(path,
    [](const ByteSource& source)
    {
      char byte = 0;
      const std::optional<OtherFile> other = find_other(source);
      return other ? !other->is_taken : source.read(0, &byte, 1) == 0;
    });
}
}
