// SPDX-License-Identifier: BSD-3-Clause
// The C interface: any bytes as files, and any calls in any order. An input is one or more files, with "\0FILE" between them;
// behind the last "\0CALLS" of it there may be calls, eight bytes each: the number of the call, and what is chosen in it.
// Whatever they are, a function that fails has a status and a message, and arrays are as large as they say.
#include "mutations.h"

#include "granular.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

using namespace granular::fuzz;

namespace
{
constexpr std::string_view separator("\0CALLS", 6);
constexpr std::string_view next_file("\0FILE", 5);

void require(bool good, const char* what)
{
  if (!good)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

/// A status is that of the last error, which has a message.
bool ok(granular_status status)
{
  if (status != GRANULAR_OK)
  {
    const granular_error* const error = granular_last_error();
    require(error->status == status, "the status of the last error");
    require(
      error->message[0] != '\0' && error->text != nullptr && error->path != nullptr, "a message");
    require(status != GRANULAR_OTHER_ERROR, error->message);
  }
  return status == GRANULAR_OK;
}

/// Where the files of this process are, as long as it lives.
struct Folder
{
  std::filesystem::path path =
    std::filesystem::temp_directory_path() / ("fuzz_c_interface." + std::to_string(getpid()));

  Folder() { std::filesystem::create_directories(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path); }

  std::string of(const std::string& name) const { return (path / name).string(); }

  /// No input may find what one before has left.
  void clear() const
  {
    for (const auto& entry : std::filesystem::directory_iterator(path))
    {
      std::filesystem::remove_all(entry);
    }
  }
};

const Folder& folder()
{
  static const Folder all;
  return all;
}

/// One call: what it is, and what is chosen in it.
using Call = std::array<std::uint8_t, 8>;

template <class Table>
auto pick(const Table& table, std::uint8_t which)
{
  return table[which % std::size(table)];
}

/// Stops work after a few steps.
int stop(double fraction, void* user)
{
  require(fraction >= 0 && fraction <= 1, "a fraction");
  return --*static_cast<int*>(user) == 0 ? 1 : 0;
}

void take_notice(const granular_error* remark, void*)
{
  require(remark->message[0] != '\0' && remark->text[0] != '\0', "a notice");
}

/// All that the calls of an input have made so far.
class Session
{
public:
  explicit Session(std::string_view files)
    : file_(files.substr(0, files.find(next_file)))
  {
    folder().clear();
    this->write_file(file_);
    // the same as the files of several timesteps, and of several ranks
    std::size_t number = 0;
    for (std::size_t at = file_.size(); at < files.size(); ++number)
    {
      at += next_file.size();
      const std::string_view file = files.substr(at, files.find(next_file, at) - at);
      write_to("run_" + std::to_string(number + 2) + ".dump", file);
      write_to("parts_" + std::to_string(number) + ".dump", file);
      at += file.size();
    }
    if (number > 0)
    {
      write_to("parts_base.dump", file_);
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session()
  {
    granular_release(frame_);
    granular_release(other_);
    granular_close(run_);
  }

  void call(const Call& choice)
  {
    constexpr void (Session::*calls[])(const Call&) = { &Session::open, &Session::refresh,
      &Session::look, &Session::list, &Session::read, &Session::read_into, &Session::show,
      &Session::write_frame, &Session::write_arrays, &Session::find, &Session::close };
    (this->*calls[choice[0] % std::size(calls)])(choice);
  }

private:
  static void write_to(const std::string& name, std::string_view content)
  {
    std::ofstream(folder().of(name), std::ios::binary) << content;
  }

  void write_file(std::string_view content) { write_to("run_1.dump", content); }

  void open(const Call& choice)
  {
    constexpr double sizes[] = { 1, 1, 0.5, 1e300, 0, -1 };
    constexpr const char* columns[] = { nullptr, "", "id type x y z",
      "id type x y z ix iy iz vx vy vz radius", "x x" };
    constexpr const char* presets[] = { nullptr, "", "Automatic", "AsNamed", "no such preset" };
    constexpr const char* maps[] = { nullptr, nullptr, "", "id1 id2 force1 force2 force3",
      "1=id1 2=id2" };
    constexpr const char* styles[] = { nullptr, nullptr, "sphere", "granular", "full", "ellipsoid",
      "no such style" };
    granular_open_options options;
    granular_open_options_init(&options);
    options.kind = static_cast<granular_kind>(choice[1] % 16 < 8 ? -1 : choice[1] % 8 - 1);
    options.timestep_size = pick(sizes, choice[2]);
    options.column_names = pick(columns, choice[2] / 8);
    options.preset = pick(presets, choice[3]);
    options.column_map = pick(maps, choice[3] / 8);
    options.atom_style = pick(styles, choice[4]);
    options.repeated_steps = choice[5] % 3;
    options.threads = choice[6] % 3;
    left_ = choice[7];
    options.progress = choice[7] != 0 ? stop : nullptr;
    options.notice = take_notice;
    options.user = &left_;
    constexpr const char* patterns[] = { "run_1.dump", "run_*.dump", "parts_base.dump",
      "parts_%.dump" };
    const std::string first = folder().of(pick(patterns, choice[6] / 4));
    const std::string second = folder().of("run_1.dump");
    const char* const paths[] = { first.c_str(), second.c_str() };
    granular_close(run_);
    run_ = nullptr;
    if (ok(granular_open(paths, choice[6] / 16 % 3 == 2 ? 2 : 1, &options, &run_)))
    {
      require(run_ != nullptr, "a run");
    }
  }

  /// The file is another one, then again what it was.
  void refresh(const Call& choice)
  {
    const std::size_t size = file_.size() * choice[1] / 255;
    std::string other(file_.substr(0, size));
    if (choice[2] % 4 == 1)
    {
      other += file_;
    }
    else if (choice[2] % 4 == 2 && !other.empty())
    {
      other[other.size() * choice[3] / 256] ^= 1;
    }
    this->write_file(other);
    ok(granular_refresh(run_, nullptr, take_notice, &left_));
    this->look(choice);
    if (choice[4] % 2 == 0)
    {
      this->write_file(file_);
      ok(granular_refresh(run_, nullptr, take_notice, &left_));
    }
  }

  void look(const Call& choice)
  {
    granular_run_facts facts = {};
    if (!ok(granular_run_info(run_, &facts)))
    {
      return;
    }
    granular_frame_facts frame = {};
    const std::int64_t number = choice[1] % 8 - 4;
    if (ok(granular_frame_info(run_, number, &frame)))
    {
      require(frame.path[0] != '\0' && frame.rows >= -1, "facts of a frame");
      std::int64_t found = -1;
      ok(granular_find_frame(run_, frame.time, &found));
      require(found >= 0 && found < facts.frames, "a frame at a time");
    }
    granular_file_facts file = {};
    if (ok(granular_file_info(run_, choice[2] % 4 - 1, &file)))
    {
      require(file.bytes >= 0 && file.frames >= file.repeated && file.defect != nullptr,
        "facts of a file");
    }
  }

  std::vector<granular_array_facts> offered(std::int64_t frame, int table)
  {
    std::size_t count = 0;
    if (!ok(granular_arrays(run_, frame, table, nullptr, 0, &count)))
    {
      return {};
    }
    std::vector<granular_array_facts> arrays(count);
    require(ok(granular_arrays(run_, frame, table, arrays.data(), count, &count)) &&
        count == arrays.size(),
      "the same arrays again");
    return arrays;
  }

  void list(const Call& choice)
  {
    for (const granular_array_facts& array : this->offered(choice[1] % 4 - 2, choice[2] % 3))
    {
      require(array.name[0] != '\0' && array.components > 0, "an array");
      require(array.unit != nullptr && array.meaning != nullptr, "the meaning of an array");
    }
  }

  granular_request request_of(const Call& choice)
  {
    constexpr std::int64_t strides[] = { 1, 1, 1, 2, 3, 0, -1 };
    granular_request request;
    granular_request_init(&request);
    request.table = choice[2] % 4 == 1 ? 1 : choice[2] % 32 == 31 ? 2 : 0;
    request.points = choice[3] % 4 != 1;
    request.coordinates = static_cast<granular_coordinates>(choice[3] / 4 % 4);
    request.single_precision = choice[3] / 16 % 2;
    request.sort_by_id = choice[3] / 32 % 2;
    request.stride = pick(strides, choice[4]);
    request.origin[0] = choice[4] / 8 % 2;
    if (choice[4] / 16 % 2 == 1)
    {
      request.region[0] = -0.5;
      request.region[1] = 0.5;
    }
    request.threads = choice[5] % 4;
    left_ = choice[6];
    request.progress = choice[6] != 0 ? stop : nullptr;
    request.notice = take_notice;
    request.user = &left_;
    return request;
  }

  void read(const Call& choice)
  {
    granular_request request = this->request_of(choice);
    std::vector<const char*> names;
    if (choice[7] % 2 == 1)
    {
      for (const granular_array_facts& array : this->offered(choice[1] % 4 - 2, request.table))
      {
        names.push_back(array.name);
      }
      names.push_back(choice[7] % 8 == 7 ? "no such array" : "points");
      request.arrays = names.data();
      request.array_count = names.size();
    }
    std::swap(frame_, other_);
    granular_release(frame_);
    frame_ = nullptr;
    if (ok(granular_read(run_, choice[1] % 4 - 2, choice[7] == 2 ? nullptr : &request, &frame_)))
    {
      this->show(choice);
    }
  }

  /// Memory that has room for all, or for one value less, of any type.
  void read_into(const Call& choice)
  {
    constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 4 };
    constexpr std::int64_t most_rows = 100'000;
    const granular_request request = this->request_of(choice);
    const std::int64_t number = choice[1] % 4 - 2;
    granular_frame_facts facts = {};
    if (!ok(granular_frame_info(run_, number, &facts)) || facts.rows < 0 || facts.rows > most_rows)
    {
      return;
    }
    std::vector<granular_array_facts> arrays = this->offered(number, request.table);
    arrays.push_back({ "points", GRANULAR_FLOAT64, 3, 1, "", "", "" });
    std::vector<std::vector<char>> memory;
    std::vector<granular_destination> destinations;
    for (const granular_array_facts& array : arrays)
    {
      const auto type =
        static_cast<granular_type>(choice[7] % 2 == 1 ? array.type : choice[7] / 2 % 12);
      const std::size_t all =
        static_cast<std::size_t>(facts.rows) * static_cast<std::size_t>(array.components);
      const std::size_t values = all - std::min<std::size_t>(all, choice[7] / 32 == 7 ? 1 : 0);
      memory.emplace_back(values * pick(sizes, static_cast<std::uint8_t>(type)));
      destinations.push_back({ array.name, type, memory.back().data(), values });
    }
    std::int64_t rows = 0;
    ok(granular_read_into(run_, number, &request, destinations.data(), destinations.size(), &rows));
    require(rows >= 0, "rows");
  }

  /// Every value, so that a sanitizer sees all of them.
  static void touch(const granular_array& array)
  {
    constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 4 };
    const std::size_t values =
      static_cast<std::size_t>(array.rows) * static_cast<std::size_t>(array.components);
    const auto* const bytes = static_cast<const unsigned char*>(array.data);
    unsigned sum = 0;
    for (std::size_t i = 0; i < values * sizes[array.type]; ++i)
    {
      sum += bytes[i];
    }
    for (std::size_t i = 0; array.type == GRANULAR_TEXT && i < values; ++i)
    {
      const auto word = static_cast<const std::int32_t*>(array.data)[i];
      require(
        word >= 0 && static_cast<std::size_t>(word) < array.word_count, "the number of a word");
      sum += static_cast<unsigned>(array.words[word][0]);
    }
    static unsigned sink;
    sink += sum; // so that the loops are not left out
    require(sink != 1u || sum <= sink, "a sum");
  }

  std::vector<granular_array> arrays_of_frame()
  {
    granular_frame_header header = {};
    std::vector<granular_array> arrays;
    if (!ok(granular_header(frame_, &header)))
    {
      return arrays;
    }
    for (std::size_t i = 0; i < header.arrays; ++i)
    {
      arrays.emplace_back();
      require(ok(granular_array_at(frame_, i, &arrays.back())), "an array of a frame");
      require(arrays.back().rows == header.rows, "the rows of an array");
    }
    return arrays;
  }

  void show(const Call& choice)
  {
    for (const granular_array& array : this->arrays_of_frame())
    {
      touch(array);
      granular_array named = {};
      require(ok(granular_array_named(frame_, array.name, &named)), "an array by its name");
    }
    granular_array none = {};
    ok(granular_array_at(frame_, choice[1], &none));
    ok(granular_array_named(frame_, choice[2] % 2 == 0 ? "" : "no such array", &none));
  }

  granular_writer* create(const Call& choice)
  {
    constexpr const char* names[] = { "out.dump", "out.bin", "out.dump.gz", "out.zst", "out.bonds",
      "out.euler", "out.decomposition", "out_*.dump", "no such folder/out" };
    constexpr const char* styles[] = { nullptr, nullptr, "custom", "atom", "local", "euler",
      "decomposition", "none" };
    constexpr const char* dialects[] = { nullptr, "LIGGGHTS", "LAMMPS", "Automatic", "PUBLIC",
      "INL", "Wide", "none" };
    constexpr const char* columns[] = { nullptr, nullptr, nullptr, "id x y z", "id type xs ys zs",
      "none" };
    constexpr const char* numbers[] = { nullptr, "shortest", "%.17g", "%g", "%d" };
    granular_format format;
    granular_format_init(&format);
    format.style = pick(styles, choice[2]);
    format.dialect = pick(dialects, choice[3]);
    format.columns = pick(columns, choice[4]);
    format.numbers = pick(numbers, choice[4] / 8);
    format.label = choice[5] % 2 == 1 ? "CONTACTS" : nullptr;
    format.scaled = choice[5] / 2 % 2;
    format.image = choice[5] / 4 % 2;
    format.sort_by_id = choice[5] / 8 % 2;
    format.write_units = choice[5] / 16 % 2;
    format.write_time = choice[5] / 32 % 2;
    format.threads = choice[6] % 3;
    format.notice = take_notice;
    granular_writer* writer = nullptr;
    return ok(granular_create(folder().of(pick(names, choice[1])).c_str(), &format, &writer))
      ? writer
      : nullptr;
  }

  void write_frame(const Call& choice)
  {
    granular_writer* const writer = this->create(choice);
    if (writer == nullptr)
    {
      return;
    }
    ok(granular_write_frame(writer, frame_));
    if (choice[7] % 4 == 1)
    {
      ok(granular_write_frame(writer, other_));
    }
    if (choice[7] % 4 == 2)
    {
      granular_abandon(writer);
      return;
    }
    ok(granular_finish(writer));
  }

  void write_arrays(const Call& choice)
  {
    granular_writer* const writer = this->create(choice);
    if (writer == nullptr)
    {
      return;
    }
    granular_frame_header header = {};
    if (!ok(granular_header(frame_, &header)))
    {
      granular_abandon(writer);
      return;
    }
    const std::vector<granular_array> arrays = this->arrays_of_frame();
    granular_content content;
    granular_content_init(&content);
    content.timestep = header.timestep;
    content.rows = header.rows;
    content.box = choice[7] % 2 == 1 ? &header.box : nullptr;
    content.arrays = arrays.data();
    content.array_count = arrays.size() - std::min<std::size_t>(arrays.size(), choice[7] / 4 % 4);
    content.units = choice[7] / 2 % 2 == 1 ? "si" : nullptr;
    ok(granular_write(writer, &content));
    ok(granular_finish(writer));
    granular_box box = header.box;
    box.has_bounds = choice[7] % 2;
    ok(granular_complete_box(&box));
  }

  void find(const Call& choice)
  {
    constexpr const char* patterns[] = { "run_*.dump", "run_%.dump", "*", "none_*", "[a-z]*", "",
      "out*" };
    const std::string pattern = folder().of(pick(patterns, choice[1]));
    const char* const text = pattern.c_str();
    granular_names* names = nullptr;
    if (ok(granular_find_files(&text, 1, &names)))
    {
      for (std::size_t i = 0; i < granular_name_count(names); ++i)
      {
        require(granular_name_at(names, i)[0] != '\0', "a name");
      }
      granular_free_names(names);
    }
  }

  void close(const Call& choice)
  {
    if (choice[1] % 2 == 0)
    {
      granular_close(run_);
      run_ = nullptr;
    }
    granular_release(frame_);
    frame_ = nullptr;
  }

  std::string_view file_;
  granular_run* run_ = nullptr;
  granular_frame* frame_ = nullptr;
  granular_frame* other_ = nullptr;
  int left_ = 0; ///< steps before work is stopped
};

/// Where an input has no calls of its own.
constexpr Call usual[] = {
  { 0 },                                                   // open, by the contents
  { 2, 4, 1 },                                             // look at the first frame
  { 3, 2, 0 },                                             // list its arrays
  { 4, 2, 0, 0, 0, 2, 0 },                                 // read all of it on two threads
  { 7, 0 },                                                // write it as text
  { 7, 1, 2 },                                             // binary
  { 8, 0, 0, 2, 0, 0, 0, 1 }, { 4, 2, 0, 32, 0, 1, 0, 1 }, // all arrays, sorted
  { 5, 2, 0, 0, 0, 0, 0, 1 },                              // into memory
  { 4, 2, 1 },                                             // bonds
  { 7, 4, 4 },                                             // as local data
  { 1, 128, 0, 0, 0 },                                     // while the file grows
  { 4, 1 },                                                // the last frame
};

}

void granular::fuzz::mutate(std::string& bytes, Random& random, std::size_t most)
{
  const std::size_t end = bytes.rfind(separator);
  std::string file = bytes.substr(0, end);
  std::string calls = end == bytes.npos ? std::string() : bytes.substr(end + separator.size());
  if (one_in(random, 2))
  {
    mutate_bytes(file, std::max(file.size(), most) - calls.size() / 2);
  }
  else
  {
    if (calls.empty())
    {
      for (const Call& call : usual)
      {
        calls.append(reinterpret_cast<const char*>(call.data()), call.size());
      }
    }
    const std::size_t at = 8 * below(random, calls.size() / 8);
    switch (below(random, 4))
    {
      case 0:
        calls.erase(at, 8);
        break;
      case 1:
        calls.insert(at, std::string(calls, 8 * below(random, calls.size() / 8), 8));
        break;
      default:
        calls[std::min(calls.size() - 1, at + below(random, 8))] = static_cast<char>(random());
    }
  }
  bytes = calls.empty() ? file : file.append(separator) + calls;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  constexpr std::size_t most_calls = 32;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.rfind(separator);
  Session session(input.substr(0, end));
  if (end == input.npos)
  {
    for (const Call& call : usual)
    {
      session.call(call);
    }
    return 0;
  }
  const std::string_view calls = input.substr(end + separator.size());
  for (std::size_t at = 0; at + 8 <= calls.size() && at < 8 * most_calls; at += 8)
  {
    Call call;
    calls.copy(reinterpret_cast<char*>(call.data()), 8, at);
    session.call(call);
  }
  return 0;
}
