// Files of every format, damaged at random: each ends in a mesh or in a refusal that names it, within 100 MB over what
// the program has already. Cases run in processes of their own, under a limit on memory; a frozen seed tells of
// changes, and another, new each day and printed, of what nobody thought of. OGC_FUZZ_CASES sets how many of each file.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/meshes/msh.hpp"
#include "compare/files/meshes/obj.hpp"
#include "compare/files/meshes/ply.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "compare/record/vtp.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/meshes/samples.hpp"
#include "tests/seeds.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool limits_memory = false;  // its shadow is reserved address space
#else
constexpr bool limits_memory = true;
#endif
constexpr std::size_t most_memory = 100'000'000;  ///< [bytes] over what the program has

struct Sample {
  std::string name, bytes;
};

const Mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1.0 / 3}}, {{0, 1, 2}, {0, 2, 3}}, {{1, 3}}};

std::string base64(const std::string& bytes) {
  const std::string uri = base64_uri(bytes);
  return uri.substr(uri.find(',') + 1, uri.rfind('"') - uri.find(',') - 1);
}

/// A VTP file whose points are packed by zlib, in one block.
std::string packed_vtp() {
  std::string points;
  for (const Vec3& p : square.positions)
    for (const double x : {p.x, p.y, p.z}) append_number(points, x);
  std::string packed(compressBound(points.size()), '\0'), head;
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(points.data()),
           points.size());
  packed.resize(size);
  for (const std::size_t number : {std::size_t{1}, points.size(), std::size_t{0}, packed.size()})
    append_number(head, static_cast<std::uint32_t>(number));
  return "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\"><PolyData><Piece>"
         "<Points><DataArray type=\"Float64\" format=\"binary\">" +
         base64(head) + base64(packed) +
         "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3"
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys></Piece>"
         "</PolyData></VTKFile>";
}

std::vector<Sample> samples() {
  const Mesh cube = make_mesh(parse_polygon_mesh(cube_medit(), "m.mesh")).mesh;
  return {{"m.obj", "# made\n" + print_obj(square) + "f 1/1 2//1 -1 \\\n 4\n"},
          {"m.ply", print_ply(square, PlyEncoding::ascii)},
          {"m.ply", print_ply(square, PlyEncoding::binary)},
          {"m.off", square_off},
          {"m.stl", square_stl()},
          {"m.stl", binary_stl(2)},
          {"m.gltf", square_gltf()},
          {"m.glb", square_glb()},
          {"m.vtp", vtp_bytes({square, {4, 5, 6, 7}, {1, 2, 3}, {1, 0, 1}})},
          {"m.vtp", packed_vtp()},
          {"m.vtu", cube_vtu()},
          {"m.vtk", cube_vtk(false, false)},
          {"m.vtk", cube_vtk(false, true)},
          {"m.vtk", cube_vtk(true, false)},
          {"m.vtk", cube_vtk(true, true)},
          {"m.msh", print_msh(cube)},
          {"m.msh", binary_msh(false)},
          {"m.msh", binary_msh(true, std::endian::big)},
          {"m.mesh", cube_medit()}};
}

class Mutator {
 public:
  Mutator(std::string whole, std::mt19937_64& random) : bytes_(std::move(whole)), random_(random) {}

  /// One to four changes, one upon the other.
  std::string mutated() {
    for (std::size_t k = 1 + below(4); k-- > 0 && !bytes_.empty();) change();
    return bytes_;
  }

 private:
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  std::size_t place() { return below(bytes_.size()); }
  std::string part() { return bytes_.substr(place(), 1 + below(40)); }

  void change() {
    switch (below(9)) {
      case 0: bytes_[place()] ^= static_cast<char>(1U << below(8)); break;
      case 1: bytes_[place()] = static_cast<char>(below(256)); break;
      case 2: bytes_.resize(place()); break;
      case 3: bytes_.erase(place(), 1 + below(20)); break;
      case 4: bytes_.insert(place(), part()); break;
      case 5: bytes_.replace(place(), 1 + below(10), part()); break;
      case 6: binary_number(); break;
      default: word(); break;
    }
  }

  /// Four or eight bytes, as of a count that is out of all bounds.
  void binary_number() {
    constexpr std::array<std::uint64_t, 7> numbers{0,          1,           0x7fffffff,        0x80000000,
                                                   0xffffffff, 0x100000000, 0xffffffffffffffff};
    std::string raw;
    append_number(raw, numbers[below(numbers.size())], below(2) == 0 ? std::endian::little : std::endian::big);
    const std::size_t width = below(2) == 0 ? 4 : 8;
    bytes_.replace(place(), width, raw.substr(below(9 - width), width));
  }

