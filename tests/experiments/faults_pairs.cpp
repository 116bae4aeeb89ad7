// Plants faults of closest_face and closest_points: an error in the last bit, a wrong feature, not-a-number.
#include <cmath>
#include <limits>

#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

template <class Spoil>
Fault face_fault(const std::string& name, Spoil spoil) {
  return spoiled("closest_face: " + name, &Contestant::closest_face,
                 [spoil](const ClosestFaceIn& in, ClosestFaceOut& out) {
                   for (std::size_t i = 0; i < in.point.size(); ++i) spoil(in, i, out);
                 });
}

template <class Spoil>
Fault points_fault(const std::string& name, Spoil spoil) {
  return spoiled("closest_points: " + name, &Contestant::closest_points,
                 [spoil](const ClosestPointsIn& in, ClosestPointsOut& out) {
                   for (std::size_t i = 0; i < in.first.size(); ++i) spoil(in, i, out);
                 });
}

EdgeFeature other_end(EdgeFeature feature) {
  return feature == EdgeFeature::end_0   ? EdgeFeature::end_1
         : feature == EdgeFeature::end_1 ? EdgeFeature::end_0
                                         : feature;
}

}  // namespace

std::vector<Fault> pair_faults() {
  return {face_fault("on a separating plane the interior wins",
                     [](const auto& in, std::size_t i, ClosestFaceOut& out) {
                       const auto& t = in.triangle[i];
                       if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) out.feature[i] = TriangleFeature::interior;
                     }),
          points_fault("ends of the second edge swapped, its parameter right",
                       [](const auto&, std::size_t i, ClosestPointsOut& out) {
                         out.second_feature[i] = other_end(out.second_feature[i]);
                       }),
          points_fault("distance_below taken between the contact points of nearly parallel edges",
                       [](const auto&, std::size_t i, ClosestPointsOut& out) {
                         if (out.nearly_parallel[i])
                           out.distance_below[i] = std::nextafter(out.contact_distance[i], 0.0f);
                       }),
          points_fault("no number for edges without length", [](const auto& in, std::size_t i, ClosestPointsOut& out) {
            if (in.second[i][0] == in.second[i][1]) out.parameters[i][1] = std::numeric_limits<float>::quiet_NaN();
          })};
}

}  // namespace ogc::tests
