// SPDX-License-Identifier: BSD-3-Clause
// A dump of one frame written: text against a loop of fprintf, binary against a plain write() of the same
// bytes, by one thread and by two. Time on the wall; all write a new file of the same name.
#include "bench.h"
#include "dump_text.h"

#include "granular/dump/write/dump_writer.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace bench
{
namespace
{
/// Grains in the arrays of a simulation code.
struct Grains
{
  Grains(std::int64_t count, bool six_digits)
  {
    Random random(1);
    const auto digits = [six_digits](double value)
    {
      char word[granular::most_number_chars];
      std::snprintf(word, sizeof word, "%g", value);
      return six_digits ? std::strtod(word, nullptr) : value;
    };
    for (std::int64_t i = 0; i < count; ++i)
    {
      ids.push_back(i + 1);
      types.push_back(static_cast<std::int32_t>(i % 3) + 1);
      for (int axis = 0; axis < 3; ++axis)
      {
        positions.push_back(digits(random.between(-0.05, 0.05)));
        images.push_back(static_cast<std::int32_t>(random.bits() % 3) - 1);
      }
    }
    header.timestep = 1000;
    header.box = granular::Box::from_bounds({ -0.05, -0.05, -0.05 }, { 0.05, 0.05, 0.05 });
    header.box.boundary = "pp pp pp";
  }

  granular::FrameView view() const
  {
    return granular::view_atoms({ static_cast<std::int64_t>(ids.size()), ids.data(), types.data(),
                                  positions.data(), images.data() },
      header);
  }

  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> types;
  std::vector<double> positions;
  std::vector<std::int32_t> images;
  granular::FrameHeader header;
};

/// Files in memory where the system has such a place: the disk is not what is measured.
std::string output_path(const std::string& name)
{
  const std::string folder = ::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : GRANULAR_OUTPUT;
  return folder + "/granular-bench-" + std::to_string(::getpid()) + "-" + name;
}

struct OutputFileName
{
  explicit OutputFileName(const std::string& name)
    : path(output_path(name))
  {
  }
  OutputFileName(const OutputFileName&) = delete;
  OutputFileName& operator=(const OutputFileName&) = delete;
  ~OutputFileName() { ::unlink(path.c_str()); }

  std::string content() const
  {
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  std::string path;
};

bool write_ours(
  const Grains& grains, const granular::DumpFormat& format, int threads, const std::string& path)
{
  granular::SerialCommunicator ranks;
  granular::Notices notices;
  granular::Progress progress;
  granular::DumpWriter writer(path, format, { granular::ParallelMode::Gather, threads }, ranks);
  writer.write(grains.view(), notices, progress);
  writer.finish();
  return notices.empty();
}

/// The rows as dump_atom.cpp prints them, behind our header.
bool write_by_fprintf(const Grains& grains, const std::string& header, const std::string& path)
{
  ::unlink(path.c_str());
  std::FILE* const file = std::fopen(path.c_str(), "w");
  if (!file)
  {
    return false;
  }
  std::fwrite(header.data(), 1, header.size(), file);
  for (std::size_t i = 0; i < grains.ids.size(); ++i)
  {
    const double* x = grains.positions.data() + 3 * i;
    const std::int32_t* image = grains.images.data() + 3 * i;
    std::fprintf(file, "%d %d %g %g %g %d %d %d\n", static_cast<int>(grains.ids[i]),
      grains.types[i], x[0], x[1], x[2], image[0], image[1], image[2]);
  }
  return std::fclose(file) == 0;
}

bool write_plainly(const std::string& bytes, const std::string& path)
{
  ::unlink(path.c_str());
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  std::size_t done = 0;
  while (file >= 0 && done < bytes.size())
  {
    const ssize_t part = ::write(file, bytes.data() + done, bytes.size() - done);
    if (part <= 0)
    {
      break;
    }
    done += static_cast<std::size_t>(part);
  }
  return file >= 0 && ::close(file) == 0 && done == bytes.size();
}

/// Ours by one and by two threads, against another way to the same bytes.
void compete(benchmark::State& state, const Grains& grains, const granular::DumpFormat& format,
  const std::string& name, const std::function<bool(const std::string& path)>& other)
{
  const OutputFileName ours(format.binary ? "ours.bin" : "ours.dump");
  const OutputFileName two(format.binary ? "two.bin" : "two.dump");
  const OutputFileName theirs("theirs");
  const auto by = [&](const OutputFileName& file, int threads)
  { return [&, threads] { return write_ours(grains, format, threads, file.path); }; };
  if (!by(ours, 1)() || !by(two, 2)() || !other(theirs.path) || ours.content() != two.content() ||
    ours.content() != theirs.content())
  {
    fail(state, "the files differ");
    return;
  }
  Rounds rounds(wall);
  rounds.add("1 thread", by(ours, 1));
  rounds.add("2 threads", by(two, 2));
  rounds.add(name, [&] { return other(theirs.path); });
  if (!rounds.run_all(state, "a file could not be written", static_cast<double>(grains.ids.size())))
  {
    return;
  }
  const Samples& one = rounds.of("1 thread");
  tell(state, "other", 1e9 * median(rounds.of(name)), "ns/row");
  tell(state, "1 thread", 1e9 * median(one), "ns/row");
  tell(state, "2 threads", 1e9 * median(rounds.of("2 threads")), "ns/row");
  tell(state, "speed against other", median_ratio(rounds.of(name), one), "1");
  tell(state, "speed of 2 threads", median_ratio(one, rounds.of("2 threads")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of(name), one), "1");
}

struct Case
{
  const char* name;
  bool binary;
  bool scaled;
};

constexpr Case cases[] = {
  { "text, x y z", false, false },
  { "text, xs ys zs", false, true },
  { "binary, x y z", true, false },
  { "binary, xs ys zs", true, true },
};
}

void add_benchmarks(const Size& size)
{
  const std::int64_t count = size.pick(1'000'000, 3'000);
  for (const Case& one : cases)
  {
    add(std::string("write/") + one.name, size.pick(15, 2),
      [=](benchmark::State& state)
      {
        const Grains grains(count, !one.binary);
        granular::DumpFormat format;
        format.style = granular::DumpStyle::Atom;
        format.binary = one.binary;
        format.atom = { one.scaled, true };
        const OutputFileName file(one.binary ? "first.bin" : "first.dump");
        write_ours(grains, format, 1, file.path);
        const std::string bytes = file.content();
        const std::size_t header = bytes.find('\n', bytes.find("ITEM: ATOMS")) + 1;
        if (one.binary)
        {
          compete(state, grains, format, "write()",
            [&](const std::string& path) { return write_plainly(bytes, path); });
          return;
        }
        Grains printed = grains;
        if (one.scaled)
        {
          std::vector<double> row(8);
          for (std::size_t i = 0; i < grains.ids.size(); ++i)
          {
            const granular::AtomRows atoms{ 1, &grains.ids[i], &grains.types[i],
              &grains.positions[3 * i], &grains.images[3 * i] };
            granular::pack_atom_rows(atoms, grains.header.box, format.atom, 0, 1, row);
            std::copy_n(row.begin() + 2, 3, printed.positions.begin() + static_cast<long>(3 * i));
          }
        }
        compete(state, grains, format, "fprintf",
          [&](const std::string& path)
          { return write_by_fprintf(printed, bytes.substr(0, header), path); });
      });
  }
}
}
