#include "compare/judge/questions.hpp"

namespace ogc::compare {

ClosestFaceIn face_question(Cases cases) {
  ClosestFaceIn in;
  for (const TestCase& test : cases) {
    const auto& c = std::get<ClosestFaceCase>(test.data);
    in.point.push_back(c.point);
    in.triangle.push_back(c.triangle);
  }
  return in;
}

ClosestPointsIn points_question(Cases cases) {
  ClosestPointsIn in;
  for (const TestCase& test : cases) {
    const auto& c = std::get<ClosestPointsCase>(test.data);
    in.first.push_back(c.first);
    in.second.push_back(c.second);
  }
  return in;
}

ActivationIn activation_question(Cases cases) {
  ActivationIn in;
  for (const TestCase& test : cases) {
    const auto& c = std::get<ActivationCase>(test.data);
    in.distance.push_back(c.distance);
    in.contact_radius.push_back(c.contact_radius);
    in.stiffness.push_back(c.stiffness);
    in.activation.push_back(c.activation);
  }
  return in;
}

TruncateIn truncate_question(Cases cases) {
  TruncateIn in;
  for (const TestCase& test : cases) {
    const auto& c = std::get<TruncateCase>(test.data);
    in.previous.push_back(c.previous);
    in.position.push_back(c.position);
    in.bound.push_back(c.bound);
  }
  return in;
}

DetectIn detect_question(const TestCase& test) {
  const auto& c = std::get<MeshCase>(test.data);
  return {c.topology.get(),
          {c.rigid_groups, c.partners.rows() > 0 ? &c.partners : nullptr},
          c.positions,
          c.contact_radius,
          c.query_radius};
}

BoundIn bound_question(const TestCase& test) {
  const auto& c = std::get<BoundCase>(test.data);
  return {c.topology.get(), c.d_min_vertex, c.d_min_edge, c.d_min_triangle, c.bound_relaxation};
}

BlockIn block_question(const TestCase& test) {
  const auto& c = std::get<BlockCase>(test.data);
  return {c.topology.get(), c.positions, c.questions};
}

RestStateIn rest_question(const TestCase& test) {
  const auto& c = std::get<RestStateCase>(test.data);
  return {c.scene.get(), c.topology.get()};
}

StepIn step_question(const TestCase& test) {
  const auto& c = std::get<StepCase>(test.data);
  return {c.scene.get(), c.topology.get()};
}

}  // namespace ogc::compare
