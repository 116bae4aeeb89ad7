// Faults of contact_force and friction_force.
#include <cmath>

#include "tests/compare/judge/faults.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

using Spoil = std::function<void(const FrictionForceCase&, Vec3f&, std::array<float, 6>&)>;

Fault contact_asked(const std::string& name, const std::function<void(ContactForceCase&)>& change) {
  return {"contact_force: " + name, Stage::contact_force, [change](Contestant& contestant, const Authority&) {
            contestant.contact_force = [right = contestant.contact_force, change](const ContactForceIn& in) {
              ContactForceIn other = in;
              for (ContactForceCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

Fault friction_asked(const std::string& name, const std::function<void(FrictionForceCase&)>& change) {
  return {"friction_force: " + name, Stage::friction_force, [change](Contestant& contestant, const Authority&) {
            contestant.friction_force = [right = contestant.friction_force, change](const FrictionForceIn& in) {
              FrictionForceIn other = in;
              for (FrictionForceCase& c : other.cases) change(c);
              return right(other);
            };
          }};
}

Fault friction_spoiled(const std::string& name, const Spoil& spoil) {
  return {"friction_force: " + name, Stage::friction_force, [spoil](Contestant& contestant, const Authority&) {
            contestant.friction_force = [right = contestant.friction_force, spoil](const FrictionForceIn& in) {
              ForceOut out = right(in);
              for (std::size_t i = 0; i < in.cases.size(); ++i) spoil(in.cases[i], out.force[i], out.block[i]);
              return out;
            };
          }};
}

/// k'_c = τ k_c (τ − r)²: r/2 [m] times too much of the logarithmic stage. Between points, whose distance is at hand.
void as_printed(const ContactForceCase& c, Vec3f& force, std::array<float, 6>& block) {
  const Vec3f &p = c.vertex[0], &q = c.vertex[1];
  const double d = std::hypot(double{p.x} - q.x, double{p.y} - q.y, double{p.z} - q.z);
  if (c.sides != ContactSides::point_point || 2 * d >= c.contact_radius) return;
  const float factor = c.contact_radius / 2;
  force = {factor * force.x, factor * force.y, factor * force.z};
  for (float& b : block) b *= factor;
}

/// Nothing from d = r on, the block included, where no force is left.
ForceOut ending_at_radius(const ContactForceIn& in, const std::function<ForceOut(const ContactForceIn&)>& right) {
  ForceOut out = right(in);
  for (std::size_t i = 0; i < in.cases.size(); ++i)
    if (out.force[i] == Vec3f{}) out.block[i] = {};
  return out;
}

/// Of the point of a contact, whose weight is 1, for whatever vertex is asked about.
ForceOut of_the_point(const ContactForceIn& in, const std::function<ForceOut(const ContactForceIn&)>& right) {
  ContactForceIn other = in;
  for (ContactForceCase& c : other.cases)
    if (c.sides != ContactSides::edge_edge) c.own = 0;
  return right(other);
}

/// Rest lengths that are none, and not 0 either: e_k is 1.
void without_mollifier(ContactForceCase& c) {
  if (c.rest_squared[0] > 0) c.rest_squared = {-1, -1};
}

std::vector<Fault> contact_force_faults() {
  return {
      {"contact_force: Eq. 19 as printed", Stage::contact_force,
       [](Contestant& contestant, const Authority&) {
         contestant.contact_force = [right = contestant.contact_force](const ContactForceIn& in) {
           ForceOut out = right(in);
           for (std::size_t i = 0; i < in.cases.size(); ++i) as_printed(in.cases[i], out.force[i], out.block[i]);
           return out;
         };
       }},
      {"contact_force: block without the square of the weight", Stage::contact_force,
       [](Contestant& contestant, const Authority&) {
         contestant.contact_force = [right = contestant.contact_force](const ContactForceIn& in) {
           return ForceOut{right(in).force, of_the_point(in, right).block};
         };
       }},
      {"contact_force: no block from r on", Stage::contact_force,
       [](Contestant& contestant, const Authority&) {
         contestant.contact_force = [right = contestant.contact_force](const ContactForceIn& in) {
           return ending_at_radius(in, right);
         };
       }},
      contact_asked("weights of the two ends of an edge exchanged",
                    [](ContactForceCase& c) {
                      if (c.sides == ContactSides::edge_edge) c.own ^= 1;
                    }),
      contact_asked("weights of the two sides exchanged",
                    [](ContactForceCase& c) {
                      if (c.sides == ContactSides::edge_edge) c.own ^= 2;
                    }),
      contact_asked("mollifier forgotten", without_mollifier),
      contact_asked("share of the overlap forgotten",
                    [](ContactForceCase& c) {
                      if (c.rest_squared == std::array<float, 2>{}) c.rest_squared = {-1, -1};
                    }),
      contact_asked("mollifier of the present edges", [](ContactForceCase& c) { c.previous = c.vertex; }),
      contact_asked("edges in the wrong order, so that the middle of the overlap is taken on the other one",
                    [](ContactForceCase& c) {
                      if (c.sides != ContactSides::edge_edge) return;
                      c.vertex = {c.vertex[2], c.vertex[3], c.vertex[0], c.vertex[1]};
                      c.own ^= 2;
                      c.together = static_cast<std::uint8_t>((c.together & 3) << 2 | c.together >> 2);
                    }),
      contact_asked("block that knows nothing of vertices that are updated together",
                    [](ContactForceCase& c) { c.together = 0; }),
      contact_asked("radius 0.01 % too large", [](ContactForceCase& c) { c.contact_radius *= 1.0001f; }),
  };
}

std::vector<Fault> friction_force_faults() {
  return {
      friction_asked("1/y below the limit too", [](FrictionForceCase& c) { c.slip_limit *= 1e-3f; }),
      friction_asked("slip since now, not since the start of the step",
                     [](FrictionForceCase& c) { c.start = c.contact.vertex; }),
      friction_asked("block that knows nothing of vertices that are updated together",
                     [](FrictionForceCase& c) { c.contact.together = 0; }),
      friction_asked("normal force without the mollifier", [](FrictionForceCase& c) { without_mollifier(c.contact); }),
      friction_spoiled("I in place of T T^T",
                       [](const FrictionForceCase&, Vec3f&, std::array<float, 6>& block) {
                         const float half = (block[0] + block[3] + block[5]) / 2;
                         block = {half, 0, 0, half, 0, half};
                       }),
      friction_spoiled("motion along the normal not removed",
                       [](const FrictionForceCase& c, Vec3f& force, std::array<float, 6>& block) {
                         if (c.contact.sides != ContactSides::point_point) return;
                         const float strength = (block[0] + block[3] + block[5]) / 2,
                                     sign = c.contact.own == 0 ? -strength : strength;
                         const auto &x = c.contact.vertex, &s = c.start;
                         force = {sign * (x[0].x - s[0].x - x[1].x + s[1].x),
                                  sign * (x[0].y - s[0].y - x[1].y + s[1].y),
                                  sign * (x[0].z - s[0].z - x[1].z + s[1].z)};
                       }),
      friction_spoiled("force 0.1 % too small",
                       [](const FrictionForceCase&, Vec3f& force, std::array<float, 6>&) {
                         force = {0.999f * force.x, 0.999f * force.y, 0.999f * force.z};
                       }),
  };
}

}  // namespace

void add_right_contacts(Contestant& exact, const Authority& authority) {
  exact.contact_force = [authority](const ContactForceIn& in) { return rounded(authority.contact_force(in)); };
  exact.friction_force = [authority](const FrictionForceIn& in) { return rounded(authority.friction_force(in)); };
}

std::vector<Fault> contact_faults() {
  std::vector<Fault> all = contact_force_faults();
  const std::vector<Fault> friction = friction_force_faults();
  all.insert(all.end(), friction.begin(), friction.end());
  return all;
}

}  // namespace ogc::tests
