// Additive CCD of a vertex and a triangle, or of two edges (Li et al. 2021, Algorithm 1), in rounded double: no
// rounding makes a time late. No step asks it; it stands here for solvers that do, and for the judge.
//
// What is known empty is a slab: along a direction n every vertex of the one face stays above every vertex of the
// other by more than the error of the heights. Any n will do; of the few that are tried, across both faces and off the
// sides, the widest slab is taken. It says how far the faces are apart, which no speed closes sooner than gap/ℓ, and,
// held fixed, how long it stays empty, vertex by vertex: what slides past is not held up.
//
// Error, with ρ = 2⁻⁵³ and S the largest coordinate of `from` and `to`, each relative to vertex 0 of its own state:
// a coordinate at a time t ≤ 1 carries differences, a mean, a product and sums of at most 2 S, less than 14 ρ S; a
// height two such points, their difference and a scalar product with |n|₁ ≤ √3: less than 100 ρ S, and a rate times a
// time no more than 1 as much. 2⁻⁴⁵ S is more than both. The step is 0.9 of what is safe: that covers ‖n‖ and all else.
#pragma once

#include "compare/stages/ccd.hpp"
#include "fast/kernels/segment.hpp"

namespace ogc::fast {

using compare::CcdKind;

/// Beyond every time and every height.
inline constexpr double never = 1e300;

/// As compare::CcdCase stores it.
struct MovingFaces {
  CcdKind kind;        ///< a vertex 0 and a triangle 1 2 3, or edges 0 1 and 2 3
  Vec from[4], to[4];  ///< [m]
};

/// The motion relative to vertex 0 and to the mean displacement, which moves no face against the other.
class FaceMotion {
 public:
  OGC_HD explicit FaceMotion(const MovingFaces& faces) : split_(faces.kind == CcdKind::edge_edge ? 2 : 1) {
    double size = 0;
    for (int k = 0; k < 4; ++k) {
      start_[k] = difference<Rounded>(faces.from[k], faces.from[0]);
      const Real end = difference<Rounded>(faces.to[k], faces.to[0]);
      motion_[k] = end - start_[k];
      size = larger(size, larger(largest(start_[k]), largest(end)));
    }
    const Real mean = Rounded{0.25} * (motion_[0] + motion_[1] + motion_[2] + motion_[3]);
    double fastest[2] = {0, 0};
    for (int k = 0; k < 4; ++k) {
      motion_[k] = motion_[k] - mean;
      double& face = fastest[k < split_ ? 0 : 1];
      face = larger(face, squared(motion_[k]));
    }
    speed_ = add(square_root(fastest[0]), square_root(fastest[1]));
    error_ = mul(0x1p-45, size);
  }

  /// Empty between the faces at a time.
  struct Slab {
    double width = -1;  ///< not more than the distance; negative where none is known [m]
    Real normal{};
    Real x[4];  ///< positions then [m]
  };

  OGC_HD Slab slab(double time) const {
    Slab slab;
    for (int k = 0; k < 4; ++k) slab.x[k] = start_[k] + Rounded{time} * motion_[k];
    const Real(&x)[4] = slab.x;
    if (split_ == 2) {
      widen(slab, cross(x[1] - x[0], x[3] - x[2]));
      for (int end = 0; end < 2; ++end) {
        widen(slab, off_side(x[end], x[2], x[3]));
        widen(slab, -off_side(x[2 + end], x[0], x[1]));
      }
    } else {
      widen(slab, cross(x[2] - x[1], x[3] - x[1]));
      for (int k = 1; k < 4; ++k) widen(slab, off_side(x[0], x[k], x[k % 3 + 1]));
    }
    return slab;
  }

  /// How long after the slab's time the faces surely stay apart; `never` where nothing closes.
  OGC_HD double safe_time(const Slab& slab) const {
    double open = never;
    for (int i = 0; i < split_; ++i) {
      for (int j = split_; j < 4; ++j) {
        const double closing = dot(slab.normal, motion_[j] - motion_[i]).value;
        const double room = sub(dot(slab.normal, slab.x[i] - slab.x[j]).value, error_);
        if (closing > 0) open = smaller(open, divide(larger(room, 0.0), closing));
      }
    }
    return speed_ > 0 ? larger(open, divide(slab.width, speed_)) : open;
  }

 private:
  OGC_HD static double largest(const Real& a) {
    return larger(modulus(a.x.value), larger(modulus(a.y.value), modulus(a.z.value)));
  }

  /// From the closed segment ab to p.
  OGC_HD static Real off_side(const Real& p, const Real& a, const Real& b) {
    const Real e = b - a, w = p - a;
    const double ee = squared(e), s = divide(dot(w, e).value, ee);
    return ee > 0 ? w - Rounded{smaller(larger(s, 0.0), 1.0)} * e : w;
  }

  /// Takes the slab across ±direction if it is wider. A direction is scaled before its square can be lost.
  OGC_HD void widen(Slab& slab, const Real& direction) const {
    const double size = largest(direction);
    if (!(size > 0)) return;
    const Real scaled{direction.x / Rounded{size}, direction.y / Rounded{size}, direction.z / Rounded{size}};
    const Rounded length{square_root(squared(scaled))};
    const Real unit{scaled.x / length, scaled.y / length, scaled.z / length};
    double low = never, high = -never;
    for (int i = 0; i < split_; ++i) {
      for (int j = split_; j < 4; ++j) {
        const double height = dot(unit, slab.x[i] - slab.x[j]).value;
        low = smaller(low, height);
        high = larger(high, height);
      }
    }
    if (sub(low, error_) > slab.width) slab.width = sub(low, error_), slab.normal = unit;
    if (sub(-high, error_) > slab.width) slab.width = sub(-high, error_), slab.normal = -unit;
  }

  int split_;  ///< number of vertices of the first face
  Real start_[4], motion_[4];
  double error_ = 0, speed_ = 0;
};

/// A time in [0, 1] before which the faces share no point; 1 where nothing is in the way, 0 where no gap can be told
/// from rounding at the start. It ends where a tenth of the first gap is left.
OGC_HD inline float impact_time(const MovingFaces& faces) {
  constexpr int most_steps = 4096;  // each is safe: an end here only comes early
  const FaceMotion motion(faces);
  double time = 0, first_gap = 0;
  for (int step = 0; step < most_steps; ++step) {
    const FaceMotion::Slab slab = motion.slab(time);
    if (step == 0) first_gap = slab.width;
    if (!(slab.width > 0) || (step > 0 && slab.width < mul(compare::ccd_gap_left, first_gap))) break;
    const double next = add(time, mul(0.9, motion.safe_time(slab)));
    if (next >= 1) return 1;
    if (!(next > time)) break;
    time = next;
  }
  return round_down(time);
}

}  // namespace ogc::fast
