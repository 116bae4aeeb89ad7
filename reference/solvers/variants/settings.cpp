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
     "solvers of the reference: which contacts are listed, the method's, one of each pair of primitives within r (as "
     "IPC has them), or of each vertex the closest point of each other body",
     0, 2, DeclaredSetting{choice, 0}, set_names},
    {"reference_vbd_colours", "1",
     "reference_vbd: who is updated together, by greedy colours that are turned in each component, as they are, in a "
     "random order, each vertex alone, or all",
     0, 4, DeclaredSetting{choice, 0}, colour_names},
    {"reference_vbd_contact_blocks", "1",
     "reference_vbd: whether the block of a contact majorises what all of its vertices of one colour do, or is w²", 0,
     1, DeclaredSetting{choice, 0}, block_names},
    {"reference_vbd_cut_after", "1",
     "reference_vbd: whether a vertex is cut to its bound at its update, or all after an iteration", 0, 1,
     DeclaredSetting{choice, 0}, cut_names},
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
