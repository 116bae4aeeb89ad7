#include "experiments/scenes/solid_box.hpp"

namespace ogc::experiments {
namespace {

/// Orders of the axes x (0), y (1) and z (2) in paths from the lowest to the highest corner of a cell. The even
/// permutations come first; their tetrahedra have positive volume.
constexpr std::array<std::array<std::size_t, 3>, 6> paths{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
constexpr std::size_t even_paths = 3;

double between(double low, double high, compare::Index i, compare::Index count) {
  return low + (high - low) * i / (count - 1);
}

}  // namespace

compare::Mesh solid_box(const std::array<compare::Index, 3>& count, const compare::Vec3& low,
                        const compare::Vec3& high) {
  using compare::Index;
  compare::Mesh mesh;
  const std::array<Index, 3> step{count[1] * count[2], count[2], 1};
  for (Index i = 0; i < count[0]; ++i)
    for (Index j = 0; j < count[1]; ++j)
      for (Index k = 0; k < count[2]; ++k) {
        mesh.positions.push_back({between(low.x, high.x, i, count[0]), between(low.y, high.y, j, count[1]),
                                  between(low.z, high.z, k, count[2])});
        if (i + 1 == count[0] || j + 1 == count[1] || k + 1 == count[2]) continue;
        const Index a = i * step[0] + j * step[1] + k;
        for (std::size_t p = 0; p < paths.size(); ++p) {
          const Index b = a + step[paths[p][0]], c = b + step[paths[p][1]], d = c + step[paths[p][2]];
          mesh.tetrahedra.push_back(p < even_paths ? compare::Tetrahedron{a, b, c, d}
                                                   : compare::Tetrahedron{a, c, b, d});
        }
      }
  return mesh;
}

}  // namespace ogc::experiments
