// checkpoint.h5: where a run can go on to the same bits. One file, replaced as a whole; its digest tells a damaged one.
// What else a run needs stands in run.json and scene/; it keeps the digest of the scene, so that a scene edited by hand
// is refused.
#pragma once

#include <filesystem>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// A newer file is refused by name. Format 3 holds `orientations` [segments × 4] where there are rods.
inline constexpr std::int64_t checkpoint_format_version = 3;

/// The state to go on from; in runs that audit states, an audited one.
struct Checkpoint {
  /// step, positions, velocities, bounds, capacities; from version 2 on the exact ones, where a solver has them; from
  /// version 3 on orientations
  Snapshot state;
  std::int64_t audited_states = 0;  ///< judged so far
};

/// Writes `folder`/checkpoint.h5 durably. Throws ResourceError.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                      const std::string& scene_digest);

/// Reads it. Throws InputError that says what to do: missing, damaged, of a newer format, with an orientation that is
/// no unit quaternion, or of a scene with another digest.
Checkpoint read_checkpoint(const std::filesystem::path& folder, const std::string& scene_digest);

/// The digest of the files of a run's scene, by name and content. Throws InputError.
std::string scene_digest(const std::filesystem::path& folder);

}  // namespace ogc::compare
