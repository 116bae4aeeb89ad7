// Defines the program of a world: the calls of a step, recorded once, as a row of instructions in one block of memory.
// The program is data, so one launch can run the programs of many worlds, each with its own settings, sizes and control
// flow (fast/worlds/backend.hpp). A host thread and a block of a device run the same instructions.
//
// An instruction is followed by the arguments of its call, which are an operation (fast/worlds/operations.hpp). Offsets
// are in bytes from the begin of the program.
#pragma once

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

#include "fast/kernels/arithmetic/qualifiers.hpp"

namespace ogc::fast {

/// Calls an operation with its arguments. `memory`: temporary memory of the block that runs the operation.
using Code = void (*)(const void* arguments, void* memory);

/// Alignment of instructions and of their arguments [B].
inline constexpr std::size_t instruction_alignment = 16;
/// Largest size of an instruction with its arguments [B]. A block has room for two of them.
inline constexpr int largest_instruction = 4096;

/// The head of an instruction.
struct alignas(instruction_alignment) Instruction {
  enum class Kind : int {
    call,       ///< calls `code`
    go_unless,  ///< goes to `target` if *flag is 0
    go_if       ///< goes to `target` if *flag is not 0
  };
  Code code = nullptr;
  const int* flag = nullptr;  ///< where the world's data are
  Kind kind = Kind::call;
  int size = 0;       ///< size with the arguments [B]; the next instruction follows
  int next_size = 0;  ///< size of the next instruction [B]; 0: this is the last one
  int target = 0;     ///< offset of another instruction, or of the program's end
};

/// A part of a world's work: a program that is run `times` times, or until *goes_on is 0.
struct Segment {
  const std::byte* program;
  int size;            ///< of the program [B]
  int times;           ///< repetitions
  const int* goes_on;  ///< where the world's data are; null: all repetitions are run
};

/// The work of one world in a launch.
struct WorldJob {
  const Segment* segments;
  int count;  ///< segments
};

/// Writes a program.
class ProgramWriter {
 public:
  /// Appends a call of an operation.
  template <class Operation>
  void call(Code code, const Operation& operation) {
    static_assert(std::is_trivially_copyable_v<Operation> && alignof(Operation) <= instruction_alignment);
    constexpr std::size_t size = sizeof(Instruction) + (sizeof(Operation) + instruction_alignment - 1) /
                                                           instruction_alignment * instruction_alignment;
    static_assert(size <= largest_instruction, "an instruction fits into the memory of a block");
    const std::size_t at = append(Instruction::Kind::call, size);
    head(at)->code = code;
    new (bytes_.data() + at + sizeof(Instruction)) Operation(operation);
  }
  /// Appends a jump. Returns its offset, for aim().
  std::size_t jump(Instruction::Kind kind, const int* flag) {
    const std::size_t at = append(kind, sizeof(Instruction));
    head(at)->flag = flag;
    return at;
  }
  /// Makes the jump at an offset go to `target`.
  void aim(std::size_t jump, std::size_t target) { head(jump)->target = static_cast<int>(target); }

  /// Returns the offset of the next instruction.
  std::size_t size() const { return bytes_.size(); }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  bool is_empty() const { return bytes_.empty(); }
  void clear() {
    bytes_.clear();
    last_ = none;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Instruction* head(std::size_t at) { return std::launder(reinterpret_cast<Instruction*>(bytes_.data() + at)); }
  std::size_t append(Instruction::Kind kind, std::size_t size) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + size);
    if (last_ != none) head(last_)->next_size = static_cast<int>(size);
    auto* instruction = new (bytes_.data() + at) Instruction;
    instruction->kind = kind;
    instruction->size = static_cast<int>(size);
    last_ = at;
    return at;
  }

  std::vector<std::byte> bytes_;
  std::size_t last_ = none;  ///< offset of the last instruction
};

}  // namespace ogc::fast
