#include "experiments/plugins/stages.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace ogc::experiments {

namespace {

std::size_t at(List list) { return static_cast<std::size_t>(list); }

/// Calls `visit` for each member of the structure and of those nested in it, with its place in the whole [bytes].
template <class Visit>
void visit_members(const Structure& structure, std::size_t base, const Visit& visit) {
  for (const Member& member : structure.members) {
    if (member.role == Role::nested)
      visit_members(*member.structure, base + member.offset, visit);
    else
      visit(member, base + member.offset);
  }
}

OutputInfo output_of(const Member& member) {
  const Element element = member.structure ? member.structure->members.front().element : member.element;
  return {member.name, element, member.group_bytes() / bytes_of(element), member.per, member.list};
}

template <class In, class Out>
PluginStage stage(std::string_view name) {
  PluginStage stage{.name = name,
                    .in = &plugin_structure(detail::structure_name<In>()),
                    .out = &plugin_structure(detail::structure_name<Out>()),
                    .outputs = {}};
  visit_members(*stage.in, 0, [&](const Member& member, std::size_t) { stage.inputs += member.role == Role::input; });
  visit_members(*stage.out, 0, [&](const Member& member, std::size_t) {
    if (member.role == Role::output) stage.outputs.push_back(output_of(member));
  });
  return stage;
}

/// Memory of a structure, aligned for each of its members.
class Filled {
 public:
  Filled(const Structure& structure, const CallArrays& arrays)
      : structure_(structure), words_((structure.bytes + sizeof(std::max_align_t) - 1) / sizeof(std::max_align_t)) {
    std::size_t inputs = 0, outputs = 0;
    visit_members(structure, 0, [&](const Member& member, std::size_t place) {
      switch (member.role) {
        case Role::field:
        case Role::nested:
        case Role::reserved: break;
        case Role::value:
          put(place, reinterpret_cast<const std::byte*>(&arrays.sizes) + member.question, member.group_bytes());
          break;
        case Role::input: put(place, &arrays.inputs[inputs++], sizeof(void*)); break;
        case Role::output: put(place, &arrays.outputs[outputs++], sizeof(void*)); break;
        case Role::capacity: put(place, &arrays.capacities[at(member.list)], sizeof(std::int64_t)); break;
        case Role::count: put(place, &unset, sizeof unset); break;
      }
    });
  }

  void* data() { return words_.data(); }

  /// Returns the lengths of the lists that the plug-in has set.
  ListSizes counts() const {
    ListSizes counts{1};
    visit_members(structure_, 0, [&](const Member& member, std::size_t place) {
      if (member.role == Role::count)
        std::memcpy(&counts[at(member.list)], reinterpret_cast<const std::byte*>(words_.data()) + place,
                    sizeof(std::int64_t));
    });
    return counts;
  }

 private:
  static constexpr std::int64_t unset = -1;
  void put(std::size_t place, const void* from, std::size_t bytes) {
    std::memcpy(reinterpret_cast<std::byte*>(words_.data()) + place, from, bytes);
  }

  const Structure& structure_;
  std::vector<std::max_align_t> words_;
};

}  // namespace

CallReturn call_plugin(const PluginStage& stage, void* function, const CallArrays& arrays) {
  Filled in(*stage.in, arrays), out(*stage.out, arrays);
  int (*callee)(const void*, void*) = nullptr;
  std::memcpy(&callee, &function, sizeof callee);
  const int status = callee(in.data(), out.data());
  return {status, out.counts()};
}

std::size_t groups(const OutputInfo& info, const QuestionSizes& sizes, const ListSizes& lists) {
  const auto of_each = [&]() -> std::int64_t {
    switch (info.per) {
      case Per::one: return 1;
      case Per::item: return sizes.cases;
      case Per::vertex: return sizes.vertices;
      case Per::edge: return sizes.edges;
      case Per::triangle: return sizes.triangles;
      case Per::two_bodies: return std::int64_t{sizes.bodies} * sizes.bodies;
    }
    return 0;
  };
  return static_cast<std::size_t>(of_each() * lists[static_cast<std::size_t>(info.list)]);
}

