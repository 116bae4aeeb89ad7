// Faults of membrane, bending, spring and tetrahedron.
#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

/// The right answer to a question that is changed first.
template <class In, class Change>
Fault asked_wrongly(const std::string& name, Stage stage, std::function<ForceOut(const In&)> Contestant::*which,
                    Change change) {
  return {name, stage, [which, change](Contestant& contestant, const Authority&) {
            contestant.*which = [right = contestant.*which, change](const In& in) {
              In other = in;
              for (auto& question : other.cases) change(question);
              return right(other);
            };
          }};
}

/// The right answer, spoiled case by case.
template <class In, class Spoil>
Fault spoiled(const std::string& name, Stage stage, std::function<ForceOut(const In&)> Contestant::*which,
              Spoil spoil) {
  return {name, stage, [which, spoil](Contestant& contestant, const Authority&) {
            contestant.*which = [right = contestant.*which, spoil](const In& in) {
              ForceOut out = right(in);
              for (std::size_t i = 0; i < out.force.size(); ++i) spoil(in.cases[i], out.force[i], out.block[i]);
              return out;
            };
          }};
}

void shorten(Vec3f& force) { force = {0.999f * force.x, 0.999f * force.y, 0.999f * force.z}; }

/// Whether what is apart at a stitch is 0 in single precision.
bool is_closed_by_rounding(const SpringCase& c) {
  const auto& [x, a, b] = c.vertex;
  const auto apart = [&](float Vec3f::*axis) { return x.*axis - a.*axis - c.ratio * (b.*axis - a.*axis); };
  return c.ratio > 0 && apart(&Vec3f::x) == 0 && apart(&Vec3f::y) == 0 && apart(&Vec3f::z) == 0;
}

}  // namespace

void add_right_forces(Contestant& exact, const Authority& authority) {
  exact.membrane = [authority](const MembraneIn& in) { return rounded(authority.membrane(in)); };
  exact.bending = [authority](const BendingIn& in) { return rounded(authority.bending(in)); };
  exact.spring = [authority](const SpringIn& in) { return rounded(authority.spring(in)); };
  exact.tetrahedron = [authority](const TetrahedronIn& in) { return rounded(authority.tetrahedron(in)); };
}

