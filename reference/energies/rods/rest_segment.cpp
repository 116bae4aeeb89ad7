// Computes directions from exact differences, and everything else in extended precision (2⁻⁶⁴). A rod of 10⁵ segments
// loses at most 17 of these bits, so the results are right in single precision.
#include <cmath>
#include <limits>

#include "compare/problem/rods.hpp"
#include "reference/energies/rest_builder.hpp"
#include "reference/energies/rods/rod.hpp"
#include "reference/energies/rods/rod_terms.hpp"

namespace ogc::reference {
namespace {

using compare::Index;
using Wide = long double;
using Direction = Triple<Wide>;
using Frame = FourOf<Wide>;

constexpr double largest_scale = 0x1p20;

Frame normalised(const Frame& q) {
  const Wide length = std::sqrt(inner(q, q));
  Frame unit;
  for (std::size_t k = 0; k < 4; ++k) unit[k] = q[k] / length;
  return unit;
}

/// The smallest rotation from one direction to another. `factor` is the ratio of the rotation's error to the error of
/// the directions.
struct Turn {
  Frame rotation;
  double factor;  ///< 1/cos(θ/2)
};

/// Returns the smallest rotation between two directions at an angle θ. The vector (sin θ axis, 1 + cos θ) is 2 cos(θ/2)
/// times its quaternion.
Turn smallest_turn(const Direction& from, const Direction& to) {
  const Triple<Wide> across = cross(from, to);
  const Wide along = dot(from, to), one = std::sqrt(dot(from, from) * dot(to, to));
  const Frame twice{across[0], across[1], across[2], one + along};
  const Wide cosine = std::sqrt(inner(twice, twice)) / (2 * one);
  return {normalised(twice), static_cast<double>(1 / cosine)};
}

template <class T>
std::array<T, 4> numbers(const Frame& q) {
  std::array<T, 4> all;
  for (std::size_t k = 0; k < 4; ++k) all[k] = static_cast<T>(q[k]);
  return all;
}

const Frame half_turn{1, 0, 0, 0};  // about the first axis

class Rods {
 public:
  explicit Rods(RestBuilder& to)
      : to_(to), scene_(to.scene), numbers_(compare::rod_segments(scene_)), truth_(to.truth), frame_(numbers_.size()) {}

  void add() {
    add_lengths();
    find_neighbours();
    walk();
    for (std::size_t e = 0; e < numbers_.size(); ++e) add_neighbours(e);
  }

 private:
  compare::RestSegment& segment(std::size_t e) { return truth_.exact.segments[e]; }
  const compare::RodMaterial& material(std::size_t e) {
    return *scene_.bodies[static_cast<std::size_t>(segment(e).body)].material.rod;
  }

  Triple<Input> reacting(Inputs& inputs, std::size_t e) {
    return inputs.vector(single(to_.at(segment(e).end[1])), single(to_.at(segment(e).end[0])));
  }

  void add_lengths() {
    for (const Index edge : numbers_) {
      compare::RestSegment rest;
      rest.end = scene_.mesh.loose_edges[static_cast<std::size_t>(edge)];
      rest.body = to_.body_of_vertex[static_cast<std::size_t>(rest.end[0])];
      const Point<Exact> along = exact(to_.at(rest.end[1])) - exact(to_.at(rest.end[0]));
      direction_.push_back({number(along.x), number(along.y), number(along.z)});
      const Wide length = std::sqrt(dot(direction_.back(), direction_.back()));
      rest.length = static_cast<float>(length);
      truth_.exact.segments.push_back(rest);
      Inputs inputs;
      const Triple<Input> own = reacting(inputs, truth_.exact.segments.size() - 1);
      const double scale = unit_of(inputs, sqrt(dot(own, own)));
      length_.push_back(length);
      truth_.segment_length.push_back(static_cast<double>(length));
      truth_.segment_length_scale.push_back(scale);
      const compare::Body& owner = to_.body(rest.body);
      if (!owner.fixed) to_.add_mass(rest.end, owner.material.rod->density, length, scale);
    }
  }

