// The arrays that a plug-in sees. Each lies alone: inputs can't be written, and their end is the end of a page, so that
// reading on crashes; around outputs lie guard zones, and all of it is filled with a pattern, so that what was written
// beyond an end, or never written, can be told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "experiments/plugins/channel.hpp"

namespace ogc::experiments {

/// What an array holds before it is written: as a float a signalling NaN that no arithmetic makes, as a byte 0xe7.
inline constexpr std::uint32_t unwritten_word = 0x7fadc0de;
inline constexpr std::uint8_t unwritten_byte = 0xe7;

/// Where bytes around an array were written.
enum class Damage { none, before, behind };

/// Where arrays of a question and its answer lie.
class PluginMemory {
 public:
  virtual ~PluginMemory() = default;
  /// A copy that lives until `release`.
  virtual const void* input(Bytes content) = 0;
  /// Room for `bytes`, filled with the pattern of its unit (4 bytes or 1), until `release`.
  virtual void* output(std::size_t bytes, std::size_t unit) = 0;
  /// Waits until what was begun is done. Throws std::runtime_error where the device reports an error.
  virtual void synchronize() = 0;
  /// On which side of the k-th output bytes were written.
  virtual Damage damage(std::size_t k) = 0;
  /// The first `bytes` of the k-th output.
  virtual std::vector<std::byte> content(std::size_t k, std::size_t bytes) = 0;
  /// Frees all arrays.
  virtual void release() = 0;
  /// Whether the process can be asked again after a call that broke the rules: not where it may have written anywhere
  /// in the process, nor where the device has given up.
  virtual bool can_go_on() = 0;
};

/// Memory of the CPU.
std::unique_ptr<PluginMemory> host_memory();

/// Memory of CUDA device 0, through the driver's library, so that no build of `ogc` needs to know it. Throws
/// std::runtime_error that says what is missing.
std::unique_ptr<PluginMemory> device_memory();

/// `bytes` of the pattern.
std::vector<std::byte> pattern(std::size_t bytes, std::size_t unit);
/// Bytes of a guard zone.
inline constexpr std::size_t guard_bytes = 4096;

}  // namespace ogc::experiments
