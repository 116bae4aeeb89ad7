// truncate: the flag is exact, the truncated position lies on the sphere, everything else comes back unchanged.
#include "reference/geometry/truncate.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace ogc;
using compare::Vec3f;

TEST_CASE("truncate: a 3-4-5 displacement against bounds at, below and above its length", "[unit]") {
  compare::TruncateIn in;
  in.previous.assign(5, {1, 2, 7});
  in.position.assign(5, {4, 6, 7});
  in.position[4] = {1, 2, 7};
  in.bound = {5, std::nextafter(5.0f, 0.0f), 2.5f, 0, 0};
  const auto truth = reference::truncate(in);
  CHECK(truth.cut == std::vector<std::uint8_t>{0, 1, 1, 1, 0});
  CHECK(truth.grey == std::vector<std::uint8_t>{1, 1, 0, 0, 0});
  CHECK(truth.position[0] == compare::Vec3{4, 6, 7});
  CHECK(truth.position[2] == compare::Vec3{2.5, 4, 7});
  CHECK(truth.position[3] == compare::Vec3{1, 2, 7});
  CHECK(truth.position[4] == compare::Vec3{1, 2, 7});
}

TEST_CASE("truncate: truncated positions keep direction and have the bound's length", "[property]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> coordinate(-1, 1), exponent(-15, 5);
  compare::TruncateIn in;
  for (int i = 0; i < 2000; ++i) {
    const float scale = std::exp2(exponent(random));
    in.previous.push_back({coordinate(random), coordinate(random), coordinate(random)});
    in.position.push_back({in.previous.back().x + scale * coordinate(random),
                           in.previous.back().y + scale * coordinate(random), in.previous.back().z});
    in.bound.push_back(scale * 0.4f);
  }
  const auto truth = reference::truncate(in);
  int cut = 0;
  for (std::size_t i = 0; i < in.bound.size(); ++i) {
    const Vec3f &p = in.previous[i], &x = in.position[i];
    const double dx = truth.position[i].x - p.x, dy = truth.position[i].y - p.y, length = std::hypot(dx, dy);
    cut += truth.cut[i];
    if (truth.cut[i]) CHECK(length == Approx(in.bound[i]).margin(1e-15));
    if (!truth.cut[i]) CHECK(length <= in.bound[i]);
    const double turned = dx * (static_cast<double>(x.y) - p.y) - dy * (static_cast<double>(x.x) - p.x);
    const double rounding = 0x1p-52 * (std::abs(truth.position[i].x) + std::abs(truth.position[i].y));
    CHECK(std::abs(turned) <= rounding * std::hypot(x.x - p.x, x.y - p.y));
  }
  CHECK((cut > 500 && cut < 1950));
}
