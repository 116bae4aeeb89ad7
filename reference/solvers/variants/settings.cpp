#include "reference/solvers/variants/settings.hpp"

#include <array>

namespace ogc::reference {
namespace {

using compare::DeclaredSetting;
using enum compare::SettingKind;

constexpr std::array<std::string_view, 3> set_names{"ogc", "pairs", "distance"};
constexpr std::array<std::string_view, 5> colour_names{"turned", "greedy", "random", "vertex", "together"};
constexpr std::array<std::string_view, 2> block_names{"majorised", "own"};
constexpr std::array<std::string_view, 2> cut_names{"update", "iteration"};

constexpr std::array<compare::SettingInfo, 4> rows{{
    {"reference_contact_set", "1",
     "reference_vbd, newton, penalty: detection lists the method's contacts (ogc), one contact of each pair of "
     "primitives within r, as IPC does (pairs), or each vertex's closest point of each other body (distance)",
     0, 2, DeclaredSetting{choice, 0}, set_names},
    {"reference_vbd_colours", "1",
     "reference_vbd: a sweep updates the vertices of a colour together; colours are greedy and turned in each "
     "component (turned), greedy (greedy), greedy in a random order (random), one a vertex (vertex), or one in all "
     "(together)",
     0, 4, DeclaredSetting{choice, 0}, colour_names},
    {"reference_vbd_contact_blocks", "1",
     "reference_vbd: the block of a contact majorises what all of its vertices of one colour do (majorised), or is w² "
     "(own)",
     0, 1, DeclaredSetting{choice, 0}, block_names},
    {"reference_vbd_cut_after", "1",
     "reference_vbd: a vertex is cut to its bound at its update (update), or all are after an iteration (iteration)", 0,
     1, DeclaredSetting{choice, 0}, cut_names},
}};

const compare::SettingsDeclaration declaration("reference", rows);

template <class Choice>
Choice choice_of(const compare::Settings& settings, std::string_view name) {
  return static_cast<Choice>(static_cast<int>(get_setting(settings, name)));
}

}  // namespace

Variants variants_of(const compare::Settings& settings) {
  return {.contact_set = choice_of<ContactSet>(settings, "reference_contact_set"),
          .colours = choice_of<Colouring>(settings, "reference_vbd_colours"),
          .contact_blocks = choice_of<ContactBlocks>(settings, "reference_vbd_contact_blocks"),
          .cut_after = choice_of<CutAfter>(settings, "reference_vbd_cut_after")};
}

}  // namespace ogc::reference
