// Switches mutants on. tests/mutants.py rewrites `a < b` to `a < Less{17} < b`, which has the same value until mutant
// 17 is switched on. So one build holds all mutants, and rewritten code keeps its precedence. Each struct takes the ids
// from its own on, one for each alternative.
#pragma once

#include <type_traits>

namespace ogc_mutant {

inline int active = 0;          ///< no mutant at 0
inline bool recording = false;  ///< whether `reached` notes the mutants that are reached
inline bool reached[1 << 15] = {};

inline bool hit(int id) {
  if (recording) reached[id] = true;
  return active == id;
}
constexpr bool on(int id) { return std::is_constant_evaluated() ? false : hit(id); }

template <class A, class Operator>
struct Left {
  A a;
  int id;
};

// Defines a mutated comparison, which returns a bool or the mask of a pack. Operators that packs lack are left out.
#define OGC_MUTANT_COMPARISON(Name, op, one, other)                                   \
  struct Name {                                                                       \
    int id;                                                                           \
  };                                                                                  \
  template <class A>                                                                  \
  constexpr Left<A, Name> operator op(A a, Name m) {                                  \
    return {a, m.id};                                                                 \
  }                                                                                   \
  template <class A, class B>                                                         \
  constexpr auto operator op(Left<A, Name> left, const B& b)->decltype(left.a op b) { \
    if constexpr (requires { left.a one b; }) {                                       \
      if (on(left.id)) return left.a one b;                                           \
    }                                                                                 \
    if constexpr (requires { left.a other b; }) {                                     \
      if (on(left.id + 1)) return left.a other b;                                     \
    }                                                                                 \
    return left.a op b;                                                               \
  }
OGC_MUTANT_COMPARISON(Less, <, <=, >=)
OGC_MUTANT_COMPARISON(Greater, >, >=, <=)
OGC_MUTANT_COMPARISON(LessEqual, <=, <, >)
OGC_MUTANT_COMPARISON(GreaterEqual, >=, >, <)
#undef OGC_MUTANT_COMPARISON

#define OGC_MUTANT_EQUALITY(Name, op, one)                     \
  struct Name {                                                \
    int id;                                                    \
  };                                                           \
  template <class A>                                           \
  constexpr Left<A, Name> operator op(A a, Name m) {           \
    return {a, m.id};                                          \
  }                                                            \
  template <class A, class B>                                  \
  constexpr bool operator op(Left<A, Name> left, const B& b) { \
    return on(left.id) ? left.a one b : left.a op b;           \
  }
OGC_MUTANT_EQUALITY(Equal, ==, !=)
OGC_MUTANT_EQUALITY(Unequal, !=, ==)
#undef OGC_MUTANT_EQUALITY

// Defines a mutated arithmetic operator. Its mutants are the other operator, where that gives the same type, and the
// left operand alone.
#define OGC_MUTANT_ARITHMETIC(Name, op, one)                                               \
  struct Name {                                                                            \
    int id;                                                                                \
  };                                                                                       \
  template <class A>                                                                       \
  constexpr Left<A, Name> operator op(A a, Name m) {                                       \
    return {a, m.id};                                                                      \
  }                                                                                        \
  template <class A, class B>                                                              \
  constexpr auto operator op(Left<A, Name> left, const B& b)->decltype(left.a op b) {      \
    using Result = decltype(left.a op b);                                                  \
    if constexpr (requires { requires std::is_same_v<decltype(left.a one b), Result>; }) { \
      if (on(left.id)) return left.a one b;                                                \
    }                                                                                      \
    if constexpr (std::is_convertible_v<A, Result>) {                                      \
      if (on(left.id + 1)) return left.a;                                                  \
    }                                                                                      \
    return left.a op b;                                                                    \
  }
OGC_MUTANT_ARITHMETIC(Plus, +, -)
OGC_MUTANT_ARITHMETIC(Minus, -, +)
OGC_MUTANT_ARITHMETIC(Times, *, /)
OGC_MUTANT_ARITHMETIC(Over, /, *)
#undef OGC_MUTANT_ARITHMETIC

/// Stands in front of a minus sign; its mutant removes the sign.
struct Sign {
  int id;
};
template <class A>
constexpr A operator*(Sign m, A a) {
  if (on(m.id)) return -a;
  return a;
}

/// Returns a condition; its mutant negates it.
template <class A>
constexpr bool negated(int id, const A& a) {
  return on(id) ? !static_cast<bool>(a) : static_cast<bool>(a);
}

/// Returns a number; its mutants double and halve it. Integers and 0 become one more and one less instead.
template <class A>
constexpr A literal(int id, A a) {
  if constexpr (std::is_integral_v<A>)
    return on(id) ? a + 1 : on(id + 1) ? a - 1 : a;
  else
    return on(id) ? (a == 0 ? 1 : 2 * a) : on(id + 1) ? (a == 0 ? -1 : a / 2) : a;
}

/// Returns an index 0 … 2; its mutant is the next smaller index, and 1 for 0.
constexpr int index(int id, int i) { return on(id) ? (i == 0 ? 1 : i - 1) : i; }

template <class A>
constexpr A smaller(int id, A a, A b) {
  if (on(id)) return a < b ? b : a;
  return b < a ? b : a;
}
template <class A>
constexpr A larger(int id, A a, A b) {
  if (on(id)) return b < a ? b : a;
  return a < b ? b : a;
}

}  // namespace ogc_mutant
