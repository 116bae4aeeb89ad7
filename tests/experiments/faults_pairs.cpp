// Faults of closest_face and closest_points.
#include <cmath>
#include <limits>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

using SpoilFace = std::function<void(const ClosestFaceIn&, std::size_t, ClosestFaceOut&)>;
using SpoilPoints = std::function<void(const ClosestPointsIn&, std::size_t, ClosestPointsOut&)>;

Fault face_fault(const std::string& name, const SpoilFace& spoil) {
  return {name, Stage::closest_face, [spoil](Contestant& contestant, const Authority&) {
            contestant.closest_face = [right = contestant.closest_face, spoil](const ClosestFaceIn& in) {
              ClosestFaceOut out = right(in);
              for (std::size_t i = 0; i < in.point.size(); ++i) spoil(in, i, out);
              return out;
            };
          }};
}

Fault points_fault(const std::string& name, const SpoilPoints& spoil) {
  return {name, Stage::closest_points, [spoil](Contestant& contestant, const Authority&) {
            contestant.closest_points = [right = contestant.closest_points, spoil](const ClosestPointsIn& in) {
              ClosestPointsOut out = right(in);
              for (std::size_t i = 0; i < in.first.size(); ++i) spoil(in, i, out);
              return out;
            };
          }};
}

double length(const std::array<Vec3f, 2>& edge) {
  return std::hypot(double{edge[1].x} - edge[0].x, double{edge[1].y} - edge[0].y, double{edge[1].z} - edge[0].z);
}

EdgeFeature other_end(EdgeFeature feature) {
  return feature == EdgeFeature::end_0   ? EdgeFeature::end_1
         : feature == EdgeFeature::end_1 ? EdgeFeature::end_0
                                         : feature;
}

/// The edge of the triangle, or its first corner, whose weight an absolute tolerance took for zero.
TriangleFeature without_small_weights(const std::array<float, 3>& w, TriangleFeature feature) {
  if (feature != TriangleFeature::interior) return feature;
  if (w[2] < 1e-5f) return TriangleFeature::edge_01;
  if (w[0] < 1e-5f) return TriangleFeature::edge_12;
  return w[1] < 1e-5f ? TriangleFeature::edge_20 : feature;
}

}  // namespace

void add_right_pairs(Contestant& exact, const Authority& authority) {
  exact.closest_face = [authority](const ClosestFaceIn& in) { return authority.closest_face(in).exact; };
  exact.closest_points = [authority](const ClosestPointsIn& in) { return authority.closest_points(in).exact; };
}

std::vector<Fault> pair_faults() {
  return {
      face_fault(
          "closest_face: two weights swapped",
          [](const auto&, std::size_t i, ClosestFaceOut& out) { std::swap(out.weights[i][0], out.weights[i][1]); }),
      face_fault("closest_face: absolute tolerance 1e-5 on the weights",
                 [](const auto&, std::size_t i, ClosestFaceOut& out) {
                   out.feature[i] = without_small_weights(out.weights[i], out.feature[i]);
                 }),
      face_fault(
          "closest_face: distances never below 1e-5",
          [](const auto&, std::size_t i, ClosestFaceOut& out) { out.distance[i] = std::max(out.distance[i], 1e-5f); }),
      face_fault("closest_face: distance_below one ulp above the exact distance",
                 [](const auto&, std::size_t i, ClosestFaceOut& out) {
                   out.distance_below[i] = std::nextafter(out.distance_below[i], infinity);
                 }),
      face_fault("closest_face: distance_below always 0",
                 [](const auto&, std::size_t i, ClosestFaceOut& out) { out.distance_below[i] = 0; }),
      face_fault("closest_face: no number where the distance is 0",
                 [](const auto&, std::size_t i, ClosestFaceOut& out) {
                   out.distance[i] *= out.distance[i] / out.distance[i];
                 }),
      face_fault("closest_face: on a separating plane the interior wins",
                 [](const auto& in, std::size_t i, ClosestFaceOut& out) {
                   const auto& t = in.triangle[i];
                   if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) out.feature[i] = TriangleFeature::interior;
                 }),
      points_fault("closest_points: rule for nearly parallel edges ignored",
                   [](const auto&, std::size_t i, ClosestPointsOut& out) { out.nearly_parallel[i] = 0; }),
      points_fault("closest_points: ends of the second edge swapped",
                   [](const auto&, std::size_t i, ClosestPointsOut& out) {
                     out.second_feature[i] = other_end(out.second_feature[i]);
                   }),
      points_fault("closest_points: edges shorter than 3.2 mm taken for points",
                   [](const auto& in, std::size_t i, ClosestPointsOut& out) {
                     if (length(in.first[i]) < 3.2e-3 && out.first_feature[i] == EdgeFeature::interior)
                       out.first_feature[i] = EdgeFeature::end_0;
                   }),
      points_fault("closest_points: distance_below taken between the contact points of nearly parallel edges",
                   [](const auto&, std::size_t i, ClosestPointsOut& out) {
                     if (out.nearly_parallel[i]) out.distance_below[i] = std::nextafter(out.contact_distance[i], 0.0f);
                   }),
      points_fault("closest_points: no number for edges without length",
                   [](const auto& in, std::size_t i, ClosestPointsOut& out) {
                     if (length(in.second[i]) == 0) out.parameters[i][1] = std::numeric_limits<float>::quiet_NaN();
                   }),
  };
}

}  // namespace ogc::tests
