#include "experiments/program/runs/jitter.hpp"

#include "compare/judge/cases/random.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::experiments {

void check_jitter(const Jitter& jitter, const compare::Settings& settings) {
  if (10 * jitter.largest < settings.contact_radius) return;
  throw compare::InputError("--jitter " + compare::shortest(jitter.largest) +
                            ": give less than a tenth of contact_radius, here " +
                            compare::shortest(settings.contact_radius / 10) +
                            " m: larger offsets bring surfaces together that are 0.35 r apart, and the start would be "
                            "another scene's");
}

void add_jitter(const Jitter& jitter, const compare::Scene& scene, std::vector<compare::Vec3f>& positions) {
  const auto largest = static_cast<float>(jitter.largest);
  if (largest == 0) return;
  const std::vector<compare::Index> groups = rigid_groups(scene);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (groups[v] != -1) continue;
    compare::Random random("run", "jitter", jitter.seed, v);
    for (float* coordinate : {&positions[v].x, &positions[v].y, &positions[v].z}) {
      const auto offset = static_cast<float>(static_cast<double>(largest) * (2 * random.unit() - 1));
      *coordinate += offset;
    }
  }
}

}  // namespace ogc::experiments
