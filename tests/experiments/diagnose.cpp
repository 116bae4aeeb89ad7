// Tests diagnoses of wrong answers: each wrong form differs from the truth and is recognised, planted faults get the
// name of their form, and a fault without a form gets no name.
#include <map>
#include <set>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/diagnose.hpp"
#include "compare/judge/report/report.hpp"
#include "compare/stages/activation.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/compare/judge/faults.hpp"

using namespace ogc;
using namespace ogc::compare;

namespace {

/// Adds failing cases if the judge found too few to name a form. This happens for rigid groups and solids, because few
/// meshes have them.
void look_for_more(Stage stage, const Contestant& contestant, const Authority& authority,
                   std::vector<TestCase>& failing) {
  for (const Generator& row : generators(stage))
    for (std::uint64_t i = 0; i < 100 && row.least == 0 && failing.size() < 2 * least_fits; ++i) {
      const Evidence one{generate({stage, std::string(row.name), 5, i, "", {}}), contestant};
      if (!agrees(one, authority)) failing.push_back(one.test);
    }
}

/// Returns the judge's diagnosis of this contestant after a short run.
Diagnosis diagnosis_of(Stage stage, const Contestant& contestant, const Authority& authority) {
  JudgeOptions options;
  options.cases = is_mesh_stage(stage) ? 1000 : 2000;
  options.batch = 1000;
  std::vector<TestCase> failing;
  for (const Mismatch& mismatch : judge_stage(stage, contestant, authority, options).tally.mismatches)
    if (failing.empty() || failing.back().name != mismatch.name) failing.push_back(generate(mismatch.name));
  if (failing.size() < least_fits) look_for_more(stage, contestant, authority, failing);
  return diagnose(stage, failing, contestant, authority, 1);
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Returns whether the diagnosis has this name, or lists it among the names that its cases do not distinguish from its
/// own.
bool names(const Diagnosis& diagnosis, const std::string& name) {
  return diagnosis.name == name ||
         std::find(diagnosis.as_well.begin(), diagnosis.as_well.end(), name) != diagnosis.as_well.end();
}

/// Returns `each` cases of each generator, with the contestant's answers.
std::vector<Evidence> evidence_of(Stage stage, const Contestant& contestant, std::uint64_t each) {
  std::vector<Evidence> all;
  for (const Generator& row : generators(stage))
    for (std::uint64_t i = 0; i < each && row.least == 0; ++i)
      all.push_back({generate({stage, std::string(row.name), 3, i, "", {}}), remembered(contestant)});
  return all;
}

/// Returns the number of failing cases in a longer run. In a short run few meshes have rigid groups or other rare
/// properties.
std::size_t failing_of_many(Stage stage, const Contestant& contestant, const Authority& authority) {
  JudgeOptions options;
  options.cases = 6000;
  return judge_stage(stage, contestant, authority, options).tally.mismatched;
}

/// Checks on a few cases that each wrong form is recognised and fails, for all stages with this CaseKind. Returns the
/// number of forms.
std::size_t check_forms(CaseKind kind) {
  const Authority authority = reference::authority();
  std::size_t forms = 0;
  for (const Stage stage : all_stages) {
    if (stage_info(stage).kind != kind) continue;
    const std::uint64_t each = is_mesh_stage(stage) ? 4 : 40;
    for (const WrongForm& form : tests::answering_forms(stage)) {
      const Contestant wrong = tests::contestant_of(form, authority);
      const std::vector<Evidence> answers = evidence_of(stage, wrong, each);
      std::size_t fits = 0, fails = 0;
      for (const Evidence& one : answers) {
        fits += form.fits(one, authority);
        fails += !agrees(one, authority);
      }
      INFO(stage_name(stage) << ": " << form.name << ", of " << answers.size() << " cases " << fits << " fit, " << fails
                             << " fail");
      // A few answers need not fit the form: they may overflow single precision, or the changed input may be close to a
      // jump.
      CHECK(static_cast<double>(fits) >= least_share * static_cast<double>(answers.size()));
      if (fails == 0) fails = failing_of_many(stage, wrong, authority);
      CHECK(fails > 0);
      ++forms;
    }
  }
  return forms;
}

}  // namespace

TEST_CASE("whoever answers as a wrong form says fits it in every case, and is wrong in some", "[agreement]") {
  CHECK(check_forms(CaseKind::single) > 150);
}
TEST_CASE("likewise of meshes", "[agreement]") { CHECK(check_forms(CaseKind::mesh) > 30); }
TEST_CASE("likewise of what follows the answer", "[agreement]") { CHECK(check_forms(CaseKind::followed) > 20); }

TEST_CASE("a right step is none of what its wrong forms say", "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant right = tests::exact_contestant(authority);
  for (const WrongForm& form : wrong_forms(Stage::step, {})) {
    INFO(form.name);
    CHECK(failing_of_many(Stage::step, right, form.wrong(authority)) > 0);
  }
}

TEST_CASE("no two wrong forms of a stage have the same name", "[unit]") {
  for (const Stage stage : all_stages) {
    std::set<std::string> seen;
    for (const WrongForm& form : wrong_forms(stage, {})) {
      INFO(stage_name(stage) << ": " << form.name);
      CHECK(seen.insert(form.name).second);
      CHECK_FALSE(form.meaning.empty());
    }
  }
}

TEST_CASE("planted faults that are known wrong forms are named, and others are not", "[agreement]") {
  const Authority authority = reference::authority();
  const std::map<std::string, std::string> expected{
      {"bound: 1 % too large", ""},
      {"truncate: flag inverted", "flag_inverted"},
      {"truncate: not truncated", "not_truncated"},
      {"truncate: stale position copied", "moved_back"},
      {"plane: balls in place of planes", "balls_alone"},
      {"plane: balls of all pairs beside the planes", "ball_of_all_pairs"},
      {"plane: vertices inside solids bounded", "inside_bounded"},
      {"plane: the second side bears no plane", ""},
      {"closest_points: no number for edges without length", "not_a_number"},
      {"contact_force: radius 0.01 % too large", ""},
      {"friction_force: force 0.1 % too small", ""},
      {"volume_depth: depth 0.01 % too large", ""},
      {"volume_force: force 0.1 % too small", ""},
      {"rod: force 0.01 % too small", ""},
      {"orientation: turned by 0.01 degrees about the director", ""},
      {"ccd: a millionth late", ""},
      {"barrier: 0.001 % too large", ""},
      {"membrane: force 0.1 % too small", ""},
      {"spring: force 0.1 % too small", ""},
      {"detect_vertex_facet: list of fixed capacity, overflow dropped", "contacts_capped_by_triangle"},
      {"detect_vertex_facet: no feasible-region test", ""},
  };
  std::size_t asked = 0;
  for (const tests::Fault& fault : tests::faults()) {
    const auto wanted = expected.find(fault.name);
    if (wanted == expected.end()) continue;
    ++asked;
    Contestant wrong = tests::exact_contestant(authority);
    fault.plant(wrong, authority);
    const Diagnosis diagnosis = diagnosis_of(fault.stage, wrong, authority);
    INFO(fault.name << ": " << diagnosis_text(diagnosis));
    CHECK(diagnosis.failing > 0);
    if (wanted->second.empty())
      CHECK(diagnosis.name.empty());
    else
      CHECK(names(diagnosis, wanted->second));
  }
  CHECK(asked == expected.size());
}

TEST_CASE("a form that fits too few of the failing cases is not named", "[agreement]") {
  const Authority authority = reference::authority();
  const auto right = tests::exact_contestant(authority).activation;
  // In a third of the cases the answer uses the printed formula. In the others it is 37 % too stiff. So no form fits
  // enough cases.
  Contestant mixed = tests::exact_contestant(authority);
  mixed.activation = [right](const ActivationIn& in) {
    ActivationIn other = in;
    for (std::size_t i = 0; i < in.distance.size(); ++i) {
      const bool is_printed = static_cast<int>(1e6f * in.distance[i]) % 3 == 0;
      if (is_printed && in.activation[i] == ContactActivation::ogc)
        other.activation[i] = ContactActivation::ogc_as_printed;
      if (!is_printed) other.stiffness[i] *= 1.37f;
    }
    return right(other);
  };
  CHECK(diagnosis_of(Stage::activation, mixed, authority).name.empty());
  // Only one case is wrong, and it fits a form.
  Contestant once = tests::exact_contestant(authority);
  const TestCase test = generate({Stage::activation, "ladder.switch", 1, 7, "", {}});
  const auto& c = case_of<ActivationCase>(test.data);
  once.activation = [right, c](const ActivationIn& in) {
    ActivationIn other = in;
    for (std::size_t i = 0; i < in.distance.size(); ++i)
      if (in.distance[i] == c.distance && in.contact_radius[i] == c.contact_radius && in.stiffness[i] == c.stiffness)
        other.stiffness[i] *= 2;
    return right(other);
  };
  const Diagnosis diagnosis = diagnose(Stage::activation, {&test, 1}, once, authority, 1);
  CHECK(diagnosis.failing >= 1);
  CHECK(diagnosis.failing < least_fits);
  CHECK(diagnosis.name.empty());
}

TEST_CASE("where the failing cases have an input in common that right ones lack, it is named", "[agreement]") {
  const Authority authority = reference::authority();
  Contestant wrong = tests::exact_contestant(authority);
  wrong.contact_force = [right = wrong.contact_force](const ContactForceIn& in) {
    ForceOut out = right(in);
    for (std::size_t i = 0; i < in.cases.size(); ++i)
      if (in.cases[i].sides == ContactSides::edge_edge)
        out.force[i] = {-out.force[i].x, -out.force[i].y, -out.force[i].z};
    return out;
  };
  const Diagnosis diagnosis = diagnosis_of(Stage::contact_force, wrong, authority);
  INFO(diagnosis_text(diagnosis));
  CHECK(diagnosis.where == "sides is edge_edge");
  CHECK(diagnosis.name == "flipped_sign");
  CHECK(diagnosis.otherwise > 0);  // some failing cases contradict the form, which is reported
}

TEST_CASE("whoever answers as a form is told its name", "[agreement]") {
  const Authority authority = reference::authority();
  const std::vector<std::pair<Stage, std::vector<std::string>>> mistakes{
      {Stage::closest_face,
       {"weights_rotated_120", "weights_rotated_201", "corners_swapped_01", "weights_swapped_on_edge_20",
        "first_edge_of_12_20_01_for_the_nearest", "edge_01_for_the_nearest", "corner_for_the_nearest",
        "edge_of_the_nearest_line", "signs_choose_the_feature", "weights_clamped", "areas_without_signs",
        "areas_add_up_to_1e-5", "areas_add_up_to_a_share_of_1e-3", "areas_of_the_point_for_the_foot",
        "weights_swapped_01", "floor_1e-5_of_distance_alone", "distance_below_is_zero"}},
      {Stage::closest_points,
       {"first_ends_swapped", "nearly_parallel_where_cross_product_below_1e-6", "start_where_cross_product_below_1e-8",
        "parallel_rule_missing"}},
      {Stage::detect_vertex_facet, {"one_ring_left_out"}},
      {Stage::detect_edge_edge, {"edges_swapped"}},
      {Stage::bound, {"half", "edge_minima_missing", "triangle_minima_missing"}},
      {Stage::plane, {"groups_ignored", "excluded_pairs_ignored"}},
      {Stage::activation, {"ogc_for_every_activation", "constant_missing"}},
      {Stage::contact_force,
       {"triangle_weights_rotated_120", "mollifier_below_1e-8", "mollifier_missing", "overlap_share_missing",
        "mollifier_of_present_edges", "sides_exchanged", "block_ends_at_radius"}},
      {Stage::friction_force,
       {"ones_for_identity", "triangle_weights_swapped_12", "slip_since_now", "mollifier_missing"}},
      {Stage::volume_depth, {"radius_missing_inside"}},
      {Stage::volume_force,
       {"ones_for_identity", "weights_swapped_01", "direction_flipped", "slip_since_now", "slip_of_the_point_alone",
        "friction_missing"}},
      {Stage::membrane,
       {"damping_missing", "gradients_exchanged", "hessian_diagonal_alone", "st_venant_kirchhoff_for_every_model",
        "damping_of_strains_for_every_form"}},
      {Stage::bending, {"rest_angle_flipped", "hessian_halved", "weights_exchanged", "discrete_hinge_for_every_model"}},
      {Stage::spring, {"ones_for_identity", "rest_length_missing", "damping_missing", "ratio_exchanged"}},
      {Stage::rod, {"conjugate_frame", "old_frame_read"}},
      {Stage::orientation, {"rest_transposed", "half_the_bend", "as_published"}},
      {Stage::sweep, {"contacts_missing"}},
      {Stage::ccd, {"edges_skipped_where_cross_product_below_1e-8", "never", "parallel_edges_skipped"}},
      {Stage::barrier, {"flipped_sign", "curvature_without_last_term"}}};
  for (const auto& [stage, wanted] : mistakes) {
    const std::vector<WrongForm> forms = wrong_forms(stage, {});
    for (const std::string& name : wanted) {
      const auto form = std::ranges::find(forms, name, &WrongForm::name);
      REQUIRE(form != forms.end());
      const Diagnosis diagnosis = diagnosis_of(stage, tests::contestant_of(*form, authority), authority);
      INFO(stage_name(stage) << ": " << name << ": " << diagnosis_text(diagnosis));
      CHECK(names(diagnosis, name));
    }
  }
}

TEST_CASE("of two mistakes at once both are named", "[agreement]") {
  const Authority authority = reference::authority();
  const std::vector<WrongForm> forms = wrong_forms(Stage::friction_force, {});
  const auto form = [&](const std::string& name) {
    return std::ranges::find_if(forms, [&](const WrongForm& one) { return one.name == name; })->wrong;
  };
  const Authority one = form("ones_for_identity")(authority), both = form("ogc_for_every_activation")(one);
  const Diagnosis diagnosis = diagnosis_of(Stage::friction_force, tests::exact_contestant(both), authority);
  INFO(diagnosis_text(diagnosis));
  CHECK(diagnosis.name == "ones_for_identity");
  REQUIRE_FALSE(diagnosis.seconds.empty());
  CHECK(diagnosis.seconds[0].name == "ogc_for_every_activation");
  CHECK(diagnosis.seconds[0].together);
  CHECK(says(diagnosis_text(diagnosis), "together with that"));
}

TEST_CASE("what happens to half of the failing cases and is no form's is not named", "[agreement]") {
  const Authority authority = reference::authority();
  Contestant wrong = tests::exact_contestant(authority);
  wrong.closest_face = [right = wrong.closest_face](const ClosestFaceIn& in) {
    ClosestFaceOut out = right(in);
    for (std::size_t i = 0; i < in.point.size(); ++i) out.distance[i] *= 1.01f + 0.1f * std::abs(in.point[i].x);
    return out;
  };
  const Diagnosis diagnosis = diagnosis_of(Stage::closest_face, wrong, authority);
  INFO(diagnosis_text(diagnosis));
  CHECK(diagnosis.failing > 100);
  CHECK(diagnosis.name.empty());
}

TEST_CASE("failures of few generators are said to be confined to them", "[unit]") {
  const auto tally_of = [](std::uint64_t passing, std::vector<std::string> failing) {
    Tally tally(Stage::closest_face);
    for (const std::string name : {"uniform", "bits", "lattice", "ladder.near"}) {
      tally.begin({Stage::closest_face, name, 1, 0, "", {}});
      tally.count(passing, passing, 0);
    }
    for (std::size_t i = 0; i < failing.size(); ++i) {
      tally.begin({Stage::closest_face, failing[i], 1, 0, "", {}});
      tally.count(5, 5, 0);
      for (std::size_t k = 0; k <= i; ++k) tally.mismatch("wrong");
    }
    return tally;
  };
  using Names = std::vector<std::string>;
  CHECK(tally_of(100, {}).confined_to().empty());
  CHECK(tally_of(100, {"ladder.needle"}).confined_to() == Names{"ladder.needle"});
  CHECK(tally_of(100, {"ladder.needle", "ladder.base"}).confined_to() == Names{"ladder.base", "ladder.needle"});
  CHECK(tally_of(100, {"ladder.needle", "ladder.base", "ladder.sliver", "ladder.offset"}).confined_to().empty());
  CHECK(tally_of(20, {"ladder.needle"}).confined_to().empty());  // too few cases pass for this conclusion
  CHECK(tally_of(100, {"uniform", "ladder.needle"}).confined_to() == Names{"ladder.needle", "uniform"});
  StageReport report{tally_of(100, {"ladder.needle"})};
  CHECK(says(report_table({&report, 1}),
             "all mismatches are in ladder.needle (1 in its 5 cases); the other 4 groups of cases pass"));
}
