// Tests frames in NumPy's arrays: both orders of the numbers, the accepted names of arrays, one array for each frame,
// and damage. tests/experiments/program/commands/audit_frames.py tests files that NumPy itself writes.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <new>

#include "compare/files/frames/frame_array.hpp"
#include "compare/files/frames/mesh_sequence.hpp"
#include "compare/judge/cases/random.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/frames/written_arrays.hpp"
#include "tests/compare/files/fuzzing.hpp"
#include "tests/seeds.hpp"

using namespace ogc;
using namespace ogc::compare;
using namespace ogc::tests;

namespace {

constexpr int frames = 5, vertices = 4;

/// Returns a number that differs for each coordinate k of each vertex v in each frame f.
double coordinate(int f, int v, int k) { return 100 * f + 10 * v + k; }

/// Returns the array of `count` frames from `first` on, in Fortran or C order.
std::string positions(bool fortran, int first = 0, int count = frames) {
  std::vector<double> numbers(static_cast<std::size_t>(count * vertices * 3));
  for (int f = 0; f < count; ++f)
    for (int v = 0; v < vertices; ++v)
      for (int k = 0; k < 3; ++k)
        numbers[static_cast<std::size_t>(fortran ? f + count * (v + vertices * k) : (f * vertices + v) * 3 + k)] =
            coordinate(first + f, v, k);
  return npy("<f8", (count == 1 ? "" : std::to_string(count) + ", ") + std::to_string(vertices) + ", 3", fortran,
             raw(numbers));
}

/// Returns the array of the triangles (0, 1, 2) and (1, 2, 3).
std::string triangles(bool fortran) {
  return npy("<i4", "2, 3", fortran,
             raw(fortran ? std::vector<std::int32_t>{0, 1, 1, 2, 2, 3} : std::vector<std::int32_t>{0, 1, 2, 1, 2, 3}));
}

/// Reads all frames and checks that each has the numbers of `coordinate`.
void check_frames(MeshSequence& sequence, int count = frames) {
  REQUIRE(sequence.size() == static_cast<std::size_t>(count));
  for (int f = 0; f < count; ++f) {
    const Mesh mesh = sequence.next().mesh;
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}});
    REQUIRE(mesh.positions.size() == vertices);
    for (int v = 0; v < vertices; ++v) {
      const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
      CHECK((p.x == coordinate(f, v, 0) && p.y == coordinate(f, v, 1) && p.z == coordinate(f, v, 2)));
    }
  }
}

Mesh tied() {
  Mesh mesh{std::vector<Vec3>(vertices), {{0, 1, 2}, {1, 2, 3}}, {}};
  return mesh;
}

