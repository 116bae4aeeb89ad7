// Lists boundaries in the order of visit_block. A boundary with the condition margin > 0 (`positive`) is open, a
// boundary with the condition margin ≤ 0 is closed.
#include "reference/definitions/block_margins.hpp"

namespace ogc::reference {

std::vector<BlockMargin> block_margins(const Complex& mesh, Face face, const Vec3f& x, float contact_radius,
                                       bool edge_only) {
  const Margin gap = face_gap(mesh, face, x, contact_radius);
  std::vector<BlockMargin> margins{{BlockMargin::Kind::sphere, face, -sign(gap), -signed_length(gap), true}};
  visit_block(mesh, face, x, [&](const Boundary& boundary) {
    const auto& [margin, positive] = boundary.condition;
    const bool wall = margin.kind == MarginKind::side;
    if (wall && edge_only) return true;
    const int inward = positive ? 1 : -1;
    margins.push_back({wall ? BlockMargin::Kind::wall : BlockMargin::Kind::end, boundary.across, inward * sign(margin),
                       inward * signed_length(margin), !positive});
    return true;
  });
  return margins;
}

}  // namespace ogc::reference
