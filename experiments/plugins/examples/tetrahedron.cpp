// A correct plug-in in double precision for the stage tetrahedron: force and block of the stable Neo-Hookean energy at
// one corner, with damping of strain or by vertex. A library with this stage also gets scenes with solids.
//
//     g++ -O2 -shared -fPIC -I INCLUDE tetrahedron.cpp -o tetrahedron.so
//     ogc compare tetrahedron --plugin ./tetrahedron.so
#include <array>

#include "compare/plugin.h"

OGC_PLUGIN("tetrahedron in double", OGC_HOST_MEMORY)

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;
Vector apart(ogc_vec3 a, ogc_vec3 b) { return {double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the deformation gradient F = Σ (x_k − x₀) ∇N_kᵀ.
Matrix deformation(const ogc_tetrahedron_case& c, const ogc_vec3 (&x)[4]) {
  Matrix f{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) f[i][j] += apart(x[k + 1], x[0])[i] * c.gradient[k][j];
  return f;
}

/// Adds force and block of the damping's energy V k ϕ(G − Gᵗ). G = (FᵀF − I)/2 is the strain, Gᵗ the strain at the
/// start of the step, and ϕ(E) = λ/2 (tr E)² + μ tr E².
void add_damping(const ogc_tetrahedron_case& c, Vector& force, Matrix& block) {
  const Matrix f = deformation(c, c.corner), before = deformation(c, c.start);
  const double weight = double(c.volume) * c.damping, lambda = c.lame_lambda, mu = c.lame_mu;
  Matrix change{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) change[i][j] += (f[k][i] * f[k][j] - before[k][i] * before[k][j]) / 2;
  const double trace = change[0][0] + change[1][1] + change[2][2];
  Vector own{}, stressed{};
  for (int i = 0; i < 3; ++i) own[i] = -(double(c.gradient[0][i]) + c.gradient[1][i] + c.gradient[2][i]);
  for (int i = 0; i < 3; ++i) stressed[i] = lambda * trace * own[i] + 2 * mu * dot(change[i], own);
  for (int i = 0; i < 3; ++i) {
    force[i] -= weight * dot(f[i], stressed);
    for (int j = 0; j < 3; ++j)
      block[i][j] += weight * ((lambda + mu) * dot(f[i], own) * dot(f[j], own) + mu * dot(own, own) * dot(f[i], f[j]));
  }
}

void answer(const ogc_tetrahedron_case& c, Vector& force, Matrix& block) {
  const double lambda = c.lame_lambda, mu = c.lame_mu, inverse = c.inverse;
  const Vector n = cross(apart(c.corner[2], c.corner[1]), apart(c.corner[3], c.corner[1]));
  const double j = inverse * dot(n, apart(c.corner[1], c.corner[0])), pressure = (lambda + mu) * (j - 1) - mu;
  for (int i = 0; i < 3; ++i) {
    force[i] = pressure * n[i] / 6;
    for (int k = 0; k < 3; ++k) force[i] -= mu * c.weight[k] * apart(c.corner[k + 1], c.corner[0])[i];
    for (int k = 0; k < 3; ++k) block[i][k] = (lambda + mu) * inverse / 6 * n[i] * n[k];
    block[i][i] -= mu * (double(c.weight[0]) + c.weight[1] + c.weight[2]);
  }
  if (c.damping_form == OGC_DAMPING_OF_STRAIN) return add_damping(c, force, block);
  for (int i = 0; i < 3; ++i) force[i] -= c.damping * dot(block[i], apart(c.corner[0], c.start[0]));
  for (Vector& row : block)
    for (double& b : row) b *= 1 + double(c.damping);
}

}  // namespace

int ogc_tetrahedron(const ogc_tetrahedron_in* in, ogc_force_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    Vector f{};
    Matrix b{};
    answer(in->cases[i], f, b);
    out->force[i] = {float(f[0]), float(f[1]), float(f[2])};
    const double entries[6] = {b[0][0], b[0][1], b[0][2], b[1][1], b[1][2], b[2][2]};
    for (int k = 0; k < 6; ++k) out->block[i][k] = float(entries[k]);
  }
  return 0;
}