namespace {

std::vector<Fault> surface_faults() {
  return {
      asked_wrongly<MembraneIn>("membrane: damping forgotten", Stage::membrane, &Contestant::membrane,
                                [](MembraneCase& c) { c.damping = 0; }),
      asked_wrongly<MembraneIn>("membrane: gradients of two corners exchanged", Stage::membrane, &Contestant::membrane,
                                [](MembraneCase& c) { std::swap(c.gradient[0], c.gradient[1]); }),
      spoiled<MembraneIn>(
          "membrane: block overwritten by its diagonal", Stage::membrane, &Contestant::membrane,
          [](const MembraneCase&, Vec3f&, std::array<float, 6>& block) { block[1] = block[2] = block[4] = 0; }),
      spoiled<MembraneIn>("membrane: force 0.1 % too small", Stage::membrane, &Contestant::membrane,
                          [](const MembraneCase&, Vec3f& force, std::array<float, 6>&) { shorten(force); }),
      asked_wrongly<BendingIn>("bending: rest angle of the other sign", Stage::bending, &Contestant::bending,
                               [](BendingCase& c) { c.rest_angle = -c.rest_angle; }),
      asked_wrongly<BendingIn>("bending: opposite vertices exchanged", Stage::bending, &Contestant::bending,
                               [](BendingCase& c) { std::swap(c.vertex[2], c.vertex[3]); }),
      spoiled<BendingIn>("bending: half the stiffness in the block", Stage::bending, &Contestant::bending,
                         [](const BendingCase&, Vec3f&, std::array<float, 6>& block) {
                           for (float& b : block) b *= 0.5f;
                         }),
      spoiled<BendingIn>("bending: force 0.1 % too small", Stage::bending, &Contestant::bending,
                         [](const BendingCase&, Vec3f& force, std::array<float, 6>&) { shorten(force); }),
      asked_wrongly<MembraneIn>("membrane: St. Venant–Kirchhoff for every model", Stage::membrane,
                                &Contestant::membrane,
                                [](MembraneCase& c) { c.model = MembraneModel::st_venant_kirchhoff; }),
      spoiled<MembraneIn>("membrane: stable Neo-Hookean with λ for λ + μ", Stage::membrane, &Contestant::membrane,
                          [](const MembraneCase& c, Vec3f& force, std::array<float, 6>& block) {
                            if (c.model != MembraneModel::stable_neo_hookean) return;
                            const float share = c.lame_lambda / (c.lame_lambda + c.lame_mu);
                            force = {share * force.x, share * force.y, share * force.z};
                            for (float& b : block) b *= share;
                          }),
      asked_wrongly<MembraneIn>("membrane: damping of strains for that by vertex", Stage::membrane,
                                &Contestant::membrane, [](MembraneCase& c) { c.damping_form = DampingForm::strain; }),
      asked_wrongly<BendingIn>("bending: isometric weights of the wrong sides", Stage::bending, &Contestant::bending,
                               [](BendingCase& c) { std::swap(c.weight[1], c.weight[2]); }),
      asked_wrongly<BendingIn>("bending: a hinge for the isometric model", Stage::bending, &Contestant::bending,
                               [](BendingCase& c) { c.model = BendingModel::discrete_hinge; }),
      asked_wrongly<SpringIn>("spring: rest length forgotten", Stage::spring, &Contestant::spring,
                              [](SpringCase& c) { c.rest_length = 0; }),
      asked_wrongly<SpringIn>("spring: the nearer end of the edge for the point between", Stage::spring,
                              &Contestant::spring,
                              [](SpringCase& c) {
                                if (c.own < 2) c.ratio = 0;
                              }),
      asked_wrongly<SpringIn>("spring: weights of the edge's ends exchanged", Stage::spring, &Contestant::spring,
                              [](SpringCase& c) {
                                if (c.ratio > 0 && c.ratio < 1) c.ratio = 1 - c.ratio;
                              }),
      asked_wrongly<SpringIn>("spring: damping forgotten", Stage::spring, &Contestant::spring,
                              [](SpringCase& c) { c.damping = 0; }),
      spoiled<SpringIn>("spring: no stiffness across a stretched spring", Stage::spring, &Contestant::spring,
                        [](const SpringCase& c, Vec3f&, std::array<float, 6>& block) {
                          if (c.vertex[0].y == c.vertex[1].y && c.vertex[0].z == c.vertex[1].z) block[3] = block[5] = 0;
                        }),
      spoiled<SpringIn>("spring: force 0.1 % too small", Stage::spring, &Contestant::spring,
                        [](const SpringCase&, Vec3f& force, std::array<float, 6>&) { shorten(force); }),
      spoiled<SpringIn>("spring: no block where rounding closes a stitch with a rest length", Stage::spring,
                        &Contestant::spring,
                        [](const SpringCase& c, Vec3f&, std::array<float, 6>& block) {
                          if (c.rest_length > 0 && is_closed_by_rounding(c)) block = {};
                        }),
  };
}

std::vector<Fault> tetrahedron_faults() {
  constexpr auto which = &Contestant::tetrahedron;
  const auto asked = [](const char* name, auto change) {
    return asked_wrongly<TetrahedronIn>(std::string("tetrahedron: ") + name, Stage::tetrahedron, which, change);
  };
  return {
      asked("gradients transposed",
            [](TetrahedronCase& c) {
              for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t axis = 0; axis < k; ++axis) std::swap(c.gradient[k][axis], c.gradient[axis][k]);
            }),
      asked("λ for λ + μ", [](TetrahedronCase& c) { c.lame_lambda = std::max(0.0f, c.lame_lambda - c.lame_mu); }),
      asked("six times the volume",
            [](TetrahedronCase& c) {
              for (float& w : c.weight) w *= 6;
              c.inverse /= 6;
              c.volume *= 6;
            }),
      spoiled<TetrahedronIn>("tetrahedron: the other sign of g", Stage::tetrahedron, which,
                             [](const TetrahedronCase& c, Vec3f& force, std::array<float, 6>&) {
                               // the part along n, turned round: what is left of the force is that of ‖F‖²
                               Vec3f stretch{};
                               for (std::size_t k = 0; k < 3; ++k) {
                                 stretch.x -= c.lame_mu * c.weight[k] * (c.corner[k + 1].x - c.corner[0].x);
                                 stretch.y -= c.lame_mu * c.weight[k] * (c.corner[k + 1].y - c.corner[0].y);
                                 stretch.z -= c.lame_mu * c.weight[k] * (c.corner[k + 1].z - c.corner[0].z);
                               }
                               force = {2 * stretch.x - force.x, 2 * stretch.y - force.y, 2 * stretch.z - force.z};
                             }),
      asked("damping on displacements", [](TetrahedronCase& c) { c.damping_form = DampingForm::per_vertex; }),
      asked("two corners exchanged", [](TetrahedronCase& c) { std::swap(c.corner[1], c.corner[2]); }),
      asked("J without the volume at rest", [](TetrahedronCase& c) { c.inverse = 1; }),
      asked("damping forgotten", [](TetrahedronCase& c) { c.damping = 0; }),
      asked("weights of two corners exchanged", [](TetrahedronCase& c) { std::swap(c.weight[0], c.weight[1]); }),
      spoiled<TetrahedronIn>(
          "tetrahedron: the block clamped to its diagonal", Stage::tetrahedron, which,
          [](const TetrahedronCase&, Vec3f&, std::array<float, 6>& block) { block[1] = block[2] = block[4] = 0; }),
      spoiled<TetrahedronIn>("tetrahedron: force 0.1 % too small", Stage::tetrahedron, which,
                             [](const TetrahedronCase&, Vec3f& force, std::array<float, 6>&) { shorten(force); }),
  };
}

}  // namespace

std::vector<Fault> force_faults() {
  std::vector<Fault> all = surface_faults();
  const std::vector<Fault> of_solids = tetrahedron_faults();
  all.insert(all.end(), of_solids.begin(), of_solids.end());
  return all;
}

}  // namespace ogc::tests
