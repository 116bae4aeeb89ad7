// Holds the arrays that a plug-in receives, each in separate pages. Inputs are read-only and end at the end of a page,
// so that a read beyond the end crashes. Guard zones surround the outputs. Zones and outputs are filled with a pattern,
// which reveals bytes that were written outside or never written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "experiments/plugins/channel.hpp"

namespace ogc::experiments {

/// Content of the bytes of an array before they are written: floats are a signalling NaN that no arithmetic produces,
/// bytes are 0xe7.
inline constexpr std::uint32_t unwritten_word = 0x7fadc0de;
inline constexpr std::uint8_t unwritten_byte = 0xe7;

/// Tells where bytes were written outside an array: nowhere, before the array or behind it.
enum class Damage { none, before, behind };

/// Holds the arrays of one question and its answer.
class PluginMemory {
 public:
  virtual ~PluginMemory() = default;
  /// Returns a read-only copy that lives until `release`.
  virtual const void* input(Bytes content) = 0;
  /// Returns `bytes` of memory that live until `release`, filled with the pattern of unwritten floats (`unit` 4) or
  /// bytes (`unit` 1).
  virtual void* output(std::size_t bytes, std::size_t unit) = 0;
  /// Waits until all work on the device has finished. Throws std::runtime_error if the device reports an error.
  virtual void synchronize() = 0;
  /// Returns where bytes were written outside the k-th output.
  virtual Damage damage(std::size_t k) = 0;
  /// Returns the first `bytes` of the k-th output.
  virtual std::vector<std::byte> content(std::size_t k, std::size_t bytes) = 0;
  /// Frees all arrays.
  virtual void release() = 0;
  /// Returns whether the process can answer another question after a call that broke the rules. It can't if the plug-in
  /// may have written anywhere in the process, or if the device has failed.
  virtual bool can_go_on() = 0;
};

/// Returns memory of the host.
std::unique_ptr<PluginMemory> host_memory();

/// Returns memory of CUDA device 0. The driver's library is loaded at run time, so that every build of `ogc` supports
/// it. Throws std::runtime_error that says what is missing.
std::unique_ptr<PluginMemory> device_memory();

/// Returns `bytes` bytes of the pattern of unwritten floats (`unit` 4) or bytes (`unit` 1).
std::vector<std::byte> pattern(std::size_t bytes, std::size_t unit);
/// Size of a guard zone [bytes].
inline constexpr std::size_t guard_bytes = 4096;

}  // namespace ogc::experiments
