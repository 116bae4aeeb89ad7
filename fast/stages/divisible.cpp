#include "fast/stages/divisible.hpp"

#include <string>

#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::fast {

void expect_divisible(const compare::Scene& scene) {
  const std::string remedy = "; run it on one device";
  if (compare::traits_of(scene.settings.bounds).has_planes)
    throw compare::InputError("several devices divide scenes with bounds=ball; this one has planes" + remedy);
  if (compare::has_volumes(scene))
    throw compare::InputError("several devices divide no scene with contacts of volumes" + remedy);
  if (compare::has_rods(scene)) throw compare::InputError("several devices divide no scene with rods" + remedy);
}

}  // namespace ogc::fast
