// The stages that the judge can compare; their names are the stems of compare/stages.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ogc::compare {

enum class Stage : std::uint8_t { closest_face, closest_points, detect_vertex_facet, detect_edge_edge, bound, activation, truncate, membrane, bending };

inline constexpr std::array<Stage, 9> all_stages{Stage::closest_face, Stage::closest_points, Stage::detect_vertex_facet, Stage::detect_edge_edge, Stage::bound,
                                                 Stage::activation,   Stage::truncate,       Stage::membrane,            Stage::bending};

/// "closest_face" …
std::string_view stage_name(Stage stage);

/// The stage of that name; empty where there is none.
std::optional<Stage> find_stage(std::string_view name);

/// Whether a case of the stage is a whole mesh, whose vertices (or edges) are counted one by one.
bool is_mesh_stage(Stage stage);

/// Whether the answer is the force and block of a vertex.
bool is_force_stage(Stage stage);

}  // namespace ogc::compare
