// Tests Single, which may leave a sign undecided. Signs that it decides must be right at every scale, also if terms
// cancel or underflow.
#include "fast/kernels/predicates.hpp"

#include <cmath>
#include <random>

#include "tests/catch.hpp"

namespace {

using namespace ogc::fast;

/// Counts how often Single was certain, and how often it was certain but wrong.
struct Tally {
  int certain = 0, wrong = 0;

  template <class Polynomial>
  void add(const Polynomial& polynomial) {
    const Sign quick = polynomial.template value<Single>().sign();
    certain += quick.certain ? 1 : 0;
    wrong += quick.certain && quick.value != exact_sign_in_double(polynomial) ? 1 : 0;
  }
};

class Points {
 public:
  explicit Points(unsigned seed) : random_(seed) {}

  /// Draws generic points, points of a lattice, points near a line, or points with a nearly right angle; the last two
  /// are perturbed by 2⁻²⁹ … 1. Some are far from the origin. Sizes are 2⁻⁵⁰ … 2³⁰.
  void next(Vec (&x)[4], bool generic) {
    const int kind = generic ? 0 : static_cast<int>(random_() % 4);
    const float scale = std::ldexp(1.0F, generic ? -6 : static_cast<int>(random_() % 81) - 50),
                shift = random_() % 3 == 0 ? 100 * scale : 0.0F;
    for (Vec& p : x)
      p = kind == 1 ? Vec{integer(), integer(), integer()}
                    : Vec{uniform_(random_), uniform_(random_), uniform_(random_)};
    const float little = std::ldexp(1.0F, -static_cast<int>(random_() % 30));
    if (kind == 2) {
      for (int k = 2; k < 4; ++k) x[k] = x[0] + uniform_(random_) * (x[1] - x[0]) + little * x[k];
    }
    if (kind == 3) {
      const Vec e = x[1] - x[0];
      x[2] = x[0] + cross(e, x[3]) + little * x[2];
      x[3] = x[1] + cross(e, x[2]) + little * x[3];
    }
    for (Vec& p : x) p = scale * p + Vec{shift, shift, shift};
  }

 private:
  float integer() { return static_cast<float>(static_cast<int>(random_() % 5) - 2); }

  std::mt19937 random_;
  std::uniform_real_distribution<float> uniform_{-1, 1};
};

Tally tally(unsigned seed, int cases, bool generic) {
  Points points(seed);
  Tally tally;
  for (int k = 0; k < cases; ++k) {
    Vec x[4];
    points.next(x, generic);
    tally.add(End{x[2], x[0], x[1]});
    tally.add(Side{x[3], x[0], x[1], x[2]});
    tally.add(Receding{x[2], x[3], x[0], x[1]});
    tally.add(NearlyParallel{x[0], x[1], x[2], x[3]});
    tally.add(LineReach{x[2], x[0], x[1], 0.01F});
  }
  return tally;
}

}  // namespace

TEST_CASE("exact_sign: single precision is never certain of a wrong sign", "[property]") {
  const Tally all = tally(1, 400'000, false);
  CHECK(all.wrong == 0);
  CHECK(all.certain > 0);
}

TEST_CASE("exact_sign: single precision decides 999 of 1000 generic signs", "[property]") {
  CHECK(tally(2, 100'000, true).certain > 499'500);
}