  void find_neighbours() {
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> around(scene_.rest_positions.size());
    for (std::size_t e = 0; e < numbers_.size(); ++e)
      for (std::size_t end = 0; end < 2; ++end)
        around[static_cast<std::size_t>(segment(e).end[end])].push_back({e, end});
    for (const auto& here : around) {
      if (here.size() != 2) continue;
      for (std::size_t k = 0; k < 2; ++k)
        segment(here[k].first).neighbour[here[k].second] = static_cast<Index>(here[1 - k].first);
    }
  }

  /// Computes frames of the segments that follow segment `e` beyond its end `end`, one after the other, until a segment
  /// already has a frame.
  void follow(std::size_t e, std::size_t end) {
    while (segment(e).neighbour[end] >= 0) {
      const auto next = static_cast<std::size_t>(segment(e).neighbour[end]);
      if (has_frame(next)) return;
      const bool enters_first = segment(next).end[0] == segment(e).end[end];
      const bool agree = enters_first == (end == 1);
      Direction to = direction_[next];
      if (!agree)
        for (Wide& x : to) x = -x;
      const Turn turn = smallest_turn(direction_[e], to);
      const Frame moved = product(turn.rotation, frame_[e]);
      set(next, agree ? moved : product(moved, half_turn), truth_.segment_frame_scale[e] + turn.factor);
      e = next;
      end = enters_first ? 1 : 0;
    }
  }

  bool has_frame(std::size_t e) const { return truth_.segment_frame_scale[e] > 0; }
  void set(std::size_t e, const Frame& frame, double scale) {
    frame_[e] = normalised(frame);
    truth_.segment_frame_scale[e] = scale <= largest_scale ? scale : std::numeric_limits<double>::infinity();
    truth_.segment_orientation[e] = numbers<double>(frame_[e]);
    segment(e).orientation = numbers<float>(frame_[e]);
  }

  void walk() {
    truth_.segment_frame_scale.assign(numbers_.size(), 0);
    truth_.segment_orientation.resize(numbers_.size());
    const auto begin = [&](std::size_t e) {
      const Direction& d = direction_[e];
      if (d[0] == 0 && d[1] == 0 && d[2] < 0) return set(e, half_turn, 2);
      const Turn turn = smallest_turn({0, 0, 1}, d);
      set(e, turn.rotation, 1 + turn.factor);
    };
    for (const bool of_rings : {false, true})
      for (std::size_t e = 0; e < numbers_.size(); ++e) {
        const auto& near = segment(e).neighbour;
        if (has_frame(e) || (!of_rings && near[0] >= 0 && near[1] >= 0)) continue;
        begin(e);
        if (of_rings || near[1] >= 0)
          follow(e, 1);
        else
          follow(e, 0);
      }
  }

  void add_neighbours(std::size_t e) {
    std::array<double, 2> weight{}, scale{};
    std::array<std::array<double, 4>, 2> relative{};
    for (std::size_t end = 0; end < 2; ++end) {
      segment(e).relative[end] = {0, 0, 0, 0};
      if (segment(e).neighbour[end] < 0) continue;
      const auto f = static_cast<std::size_t>(segment(e).neighbour[end]);
      Inputs inputs;
      const Triple<Input> own = reacting(inputs, e), other = reacting(inputs, f);
      const Input mean = Input(0.5) * (sqrt(dot(own, own)) + sqrt(dot(other, other)));
      const Input answer = Input(4.0) * inputs.number(material(e).bend) / mean;
      scale[end] = unit_of(inputs, answer);
      const Wide exact = 4 * static_cast<Wide>(material(e).bend) / ((length_[e] + length_[f]) / 2);
      weight[end] = static_cast<double>(exact);
      segment(e).weight[end] = static_cast<float>(exact);
      const Frame between = end == 1 ? product(conjugate(frame_[e]), frame_[f])
                                     : product(conjugate(frame_[f]), frame_[e]);
      relative[end] = numbers<double>(between);
      segment(e).relative[end] = numbers<float>(between);
    }
    truth_.segment_weight.push_back(weight);
    truth_.segment_weight_scale.push_back(scale);
    truth_.segment_relative.push_back(relative);
  }

  RestBuilder& to_;
  const compare::Scene& scene_;
  std::vector<Index> numbers_;
  compare::RestStateTruth& truth_;
  std::vector<Direction> direction_;
  std::vector<Wide> length_;
  std::vector<Frame> frame_;
};

}  // namespace

void add_segments_at_rest(RestBuilder& to) { Rods(to).add(); }

}  // namespace ogc::reference
