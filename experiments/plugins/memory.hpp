// Holds the arrays that a plug-in sees. Each array lies alone. Inputs can't be written, and they end at the end of a
// page, so that reading beyond crashes. Guard zones lie around outputs, and all of it is filled with a pattern, so that
// bytes written beyond an end, or never written, are found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "experiments/plugins/channel.hpp"

namespace ogc::experiments {

/// Content of an array before it is written: as a float a signalling NaN that no arithmetic makes, as a byte 0xe7.
inline constexpr std::uint32_t unwritten_word = 0x7fadc0de;
inline constexpr std::uint8_t unwritten_byte = 0xe7;

/// Says where bytes around an array were written.
enum class Damage { none, before, behind };

/// Holds the arrays of a question and its answer.
class PluginMemory {
 public:
  virtual ~PluginMemory() = default;
  /// Returns a copy that lives until `release`.
  virtual const void* input(Bytes content) = 0;
  /// Returns room for `bytes`, filled with the pattern of its unit (4 bytes or 1), until `release`.
  virtual void* output(std::size_t bytes, std::size_t unit) = 0;
  /// Waits until all that was begun is done. Throws std::runtime_error if the device reports an error.
  virtual void synchronize() = 0;
  /// Returns the side of the k-th output on which bytes were written.
  virtual Damage damage(std::size_t k) = 0;
  /// Returns the first `bytes` of the k-th output.
  virtual std::vector<std::byte> content(std::size_t k, std::size_t bytes) = 0;
  /// Frees all arrays.
  virtual void release() = 0;
  /// Returns whether the process can be asked again after a call that broke the rules: not if it may have written
  /// anywhere in the process, nor if the device has given up.
  virtual bool can_go_on() = 0;
};

/// Returns memory of the CPU.
std::unique_ptr<PluginMemory> host_memory();

/// Returns memory of CUDA device 0, through the driver's library, so that no build of `ogc` needs to know it. Throws
/// std::runtime_error that says what is missing.
std::unique_ptr<PluginMemory> device_memory();

/// Returns `bytes` of the pattern.
std::vector<std::byte> pattern(std::size_t bytes, std::size_t unit);
/// Bytes of a guard zone.
inline constexpr std::size_t guard_bytes = 4096;

}  // namespace ogc::experiments