std::string refusal(const std::filesystem::path& file) {
  try {
    npz_sequence(file, nullptr);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("arrays in C and Fortran order give the same frames", "[unit]") {
  const Scratch scratch;
  const Mesh mesh = tied();
  for (const bool fortran : {false, true}) {
    check_frames(*npy_sequence({written(scratch / "a.npy", positions(fortran))}, &mesh));
    check_frames(*npz_sequence(
        written(scratch / "a.npz", zip({{"x.npy", positions(fortran)}, {"f.npy", triangles(!fortran)}})), nullptr));
    const auto one = npy_sequence({written(scratch / "one.npy", positions(fortran, 0, 1))}, &mesh);
    check_frames(*one, 1);
  }
}

TEST_CASE("a pass over an array in Fortran order gathers what fits, or one frame", "[unit]") {
  const Scratch scratch;
  const std::string bytes = positions(true).substr(128);
  for (const std::uint64_t room : {0, 1, 96, 97, 200, 384, 1000}) {
    int passes = 0;
    const ArrayOpener open = [&]() -> ByteSource {
      ++passes;
      return [&bytes, at = std::size_t{0}](std::span<char> part, const std::string&) mutable {
        std::copy_n(bytes.data() + at, part.size(), part.data());
        at += part.size();
      };
    };
    check_frames(
        *frame_array("array", {frames, vertices, ScalarType::float64, std::endian::little, true}, tied(), open, room));
    const auto each = std::max<std::uint64_t>(1, room / 96);  // a frame has 96 bytes
    CHECK(passes == static_cast<int>((frames + each - 1) / each));
  }
}

TEST_CASE("arrays are read by the names that people give them", "[unit]") {
  const Scratch scratch;
  const std::string x = positions(false), one = positions(false, 0, 1), f = triangles(false);
  for (const std::string name : {"positions", "x", "vertices", "points", "verts", "v", "V"})
    for (const std::string faces : {"triangles", "faces", "f", "F"}) {
      const std::string bytes = zip({{"betas.npy", npy("<f8", "1,", false, raw(std::vector<double>{1}))},
                                     {faces + ".npy", f},
                                     {name + ".npy", x}});
      check_frames(*npz_sequence(written(scratch / "named.npz", bytes), nullptr));
    }
  // The file of SMPL, a model of bodies, contains the rest shape among other arrays.
  const std::string smpl = zip({{"J_regressor.npy", one}, {"v_template.npy", one}, {"f.npy", f}});
  check_frames(*npz_sequence(written(scratch / "smpl.npz", smpl), nullptr), 1);
}

TEST_CASE("frames of one array each are read in natural order", "[unit]") {
  const Scratch scratch;
  const Mesh mesh = tied();
  for (const std::string stem : {"frame_", "frame", "arr_", "v_", "vertices", ""}) {
    std::vector<Member> members{{"f.npy", triangles(false)}};
    for (int k = 10; k >= 0; --k) members.push_back({stem + std::to_string(k) + ".npy", positions(false, k, 1)});
    const auto sequence = npz_sequence(written(scratch / "each.npz", zip(members)), nullptr);
    INFO(stem);
    CHECK(sequence->name(10) == stem + "10.npy");
    check_frames(*sequence, 11);
  }
  // numpy.savez(file, vertices, triangles) gives the arrays these names.
  check_frames(*npz_sequence(
      written(scratch / "two.npz", zip({{"arr_0.npy", positions(true)}, {"arr_1.npy", triangles(true)}})), nullptr));
  std::vector<std::filesystem::path> files{written(scratch / "F.npy", triangles(true))};
  for (int k = 0; k < frames; ++k)
    files.push_back(written(scratch / ("v" + std::to_string(k) + ".npy"), positions(k % 2 == 0, k, 1)));
  check_frames(*npy_sequence(files, nullptr));
  const std::vector<std::filesystem::path> alone(files.begin() + 1, files.end());
  check_frames(*npy_sequence(alone, &mesh));
  const Mesh faces = faces_in_arrays(files.front());
  check_frames(*npy_sequence(alone, &faces));
  // Some arrays may hold one frame and others several.
  const auto parts = npy_sequence({files[1], written(scratch / "rest.npy", positions(true, 1, 4))}, &mesh);
  CHECK(parts->name(4) == (scratch / "rest.npy").string() + ": frame 3");
  check_frames(*parts);
}

TEST_CASE("arrays that hold no frames are refused with what to do", "[unit]") {
  const Scratch scratch;
  const auto refused = [&](const std::vector<Member>& members) {
    return refusal(written(scratch / "refused.npz", zip(members)));
  };
  CHECK_THAT(refused({{"poses.npy", positions(false)}, {"f.npy", triangles(false)}}),
             ContainsSubstring("let it compute the vertices"));
  CHECK_THAT(refused({{"cloth.npy", positions(false)}}), ContainsSubstring("it holds cloth.npy"));
  CHECK_THAT(refused({{"v.npy", positions(false)}}), ContainsSubstring("--mesh"));
  CHECK_THAT(refused({{"v.npy", triangles(false)}, {"f.npy", triangles(false)}}), ContainsSubstring("whole numbers"));
  CHECK_THAT(refused({{"v.npy", npy("<f8", "1000000000000, 0, 3", false, "")}, {"f.npy", triangles(false)}}),
             ContainsSubstring("no vertex"));
  CHECK_THAT(refused({{"frame_0.npy", positions(false)},
                      {"frame_1.npy", npy("<f8", "3, 3", false, raw(std::vector<double>(9)))},
                      {"f.npy", triangles(false)}}),
             ContainsSubstring("accepted"));  // the faces of the second array are checked only when it is read
  std::string undecided = positions(false);
  undecided.replace(undecided.find("False"), 5, "Maybe");
  CHECK_THAT(refused({{"v.npy", undecided}, {"f.npy", triangles(false)}}), ContainsSubstring("Fortran order"));
}

TEST_CASE("an archive that announces more than deflate can pack is refused before memory is asked for", "[unit]") {
  const Scratch scratch;
  const std::string name = "v.npy", x = positions(false);
  std::string bytes = zip({{name, x}, {"f.npy", triangles(false)}});
  const std::string honest = word(x.size(), 4) + word(x.size(), 4), lie = word(x.size(), 4) + word(4'000'000'000, 4);
  for (std::size_t at = bytes.find(honest); at != std::string::npos; at = bytes.find(honest, at))
    bytes.replace(at, honest.size(), lie);
  const std::string said = refusal(written(scratch / "bomb.npz", bytes));
  CHECK_THAT(said, ContainsSubstring("4000000000 bytes from"));
  CHECK_THAT(said, ContainsSubstring("bomb.npz: 'v.npy'"));
}

namespace {

/// Limits this process to `more` bytes beyond its present memory while the object exists.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t more) {
    ::getrlimit(RLIMIT_AS, &before_);
    if (!limits_memory) return;
    // A thread that a library started with the program may allocate between measuring and limiting; OpenBLAS takes
    // 128 MiB. The limit would then be below what is in use, and every allocation would fail.
    for (std::size_t measured = 0, present = address_space(); present > measured; present = address_space()) {
      measured = present;
      rlimit now = before_;
      now.rlim_cur = std::min<rlim_t>(before_.rlim_max, measured + more);
      ::setrlimit(RLIMIT_AS, &now);
    }
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

/// Returns the bytes after one to four changes: changed bytes, repeated runs of bytes, changed digits in the header, or
/// a missing end.
std::string damaged(Random& random, std::string bytes) {
  for (int k = 1 + random.below(4); k > 0 && !bytes.empty(); --k) {
    const std::size_t at = random.bits() % bytes.size();
    switch (random.below(5)) {
      case 0: bytes[at] = static_cast<char>(random.below(256)); break;
      case 1: bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.below(8)); break;
      case 2: bytes.resize(at); break;
      case 3: bytes.insert(at, bytes.substr(random.bits() % bytes.size(), random.bits() % 40)); break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", std::min<std::size_t>(at, 90));
        if (digit != std::string::npos) bytes.replace(digit, 1, std::to_string(random.bits() >> random.below(64)));
      }
    }
  }
  return bytes;
}

/// Returns a damaged file: a single array, a damaged archive, or a whole archive of damaged arrays with right
/// checksums.
std::string damaged_file(Random& random, bool archive) {
  const bool fortran = random.one_in(2);
  if (!archive) return damaged(random, positions(fortran));
  std::vector<Member> members{{"v.npy", positions(fortran)}, {"f.npy", triangles(random.one_in(2))}};
  if (random.one_in(3)) members = {{"arr_0.npy", members[0].bytes}, {"arr_1.npy", members[1].bytes}};
  if (random.one_in(2)) return damaged(random, zip(members));
  std::string& bytes = members[random.bits() % 2].bytes;
  bytes = damaged(random, bytes);
  return zip(members);
}

/// Reads every frame of `cases` damaged files. Each file must give frames or an error that names the file.
void fuzz(std::uint64_t seed, int cases) {
  const std::filesystem::path memory = "/dev/shm";  // a disk is a hundred times slower
  const Scratch scratch(std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path());
  const Mesh mesh = tied();
  std::map<bool, int> read;
  const MemoryLimit limit(std::uint64_t{100} << 20);
  if (limits_memory) CHECK_THROWS_AS(std::vector<char>(std::size_t{120} << 20), std::bad_alloc);
  for (int i = 0; i < cases; ++i) {
    Random random("arrays", "damaged", seed, static_cast<std::uint64_t>(i));
    const bool archive = random.one_in(2);
    const auto file = written(scratch / (archive ? "f.npz" : "f.npy"), damaged_file(random, archive));
    std::string failed;
    try {
      const auto sequence = archive ? npz_sequence(file, &mesh) : npy_sequence({file}, &mesh);
      for (std::size_t f = 0; f < sequence->size(); ++f) sequence->next();
      ++read[true];
    } catch (const InputError& error) {
      ++read[false];
      if (!std::string(error.what()).starts_with(file.string())) failed = error.what();
    } catch (const std::exception& error) {
      failed = error.what();
    }
    if (failed.empty()) continue;
    FAIL_CHECK("seed " << seed << ", case " << i << ": " << failed);
    return;
  }
  CHECK(read[true] > cases / 100);  // some damage is harmless, because it hits bytes that are not read
  CHECK(read[false] > cases / 4);
}

}  // namespace

TEST_CASE("damaged arrays end in frames or in a refusal that names the file, within 100 MB", "[unit]") {
  fuzz(20261128, 4000);
}

TEST_CASE("damaged arrays of the day's seed end likewise", "[unit]") {
  fuzz(ogc::tests::daily_seed("damaged arrays"), 10'000);
}

// Run by hand when a reader changes: tests_compare "a million damaged arrays".
TEST_CASE("a million damaged arrays", "[.once]") { fuzz(1, 1'000'000); }
