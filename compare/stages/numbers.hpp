// Defines the unit roundoff u, in which tolerances are given, and the widths of grey and near zones.
#pragma once

namespace ogc::compare {

/// Unit roundoff of single precision, u = 2⁻²⁴: |fl(a∘b) − a∘b| ≤ u |a∘b| without underflow.
inline constexpr double unit_roundoff = 0x1p-24;

/// Grey zone (method.md §2.5): a case is grey if its exact margin m has |m| ≤ 16 u Σ|∂m/∂δᵢ||δᵢ|, where δᵢ are the
/// coordinates relative to the case's first vertex. Margins are polynomials of at most four nested factors, and a
/// single-precision evaluation from rounded differences makes about 4 roundings per factor. The zone is a property of
/// the input; a kernel with a larger error is at fault.
inline constexpr double grey_factor = 16 * unit_roundoff;

/// A case is *near* a decision boundary if its margin m has |m| ≤ 2¹¹ u Σ|∂m/∂δᵢ||δᵢ|, that is, 2¹⁰ ulp; the grey zone
/// has 16 u there. Reports count near cases; verdicts do not depend on them.
inline constexpr double near_factor = 0x1p11 * unit_roundoff;

}  // namespace ogc::compare