// Returns the capacities of the lists at the first call. Those of contacts and planes are estimates. Those of events
// and detections are the most that Algorithm 3 needs: a detection before each round and each iteration.
ListSizes first_capacities(const QuestionSizes& sizes) {
  const std::int64_t contacts = 64 + 4 * (std::int64_t{sizes.vertices} + sizes.edges),
                     rounds = sizes.settings.guess_rounds + sizes.settings.iterations;
  return {1,
          contacts,
          contacts,
          sizes.triangles,
          sizes.hinges,
          sizes.tetrahedra,
          2 * rounds + 1,
          rounds + 1,
          4 * contacts,
          64 + 4 * sizes.cases};
}

// Returns for each list its first capacity plus the largest number of entries of all detections, together at most 2^40.
// Largest numbers of entries of one detection:
//
// - contacts: all vertices with all triangles, and all ordered pairs of edges
// - contacts with a volume: all points with all faces
// - planes: one for each vertex of each pair
//
// The first capacities are added because a plug-in may list contacts of a small mesh twice. The judge then recognises
// this mistake. Products of two sizes fit into 64 bits, because each size fits into 31 bits.
ListSizes most_entries(const QuestionSizes& sizes) {
  constexpr std::int64_t most = std::int64_t{1} << 40;
  ListSizes entries = first_capacities(sizes);
  const auto detections = static_cast<double>(entries[static_cast<std::size_t>(List::detections)]);
  const auto add_pairs = [&](List list, double first, double second) {
    std::int64_t& count = entries[static_cast<std::size_t>(list)];
    count = std::min(
        most, count + static_cast<std::int64_t>(std::min(first * second * detections, static_cast<double>(most))));
  };
  add_pairs(List::vertex_facet, sizes.vertices, sizes.triangles);
  add_pairs(List::edge_edge, sizes.edges, sizes.edges);
  add_pairs(List::planes, 4.0 * sizes.vertices, sizes.triangles);
  add_pairs(List::planes, 4.0 * sizes.edges, sizes.edges);
  add_pairs(List::volume_contacts, static_cast<double>(sizes.cases),
            static_cast<double>(sizes.vertices) + sizes.edges + sizes.triangles);
  return entries;
}

std::string_view list_name(List list) {
  constexpr std::array<std::string_view, list_count> names{
      "", "contacts", "contacts", "triangles", "hinges", "tetrahedra", "events", "detections", "planes", "contacts"};
  return names[static_cast<std::size_t>(list)];
}

std::span<const PluginStage> plugin_stages() {
  static const auto table = std::to_array<PluginStage>({
      stage<ogc_closest_face_in, ogc_closest_face_out>("closest_face"),
      stage<ogc_closest_points_in, ogc_closest_points_out>("closest_points"),
      stage<ogc_block_in, ogc_block_out>("block"),
      stage<ogc_detect_in, ogc_detect_vertex_facet_out>("detect_vertex_facet"),
      stage<ogc_detect_in, ogc_detect_edge_edge_out>("detect_edge_edge"),
      stage<ogc_bound_in, ogc_bound_out>("bound"),
      stage<ogc_plane_in, ogc_plane_out>("plane"),
      stage<ogc_ccd_in, ogc_ccd_out>("ccd"),
      stage<ogc_volume_depth_in, ogc_volume_depth_out>("volume_depth"),
      stage<ogc_initial_guess_in, ogc_initial_guess_out>("initial_guess"),
      stage<ogc_activation_in, ogc_activation_out>("activation"),
      stage<ogc_barrier_in, ogc_barrier_out>("barrier"),
      stage<ogc_volume_force_in, ogc_force_out>("volume_force"),
      stage<ogc_contact_force_in, ogc_force_out>("contact_force"),
      stage<ogc_friction_force_in, ogc_force_out>("friction_force"),
      stage<ogc_membrane_in, ogc_force_out>("membrane"),
      stage<ogc_bending_in, ogc_force_out>("bending"),
      stage<ogc_spring_in, ogc_force_out>("spring"),
      stage<ogc_tetrahedron_in, ogc_force_out>("tetrahedron"),
      stage<ogc_truncate_in, ogc_truncate_out>("truncate"),
      stage<ogc_scene, ogc_rest_state_out>("rest_state"),
      stage<ogc_sweep_in, ogc_sweep_out>("sweep"),
      stage<ogc_step_in, ogc_step_out>("step"),
  });
  return table;
}

std::optional<std::size_t> find_plugin_stage(std::string_view name) {
  const auto all = plugin_stages();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name) return i;
  return std::nullopt;
}

}  // namespace ogc::experiments
