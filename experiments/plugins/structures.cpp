#include "experiments/plugins/structures.hpp"

#include <algorithm>
#include <utility>

namespace ogc::experiments {

namespace {

template <class S>
Structure structure_with(std::vector<Member> members) {
  return {detail::structure_name<S>(), sizeof(S), std::move(members)};
}

/// Returns a structure of which the worker writes nothing: an element of an array, or a value as a whole.
template <class S, auto... Members>
Structure element() {
  return structure_with<S>({field<Members>()...});
}

/// Returns the question of a stage with independent cases, all in one array.
template <class S>
Structure cases() {
  return structure_with<S>({value<&S::n, &QuestionSizes::cases>(), input<&S::cases>("n")});
}

}  // namespace

// ---- meshes

template <>
const Structure Described<ogc_rows>::structure = structure_with<ogc_rows>({input<&ogc_rows::offsets>("rows + 1"),
                                                                           input<&ogc_rows::items>("offsets[rows]")});

template <>
const Structure Described<ogc_topology>::structure = structure_with<ogc_topology>(
    {value<&ogc_topology::vertex_count, &QuestionSizes::vertices>(),
     value<&ogc_topology::edge_count, &QuestionSizes::edges>(),
     value<&ogc_topology::triangle_count, &QuestionSizes::triangles>(), input<&ogc_topology::edges>("edge_count"),
     input<&ogc_topology::triangles>("triangle_count"), input<&ogc_topology::triangle_edges>("triangle_count"),
     nested<&ogc_topology::vertex_edges>(), nested<&ogc_topology::vertex_triangles>(),
     nested<&ogc_topology::vertex_neighbours>(), nested<&ogc_topology::edge_triangles>(),
     nested<&ogc_topology::edge_opposite>()});

// ---- distances, contacts, bounds and impacts

template <>
const Structure Described<ogc_closest_face_in>::structure = structure_with<ogc_closest_face_in>(
    {value<&ogc_closest_face_in::n, &QuestionSizes::cases>(), input<&ogc_closest_face_in::point>("n"),
     input<&ogc_closest_face_in::triangle>("n")});

template <>
const Structure Described<ogc_closest_face_out>::structure = structure_with<ogc_closest_face_out>(
    {output<&ogc_closest_face_out::feature>(Per::item), output<&ogc_closest_face_out::weights>(Per::item),
     output<&ogc_closest_face_out::distance>(Per::item), output<&ogc_closest_face_out::distance_below>(Per::item)});

template <>
const Structure Described<ogc_closest_points_in>::structure = structure_with<ogc_closest_points_in>(
    {value<&ogc_closest_points_in::n, &QuestionSizes::cases>(), input<&ogc_closest_points_in::first>("n"),
     input<&ogc_closest_points_in::second>("n")});

template <>
const Structure Described<ogc_closest_points_out>::structure =
    structure_with<ogc_closest_points_out>({output<&ogc_closest_points_out::first_feature>(Per::item),
                                            output<&ogc_closest_points_out::second_feature>(Per::item),
                                            output<&ogc_closest_points_out::nearly_parallel>(Per::item),
                                            output<&ogc_closest_points_out::parameters>(Per::item),
                                            output<&ogc_closest_points_out::contact_distance>(Per::item),
                                            output<&ogc_closest_points_out::distance_below>(Per::item)});

template <>
const Structure Described<ogc_detect_in>::structure = structure_with<ogc_detect_in>(
    {nested<&ogc_detect_in::topology>(), input<&ogc_detect_in::rigid_groups>("vertex_count"),
     nested<&ogc_detect_in::excluded_partners>(), input<&ogc_detect_in::positions>("vertex_count"),
     value<&ogc_detect_in::contact_radius, &QuestionSizes::first>(),
     value<&ogc_detect_in::query_radius, &QuestionSizes::second>(),
     input<&ogc_detect_in::inside_solid>("vertex_count")});

template <>
const Structure Described<ogc_vertex_facet_contact>::structure =
    element<ogc_vertex_facet_contact, &ogc_vertex_facet_contact::vertex, &ogc_vertex_facet_contact::kind,
            &ogc_vertex_facet_contact::face, &ogc_vertex_facet_contact::owner>();

template <>
const Structure Described<ogc_detect_vertex_facet_out>::structure = structure_with<ogc_detect_vertex_facet_out>(
    {output<&ogc_detect_vertex_facet_out::contacts>(Per::one, List::vertex_facet),
     capacity<&ogc_detect_vertex_facet_out::capacity>(List::vertex_facet),
     count<&ogc_detect_vertex_facet_out::count>(List::vertex_facet),
     output<&ogc_detect_vertex_facet_out::d_min_vertex>(Per::vertex),
     output<&ogc_detect_vertex_facet_out::d_min_triangle>(Per::triangle)});

template <>
const Structure Described<ogc_edge_edge_contact>::structure =
    element<ogc_edge_edge_contact, &ogc_edge_edge_contact::first_kind, &ogc_edge_edge_contact::first_face,
            &ogc_edge_edge_contact::second_kind, &ogc_edge_edge_contact::second_face,
            &ogc_edge_edge_contact::first_edge, &ogc_edge_edge_contact::second_edge>();

template <>
const Structure Described<ogc_detect_edge_edge_out>::structure =
    structure_with<ogc_detect_edge_edge_out>({output<&ogc_detect_edge_edge_out::contacts>(Per::one, List::edge_edge),
                                              capacity<&ogc_detect_edge_edge_out::capacity>(List::edge_edge),
                                              count<&ogc_detect_edge_edge_out::count>(List::edge_edge),
                                              output<&ogc_detect_edge_edge_out::d_min_edge>(Per::edge)});

template <>
const Structure Described<ogc_bound_in>::structure = structure_with<ogc_bound_in>(
    {nested<&ogc_bound_in::topology>(), input<&ogc_bound_in::d_min_vertex>("vertex_count"),
     input<&ogc_bound_in::d_min_edge>("edge_count"), input<&ogc_bound_in::d_min_triangle>("triangle_count"),
     value<&ogc_bound_in::bounds_relaxation, &QuestionSizes::first>(),
     input<&ogc_bound_in::inside_solid>("vertex_count")});

template <>
const Structure Described<ogc_bound_out>::structure =
    structure_with<ogc_bound_out>({output<&ogc_bound_out::bound>(Per::vertex)});

template <>
const Structure Described<ogc_plane_in>::structure = structure_with<ogc_plane_in>(
    {nested<&ogc_plane_in::topology>(), input<&ogc_plane_in::rigid_groups>("vertex_count"),
     nested<&ogc_plane_in::excluded_partners>(), input<&ogc_plane_in::positions>("vertex_count"),
     input<&ogc_plane_in::is_fixed>("vertex_count"), value<&ogc_plane_in::query_radius, &QuestionSizes::first>(),
     value<&ogc_plane_in::bounds_relaxation, &QuestionSizes::second>(),
     input<&ogc_plane_in::inside_solid>("vertex_count")});

template <>
const Structure Described<ogc_vertex_plane>::structure =
    element<ogc_vertex_plane, &ogc_vertex_plane::vertex, &ogc_vertex_plane::kind, &ogc_vertex_plane::first,
            &ogc_vertex_plane::second, &ogc_vertex_plane::normal>();

template <>
const Structure Described<ogc_plane_out>::structure = structure_with<ogc_plane_out>(
    {output<&ogc_plane_out::planes>(Per::one, List::planes), output<&ogc_plane_out::offset>(Per::one, List::planes),
     capacity<&ogc_plane_out::capacity>(List::planes), count<&ogc_plane_out::count>(List::planes),
     output<&ogc_plane_out::bound>(Per::vertex)});

template <>
const Structure Described<ogc_half_space>::structure =
    element<ogc_half_space, &ogc_half_space::normal, &ogc_half_space::offset>();

template <>
const Structure Described<ogc_truncate_in>::structure = structure_with<ogc_truncate_in>(
    {value<&ogc_truncate_in::n, &QuestionSizes::cases>(), input<&ogc_truncate_in::previous>("n"),
     input<&ogc_truncate_in::position>("n"), input<&ogc_truncate_in::bound>("n"),
     input<&ogc_truncate_in::half_space_offsets>("n + 1"),
     input<&ogc_truncate_in::half_spaces>("half_space_offsets[n]"), input<&ogc_truncate_in::current>("n"),
     input<&ogc_truncate_in::block>("n"), input<&ogc_truncate_in::is_prescribed>("n")});

template <>
const Structure Described<ogc_truncate_out>::structure = structure_with<ogc_truncate_out>(
    {output<&ogc_truncate_out::position>(Per::item), output<&ogc_truncate_out::cut>(Per::item)});

template <>
const Structure Described<ogc_initial_guess_case>::structure =
    element<ogc_initial_guess_case, &ogc_initial_guess_case::start, &ogc_initial_guess_case::velocity,
            &ogc_initial_guess_case::acceleration, &ogc_initial_guess_case::time_step,
            &ogc_initial_guess_case::previous, &ogc_initial_guess_case::bound, &ogc_initial_guess_case::reserved>();

template <>
const Structure Described<ogc_initial_guess_in>::structure = cases<ogc_initial_guess_in>();

template <>
const Structure Described<ogc_initial_guess_out>::structure = structure_with<ogc_initial_guess_out>(
    {output<&ogc_initial_guess_out::target>(Per::item), output<&ogc_initial_guess_out::position>(Per::item),
     output<&ogc_initial_guess_out::cut>(Per::item)});

template <>
const Structure Described<ogc_block_question>::structure =
    element<ogc_block_question, &ogc_block_question::kind, &ogc_block_question::of, &ogc_block_question::face_kind,
            &ogc_block_question::face>();

template <>
const Structure Described<ogc_block_in>::structure = structure_with<ogc_block_in>(
    {nested<&ogc_block_in::topology>(), input<&ogc_block_in::positions>("vertex_count"),
     value<&ogc_block_in::n, &QuestionSizes::cases>(), input<&ogc_block_in::questions>("n")});

template <>
const Structure Described<ogc_block_out>::structure =
    structure_with<ogc_block_out>({output<&ogc_block_out::inside>(Per::item)});

template <>
const Structure Described<ogc_ccd_case>::structure =
    element<ogc_ccd_case, &ogc_ccd_case::kind, &ogc_ccd_case::from, &ogc_ccd_case::to>();

template <>
const Structure Described<ogc_ccd_in>::structure = cases<ogc_ccd_in>();

template <>
const Structure Described<ogc_ccd_out>::structure =
    structure_with<ogc_ccd_out>({output<&ogc_ccd_out::time>(Per::item)});

template <>
const Structure Described<ogc_volume_depth_in>::structure = structure_with<ogc_volume_depth_in>(
    {nested<&ogc_volume_depth_in::topology>(), input<&ogc_volume_depth_in::positions>("vertex_count"),
     value<&ogc_volume_depth_in::contact_radius, &QuestionSizes::first>(),
     value<&ogc_volume_depth_in::n, &QuestionSizes::cases>(), input<&ogc_volume_depth_in::points>("n")});

template <>
const Structure Described<ogc_volume_contact>::structure =
    element<ogc_volume_contact, &ogc_volume_contact::point, &ogc_volume_contact::inside, &ogc_volume_contact::triangle,
            &ogc_volume_contact::kind, &ogc_volume_contact::face>();

template <>
const Structure Described<ogc_volume_numbers>::structure = element<
    ogc_volume_numbers, &ogc_volume_numbers::weights, &ogc_volume_numbers::direction, &ogc_volume_numbers::depth>();

template <>
const Structure Described<ogc_volume_depth_out>::structure =
    structure_with<ogc_volume_depth_out>({output<&ogc_volume_depth_out::contacts>(Per::one, List::volume_contacts),
                                          output<&ogc_volume_depth_out::numbers>(Per::one, List::volume_contacts),
                                          capacity<&ogc_volume_depth_out::capacity>(List::volume_contacts),
                                          count<&ogc_volume_depth_out::count>(List::volume_contacts)});

// ---- energies and forces

template <>
const Structure Described<ogc_activation_in>::structure = structure_with<ogc_activation_in>(
    {value<&ogc_activation_in::n, &QuestionSizes::cases>(), input<&ogc_activation_in::distance>("n"),
     input<&ogc_activation_in::contact_radius>("n"), input<&ogc_activation_in::stiffness>("n"),
     input<&ogc_activation_in::activation>("n")});

template <>
const Structure Described<ogc_activation_out>::structure = structure_with<ogc_activation_out>(
    {output<&ogc_activation_out::energy>(Per::item), output<&ogc_activation_out::slope>(Per::item),
     output<&ogc_activation_out::curvature>(Per::item)});

template <>
const Structure Described<ogc_barrier_in>::structure = structure_with<ogc_barrier_in>(
    {value<&ogc_barrier_in::n, &QuestionSizes::cases>(), input<&ogc_barrier_in::squared_distance>("n"),
     input<&ogc_barrier_in::activation_distance>("n"), input<&ogc_barrier_in::thickness>("n")});

template <>
const Structure Described<ogc_barrier_out>::structure = structure_with<ogc_barrier_out>(
    {output<&ogc_barrier_out::energy>(Per::item), output<&ogc_barrier_out::slope>(Per::item),
     output<&ogc_barrier_out::curvature>(Per::item)});

template <>
const Structure Described<ogc_membrane_case>::structure =
    element<ogc_membrane_case, &ogc_membrane_case::corner, &ogc_membrane_case::start, &ogc_membrane_case::gradient,
            &ogc_membrane_case::area, &ogc_membrane_case::lame_lambda, &ogc_membrane_case::lame_mu,
            &ogc_membrane_case::damping, &ogc_membrane_case::model, &ogc_membrane_case::damping_form>();

template <>
const Structure Described<ogc_bending_case>::structure =
    element<ogc_bending_case, &ogc_bending_case::vertex, &ogc_bending_case::start, &ogc_bending_case::stiffness,
            &ogc_bending_case::rest_angle, &ogc_bending_case::damping, &ogc_bending_case::own, &ogc_bending_case::model,
            &ogc_bending_case::weight, &ogc_bending_case::damping_form>();

template <>
const Structure Described<ogc_spring_case>::structure =
    element<ogc_spring_case, &ogc_spring_case::vertex, &ogc_spring_case::start, &ogc_spring_case::stiffness,
            &ogc_spring_case::rest_length, &ogc_spring_case::damping, &ogc_spring_case::ratio, &ogc_spring_case::own,
            &ogc_spring_case::damping_form>();

template <>
const Structure Described<ogc_tetrahedron_case>::structure =
    element<ogc_tetrahedron_case, &ogc_tetrahedron_case::corner, &ogc_tetrahedron_case::start,
            &ogc_tetrahedron_case::weight, &ogc_tetrahedron_case::inverse, &ogc_tetrahedron_case::gradient,
            &ogc_tetrahedron_case::volume, &ogc_tetrahedron_case::lame_lambda, &ogc_tetrahedron_case::lame_mu,
            &ogc_tetrahedron_case::damping, &ogc_tetrahedron_case::damping_form>();

template <>
const Structure Described<ogc_contact_force_case>::structure =
    element<ogc_contact_force_case, &ogc_contact_force_case::sides, &ogc_contact_force_case::own,
            &ogc_contact_force_case::vertex, &ogc_contact_force_case::previous, &ogc_contact_force_case::rest_squared,
            &ogc_contact_force_case::contact_radius, &ogc_contact_force_case::stiffness,
            &ogc_contact_force_case::activation, &ogc_contact_force_case::together>();

template <>
const Structure Described<ogc_friction_force_case>::structure =
    element<ogc_friction_force_case, &ogc_friction_force_case::contact, &ogc_friction_force_case::start,
            &ogc_friction_force_case::friction, &ogc_friction_force_case::slip_limit>();

template <>
const Structure Described<ogc_volume_force_case>::structure = element<
    ogc_volume_force_case, &ogc_volume_force_case::own, &ogc_volume_force_case::vertex, &ogc_volume_force_case::start,
    &ogc_volume_force_case::weights, &ogc_volume_force_case::direction, &ogc_volume_force_case::contact_radius,
    &ogc_volume_force_case::stiffness, &ogc_volume_force_case::friction, &ogc_volume_force_case::slip_limit>();

template <>
const Structure Described<ogc_membrane_in>::structure = cases<ogc_membrane_in>();

template <>
const Structure Described<ogc_bending_in>::structure = cases<ogc_bending_in>();

template <>
const Structure Described<ogc_spring_in>::structure = cases<ogc_spring_in>();

template <>
const Structure Described<ogc_tetrahedron_in>::structure = cases<ogc_tetrahedron_in>();

template <>
const Structure Described<ogc_contact_force_in>::structure = cases<ogc_contact_force_in>();

template <>
const Structure Described<ogc_friction_force_in>::structure = cases<ogc_friction_force_in>();

template <>
const Structure Described<ogc_volume_force_in>::structure = cases<ogc_volume_force_in>();

template <>
const Structure Described<ogc_force_out>::structure =
    structure_with<ogc_force_out>({output<&ogc_force_out::force>(Per::item), output<&ogc_force_out::block>(Per::item)});

// ---- scenes

template <>
const Structure Described<ogc_hinge>::structure =
    element<ogc_hinge, &ogc_hinge::edge, &ogc_hinge::triangles, &ogc_hinge::opposite>();

template <>
const Structure Described<ogc_body>::structure = element<
    ogc_body, &ogc_body::first_vertex, &ogc_body::vertex_count, &ogc_body::first_triangle, &ogc_body::triangle_count,
    &ogc_body::first_tetrahedron, &ogc_body::tetrahedron_count, &ogc_body::fixed, &ogc_body::membrane,
    &ogc_body::bending, &ogc_body::density, &ogc_body::lame_lambda, &ogc_body::lame_mu, &ogc_body::membrane_damping,
    &ogc_body::bending_stiffness, &ogc_body::bending_damping, &ogc_body::contact_stiffness, &ogc_body::friction,
    &ogc_body::solid_density, &ogc_body::solid_lambda, &ogc_body::solid_mu, &ogc_body::solid_damping>();

template <>
const Structure Described<ogc_scene_spring>::structure =
    element<ogc_scene_spring, &ogc_scene_spring::vertex, &ogc_scene_spring::stiffness, &ogc_scene_spring::rest_length,
            &ogc_scene_spring::damping, &ogc_scene_spring::ratio>();

template <>
const Structure Described<ogc_settings>::structure =
    element<ogc_settings, &ogc_settings::time_step, &ogc_settings::contact_radius, &ogc_settings::detection_radius_cap,
            &ogc_settings::bounds_relaxation, &ogc_settings::detection_fraction, &ogc_settings::friction_velocity,
            &ogc_settings::settled_move, &ogc_settings::iterations, &ogc_settings::detection_every,
            &ogc_settings::detection_gap, &ogc_settings::guess_rounds, &ogc_settings::lanes,
            &ogc_settings::contact_activation, &ogc_settings::damping_form>();

template <>
const Structure Described<ogc_scene>::structure = structure_with<ogc_scene>(
    {nested<&ogc_scene::topology>(), value<&ogc_scene::hinge_count, &QuestionSizes::hinges>(),
     value<&ogc_scene::body_count, &QuestionSizes::bodies>(),
     value<&ogc_scene::spring_count, &QuestionSizes::springs>(),
     value<&ogc_scene::tetrahedron_count, &QuestionSizes::tetrahedra>(), input<&ogc_scene::hinges>("hinge_count"),
     input<&ogc_scene::bodies>("body_count"), input<&ogc_scene::springs>("spring_count"),
     input<&ogc_scene::rest_positions>("vertex_count"), input<&ogc_scene::rigid_groups>("vertex_count"),
     nested<&ogc_scene::excluded_partners>(), input<&ogc_scene::tetrahedra>("tetrahedron_count"),
     input<&ogc_scene::inside_solid>("vertex_count"), value<&ogc_scene::settings, &QuestionSizes::settings>(),
     value<&ogc_scene::gravity, &QuestionSizes::gravity>(), reserved<&ogc_scene::reserved>()});

template <>
const Structure Described<ogc_rest>::structure =
    structure_with<ogc_rest>({input<&ogc_rest::mass>("vertex_count"),
                              value<&ogc_rest::triangle_count, &QuestionSizes::rest_triangles>(),
                              value<&ogc_rest::hinge_count, &QuestionSizes::rest_hinges>(),
                              value<&ogc_rest::tetrahedron_count, &QuestionSizes::rest_tetrahedra>(),
                              input<&ogc_rest::corner>("triangle_count"),
                              input<&ogc_rest::triangle_body>("triangle_count"),
                              input<&ogc_rest::area>("triangle_count"),
                              input<&ogc_rest::gradient>("triangle_count"),
                              input<&ogc_rest::hinge_vertex>("hinge_count"),
                              input<&ogc_rest::hinge_body>("hinge_count"),
                              input<&ogc_rest::rest_angle>("hinge_count"),
                              input<&ogc_rest::hinge_stiffness>("hinge_count"),
                              input<&ogc_rest::weight>("hinge_count"),
                              input<&ogc_rest::edge_length_squared>("edge_count"),
                              input<&ogc_rest::meeting_stiffness>("body_count * body_count"),
                              input<&ogc_rest::meeting_friction>("body_count * body_count"),
                              input<&ogc_rest::solid_corner>("tetrahedron_count"),
                              input<&ogc_rest::solid_body>("tetrahedron_count"),
                              input<&ogc_rest::volume>("tetrahedron_count"),
                              input<&ogc_rest::inverse>("tetrahedron_count"),
                              input<&ogc_rest::solid_weight>("tetrahedron_count"),
                              input<&ogc_rest::solid_gradient>("tetrahedron_count"),
                              reserved<&ogc_rest::reserved>()});

template <>
const Structure Described<ogc_rest_state_out>::structure =
    structure_with<ogc_rest_state_out>({output<&ogc_rest_state_out::mass>(Per::vertex),
                                        capacity<&ogc_rest_state_out::triangle_capacity>(List::triangles),
                                        count<&ogc_rest_state_out::triangle_count>(List::triangles),
                                        capacity<&ogc_rest_state_out::hinge_capacity>(List::hinges),
                                        count<&ogc_rest_state_out::hinge_count>(List::hinges),
                                        capacity<&ogc_rest_state_out::tetrahedron_capacity>(List::tetrahedra),
                                        count<&ogc_rest_state_out::tetrahedron_count>(List::tetrahedra),
                                        output<&ogc_rest_state_out::corner>(Per::one, List::triangles),
                                        output<&ogc_rest_state_out::triangle_body>(Per::one, List::triangles),
                                        output<&ogc_rest_state_out::area>(Per::one, List::triangles),
                                        output<&ogc_rest_state_out::gradient>(Per::one, List::triangles),
                                        output<&ogc_rest_state_out::hinge_vertex>(Per::one, List::hinges),
                                        output<&ogc_rest_state_out::hinge_body>(Per::one, List::hinges),
                                        output<&ogc_rest_state_out::rest_angle>(Per::one, List::hinges),
                                        output<&ogc_rest_state_out::hinge_stiffness>(Per::one, List::hinges),
                                        output<&ogc_rest_state_out::weight>(Per::one, List::hinges),
                                        output<&ogc_rest_state_out::edge_length_squared>(Per::edge),
                                        output<&ogc_rest_state_out::meeting_stiffness>(Per::two_bodies),
                                        output<&ogc_rest_state_out::meeting_friction>(Per::two_bodies),
                                        output<&ogc_rest_state_out::solid_corner>(Per::one, List::tetrahedra),
                                        output<&ogc_rest_state_out::solid_body>(Per::one, List::tetrahedra),
                                        output<&ogc_rest_state_out::volume>(Per::one, List::tetrahedra),
                                        output<&ogc_rest_state_out::inverse>(Per::one, List::tetrahedra),
                                        output<&ogc_rest_state_out::solid_weight>(Per::one, List::tetrahedra),
                                        output<&ogc_rest_state_out::solid_gradient>(Per::one, List::tetrahedra),
                                        reserved<&ogc_rest_state_out::reserved>()});

template <>
const Structure Described<ogc_sweep_in>::structure = structure_with<ogc_sweep_in>(
    {nested<&ogc_sweep_in::scene>(), nested<&ogc_sweep_in::rest>(), input<&ogc_sweep_in::colour>("vertex_count"),
     input<&ogc_sweep_in::old>("vertex_count"), input<&ogc_sweep_in::start>("vertex_count"),
     input<&ogc_sweep_in::target>("vertex_count"), input<&ogc_sweep_in::previous>("vertex_count"),
     input<&ogc_sweep_in::bound>("vertex_count"),
     value<&ogc_sweep_in::vertex_facet_count, &QuestionSizes::vertex_facet>(),
     value<&ogc_sweep_in::edge_edge_count, &QuestionSizes::edge_edge>(),
     input<&ogc_sweep_in::vertex_facet>("vertex_facet_count"), input<&ogc_sweep_in::edge_edge>("edge_edge_count")});

template <>
const Structure Described<ogc_sweep_out>::structure = structure_with<ogc_sweep_out>(
    {output<&ogc_sweep_out::position>(Per::vertex), output<&ogc_sweep_out::cut>(Per::one)});

template <>
const Structure Described<ogc_step_in>::structure = structure_with<ogc_step_in>(
    {nested<&ogc_step_in::scene>(), input<&ogc_step_in::start>("vertex_count"),
     input<&ogc_step_in::velocity>("vertex_count"), input<&ogc_step_in::prescribed>("vertex_count")});

template <>
const Structure Described<ogc_step_out>::structure =
    structure_with<ogc_step_out>({nested<&ogc_step_out::rest>(),
                                  output<&ogc_step_out::colour>(Per::vertex),
                                  output<&ogc_step_out::query_radius>(Per::one),
                                  output<&ogc_step_out::target>(Per::vertex),
                                  output<&ogc_step_out::position>(Per::vertex),
                                  output<&ogc_step_out::velocity>(Per::vertex),
                                  capacity<&ogc_step_out::event_capacity>(List::events),
                                  count<&ogc_step_out::event_count>(List::events),
                                  output<&ogc_step_out::kind>(Per::one, List::events),
                                  output<&ogc_step_out::cut>(Per::one, List::events),
                                  output<&ogc_step_out::event_position>(Per::vertex, List::events),
                                  capacity<&ogc_step_out::detection_capacity>(List::detections),
                                  count<&ogc_step_out::detection_count>(List::detections),
                                  output<&ogc_step_out::d_min_vertex>(Per::vertex, List::detections),
                                  output<&ogc_step_out::bound>(Per::vertex, List::detections),
                                  output<&ogc_step_out::d_min_triangle>(Per::triangle, List::detections),
                                  output<&ogc_step_out::d_min_edge>(Per::edge, List::detections),
                                  output<&ogc_step_out::vertex_facet_end>(Per::one, List::detections),
                                  output<&ogc_step_out::edge_edge_end>(Per::one, List::detections),
                                  capacity<&ogc_step_out::vertex_facet_capacity>(List::vertex_facet),
                                  count<&ogc_step_out::vertex_facet_count>(List::vertex_facet),
                                  capacity<&ogc_step_out::edge_edge_capacity>(List::edge_edge),
                                  count<&ogc_step_out::edge_edge_count>(List::edge_edge),
                                  output<&ogc_step_out::vertex_facet>(Per::one, List::vertex_facet),
                                  output<&ogc_step_out::edge_edge>(Per::one, List::edge_edge)});

std::size_t Member::group_bytes() const {
  std::size_t bytes = structure ? structure->bytes : bytes_of(element);
  for (const std::size_t dimension : fixed) bytes *= dimension > 0 ? dimension : 1;
  return bytes;
}

std::vector<const Structure*> plugin_structures() {
  return {&Described<ogc_rows>::structure,
          &Described<ogc_topology>::structure,
          &Described<ogc_closest_face_in>::structure,
          &Described<ogc_closest_face_out>::structure,
          &Described<ogc_closest_points_in>::structure,
          &Described<ogc_closest_points_out>::structure,
          &Described<ogc_detect_in>::structure,
          &Described<ogc_vertex_facet_contact>::structure,
          &Described<ogc_detect_vertex_facet_out>::structure,
          &Described<ogc_edge_edge_contact>::structure,
          &Described<ogc_detect_edge_edge_out>::structure,
          &Described<ogc_bound_in>::structure,
          &Described<ogc_bound_out>::structure,
          &Described<ogc_plane_in>::structure,
          &Described<ogc_vertex_plane>::structure,
          &Described<ogc_plane_out>::structure,
          &Described<ogc_half_space>::structure,
          &Described<ogc_truncate_in>::structure,
          &Described<ogc_truncate_out>::structure,
          &Described<ogc_initial_guess_case>::structure,
          &Described<ogc_initial_guess_in>::structure,
          &Described<ogc_initial_guess_out>::structure,
          &Described<ogc_block_question>::structure,
          &Described<ogc_block_in>::structure,
          &Described<ogc_block_out>::structure,
          &Described<ogc_ccd_case>::structure,
          &Described<ogc_ccd_in>::structure,
          &Described<ogc_ccd_out>::structure,
          &Described<ogc_volume_depth_in>::structure,
          &Described<ogc_volume_contact>::structure,
          &Described<ogc_volume_numbers>::structure,
          &Described<ogc_volume_depth_out>::structure,
          &Described<ogc_activation_in>::structure,
          &Described<ogc_activation_out>::structure,
          &Described<ogc_barrier_in>::structure,
          &Described<ogc_barrier_out>::structure,
          &Described<ogc_membrane_case>::structure,
          &Described<ogc_bending_case>::structure,
          &Described<ogc_spring_case>::structure,
          &Described<ogc_tetrahedron_case>::structure,
          &Described<ogc_contact_force_case>::structure,
          &Described<ogc_friction_force_case>::structure,
          &Described<ogc_volume_force_case>::structure,
          &Described<ogc_membrane_in>::structure,
          &Described<ogc_bending_in>::structure,
          &Described<ogc_spring_in>::structure,
          &Described<ogc_tetrahedron_in>::structure,
          &Described<ogc_contact_force_in>::structure,
          &Described<ogc_friction_force_in>::structure,
          &Described<ogc_volume_force_in>::structure,
          &Described<ogc_force_out>::structure,
          &Described<ogc_hinge>::structure,
          &Described<ogc_body>::structure,
          &Described<ogc_scene_spring>::structure,
          &Described<ogc_settings>::structure,
          &Described<ogc_scene>::structure,
          &Described<ogc_rest>::structure,
          &Described<ogc_rest_state_out>::structure,
          &Described<ogc_sweep_in>::structure,
          &Described<ogc_sweep_out>::structure,
          &Described<ogc_step_in>::structure,
          &Described<ogc_step_out>::structure};
}

const Structure& plugin_structure(std::string_view name) {
  const auto all = plugin_structures();
  return **std::find_if(all.begin(), all.end(), [&](const Structure* structure) { return structure->name == name; });
}

}  // namespace ogc::experiments
