// Stores in checkpoint.h5 the state from which a run can continue to the same bits. The file is replaced as a whole,
// and its digest detects damage. Everything else that a run needs is in run.json and scene/. The checkpoint contains
// the digest of the scene, so that an edited scene is rejected.
#pragma once

#include <filesystem>
#include <string>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// Version of the format. A newer file is rejected with a message. Format 3 has `orientations` [segments × 4] if there
/// are rods, format 4 `search_limits` [vertices] if bounds are planes.
inline constexpr std::int64_t checkpoint_format_version = 4;

/// The state to continue from. If the run audits states, this one has been audited.
struct Checkpoint {
  /// step, positions, velocities, bounds, capacities; since format 2 also the exact positions and velocities of solvers
  /// that have them; since format 3 also orientations, since format 4 also search limits
  Snapshot state;
  std::int64_t audited_states = 0;  ///< number of states audited so far
};

/// Writes `folder`/checkpoint.h5 durably. Throws ResourceError.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                      const std::string& scene_digest);

/// Reads `folder`/checkpoint.h5. Throws InputError with a remedy if it is missing, damaged, of a newer format, has an
/// orientation that is no unit quaternion, or belongs to a scene with another digest.
Checkpoint read_checkpoint(const std::filesystem::path& folder, const std::string& scene_digest);

/// Returns the digest of the files of a run's scene, by name and content. Throws InputError.
std::string scene_digest(const std::filesystem::path& folder);

}  // namespace ogc::compare
