#include "tests/compare/judge/faults.hpp"

#include <array>

namespace ogc::tests {

using namespace compare;

namespace {

struct FaultFile {
  std::vector<Fault> (*faults)();
  void (*add_right)(Contestant&, const Authority&);
};

/// In the order of the faults' numbers. Of initial_guess the right answer uses that of truncate.
constexpr std::array<FaultFile, 14> files{{{pair_faults, add_right_pairs},
                                           {set_faults, add_right_sets},
                                           {plane_faults, add_right_planes},
                                           {scalar_faults, add_right_scalars},
                                           {region_faults, [](Contestant&, const Authority&) {}},
                                           {contact_faults, add_right_contacts},
                                           {force_faults, add_right_forces},
                                           {rest_faults, add_right_rest},
                                           {step_faults, add_right_step},
                                           {sweep_faults, add_right_sweep},
                                           {volume_faults, add_right_volumes},
                                           {rod_faults, add_right_rods},
                                           {rod_step_faults, [](Contestant&, const Authority&) {}},
                                           {ipc_faults, add_right_ipc}}};

}  // namespace

ForceOut rounded(const ForceTruth& truth) {
  ForceOut out;
  for (const auto& accepted : truth.accepted) {
    const ForceAnswer& exact = accepted[0];
    out.force.push_back(
        {static_cast<float>(exact.force.x), static_cast<float>(exact.force.y), static_cast<float>(exact.force.z)});
    std::array<float, 6> block{};
    for (std::size_t k = 0; k < block.size(); ++k) block[k] = static_cast<float>(exact.block[k]);
    out.block.push_back(block);
  }
  return out;
}

Contestant exact_contestant(const Authority& authority) {
  Contestant exact;
  exact.name = "exact";
  for (const FaultFile& file : files) file.add_right(exact, authority);
  return exact;
}

std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (const FaultFile& file : files)
    for (Fault& fault : file.faults()) all.push_back(std::move(fault));
  return all;
}

}  // namespace ogc::tests
