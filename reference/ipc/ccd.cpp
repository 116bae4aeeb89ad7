// Computes the truth of the stage ccd. The oracle decides without rounding when faces meet, as in audits, and shares no
// code with any contestant.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/oracle/first_meeting.hpp"
#include "reference/ipc/additive_ccd.hpp"
#include "reference/ipc/stages.hpp"

namespace ogc::reference {
namespace {

using compare::CcdCase;
using compare::CcdKind;

using Corners = std::array<Triple<double>, 4>;

double impact(const CcdCase& c) {
  compare::MovingPair pair{.kind = c.kind == CcdKind::edge_edge ? compare::MeetingKind::edge_edge
                                                                : compare::MeetingKind::vertex_triangle};
  for (std::size_t k = 0; k < 4; ++k) {
    pair.from[k] = {c.from[k].x, c.from[k].y, c.from[k].z};
    pair.to[k] = {c.to[k].x, c.to[k].y, c.to[k].z};
  }
  const auto met = compare::first_meeting(pair);
  return met ? met->low : std::numeric_limits<double>::infinity();
}

double largest_coordinate(const Corners& x, const Triple<double>& from) {
  double largest = 0;
  for (const Triple<double>& p : x)
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k] - from[k]));
  return largest;
}

/// Returns the distance between a point of one face and a point of the other, an upper limit of the faces' distance.
double distance_above(compare::ContactSides sides, const Corners& x) {
  const ClosestForm form = sides == compare::ContactSides::edge_edge ? closest_edges(x) : closest_form(sides, x);
  const Triple<double> apart = separation(form.weight, x);
  return std::sqrt(dot(apart, apart));
}

double early(const CcdCase& c) {
  const auto sides = c.kind == CcdKind::edge_edge ? compare::ContactSides::edge_edge
                                                  : compare::ContactSides::point_triangle;
  Corners x, delta;
  for (std::size_t k = 0; k < 4; ++k) {
    x[k] = {c.from[k].x, c.from[k].y, c.from[k].z};
    delta[k] = Triple<double>{c.to[k].x, c.to[k].y, c.to[k].z} - x[k];
  }
  const Triple<double> mean = 0.25 * (delta[0] + delta[1] + delta[2] + delta[3]);
  const double size = largest_coordinate(x, x[0]) + largest_coordinate(delta, mean);
  const double left = compare::ccd_gap_left * distance_above(sides, x) +
                      compare::ccd_resolution * compare::unit_roundoff * size;
  return additive_ccd(sides, x, delta, left, 1, compare::ccd_fewest_steps);
}

}  // namespace

compare::CcdTruth ccd_truth(const compare::CcdIn& in) {
  compare::CcdTruth truth;
  for (const CcdCase& c : in.cases) {
    truth.impact.push_back(impact(c));
    truth.early.push_back(truth.impact.back() == 0 ? 0 : early(c));
  }
  return truth;
}

}  // namespace ogc::reference