  /// A number or a name in the text.
  void word() {
    constexpr std::array<const char*, 16> words{"4294967295", "-1",     "1e999", "nan",     "99999999999999999999", "0",
                                                "2147483648", "1.#INF", "1e300", "1e-320",  "400000000000",         "3",
                                                "\r",         "#",      "\\\n",  "16777217"};
    const std::size_t digit = bytes_.find_first_of("0123456789", place());
    const std::size_t begin = digit == std::string::npos ? place() : digit;
    const std::size_t end = std::min(bytes_.find_first_not_of("0123456789.-", begin), bytes_.size());
    bytes_.replace(begin, end - begin, words[below(words.size())]);
  }

  std::string bytes_;
  std::mt19937_64& random_;
};

/// What the program does with a mesh; empty, or what it must not have done.
std::string fault_of(const std::string& bytes, const std::string& name) {
  try {
    for (const MeshOptions& options : {MeshOptions{.rounded = true}, MeshOptions{.weld = true}}) {
      const LoadedMesh loaded = make_mesh(parse_polygon_mesh(bytes, name), options);
      if (describe(validate(loaded.mesh, 10, ElementNames(loaded.source))).size() > 100'000) return "tells too much";
    }
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (!text.starts_with(name + ": ")) return "is refused without its name: " + text;
    if (text.size() > 1000) return "is refused with " + std::to_string(text.size()) + " bytes of text";
  } catch (const std::exception& error) {
    return std::string("ends in ") + error.what();
  }
  return "";
}

using Judge = std::string (*)(const std::string& bytes, const std::string& name);

std::size_t address_space() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// In a process of its own; says on `out` which case it is at, and of the first that fails why. Never returns.
[[noreturn]] void run_cases(const Sample& sample, Judge judge, std::uint64_t seed, std::size_t cases, int out) {
  const auto say = [&](const std::string& text) {
    if (write(out, text.data(), text.size()) < 0) _exit(3);
  };
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGALRM}) std::signal(signal, SIG_DFL);  // not Catch's
  if (limits_memory) {
    const std::size_t most = address_space() + most_memory + 2 * sample.bytes.size();
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
  }
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < cases; ++i) {
    const std::string bytes = Mutator(sample.bytes, random).mutated();
    say("\n" + std::to_string(i) + " ");
    alarm(20);
    const std::string fault = judge(bytes, sample.name);
    if (fault.empty()) continue;
    say(fault);
    _exit(1);
  }
  _exit(0);
}

/// Empty where every case ends as it should.
std::string failure(const Sample& sample, Judge judge, std::uint64_t seed, std::size_t cases) {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) run_cases(sample, judge, seed, cases, ends[1]);
  close(ends[1]);
  std::string last;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = read(ends[0], buffer.data(), buffer.size())) > 0;) {
    last.append(buffer.data(), static_cast<std::size_t>(got));
    last.erase(0, std::min(last.rfind('\n'), last.size()));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "";
  last.erase(0, 1);
  return sample.name + ", seed " + std::to_string(seed) + ", case " + last + how;
}

void fuzz(std::uint64_t seed, std::size_t cases) {
  if (const char* given = std::getenv("OGC_FUZZ_CASES")) cases = std::strtoull(given, nullptr, 10);
  for (const Sample& sample : samples()) {
    REQUIRE(fault_of(sample.bytes, sample.name).empty());
    CHECK(failure(sample, fault_of, seed++, cases) == "");
  }
}

}  // namespace

TEST_CASE("a reader that takes too much memory, dies or complains about something else is found", "[unit]") {
  const Sample sample{"m.off", square_off};
  const auto greedy = [](const std::string&, const std::string& name) -> std::string {
    try {
      return std::string(most_memory + 50'000'000, 'x').substr(0, 0);
    } catch (const std::bad_alloc&) {
      return name + " takes too much";
    }
  };
  const auto dying = [](const std::string&, const std::string&) -> std::string { std::abort(); };
  if (limits_memory) CHECK(failure(sample, greedy, 7, 3) == "m.off, seed 7, case 0 m.off takes too much");
  CHECK_THAT(failure(sample, dying, 7, 3), Catch::Matchers::Contains("m.off, seed 7, case 0 signal"));
  CHECK(failure(sample, fault_of, 7, 3) == "");
  CHECK(fault_of("gone", "m.max") == "");  // refused by its name
}

TEST_CASE("damaged mesh files end in an answer or a named refusal, within 100 MB: a frozen seed", "[property]") {
  fuzz(51, 2000);
}

TEST_CASE("damaged mesh files end in an answer or a named refusal, within 100 MB: the seed of the day", "[property]") {
  fuzz(1000 * ogc::tests::daily_seed("damaged mesh files"), 10000);
}
