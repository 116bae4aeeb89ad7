// Stores in checkpoint.h5 the state from which a run can continue to the same bits. It is one file, replaced as a
// whole; its digest detects damage. Everything else that a run needs is in run.json and scene/; the checkpoint keeps
// the digest of the scene, so that a scene edited by hand is refused.
#pragma once

#include <filesystem>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// Version of the format; a newer file is refused by name. Format 3 holds `orientations` [segments × 4] if there are
/// rods.
inline constexpr std::int64_t checkpoint_format_version = 3;

/// The state to continue from; in runs that audit states, an audited one.
struct Checkpoint {
  /// step, positions, velocities, bounds, capacities; from version 2 on the exact positions and velocities of solvers
  /// that have them; from version 3 on orientations
  Snapshot state;
  std::int64_t audited_states = 0;  ///< number of states audited so far
};

/// Writes `folder`/checkpoint.h5 durably. Throws ResourceError.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                      const std::string& scene_digest);

/// Reads it. Throws InputError with a remedy if it is missing, damaged, of a newer format, has an orientation that is
/// no unit quaternion, or belongs to a scene with another digest.
Checkpoint read_checkpoint(const std::filesystem::path& folder, const std::string& scene_digest);

/// Returns the digest of the files of a run's scene, by name and content. Throws InputError.
std::string scene_digest(const std::filesystem::path& folder);

}  // namespace ogc::compare
