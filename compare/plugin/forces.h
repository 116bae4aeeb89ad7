/* Stages of energies, forces and their blocks. */
#ifndef OGC_COMPARE_PLUGIN_FORCES_H
#define OGC_COMPARE_PLUGIN_FORCES_H

#include "compare/plugin/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- activation: contact energy over distance -------------------------------------------------------------------- */

/* Values of `activation`. */
enum {
  OGC_ACTIVATION_OGC,
  OGC_ACTIVATION_OGC_AS_PRINTED,
  OGC_ACTIVATION_QUADRATIC,
  OGC_ACTIVATION_IPC_LOG,
  OGC_ACTIVATION_CUBIC
};

typedef struct ogc_activation_in {
  int64_t n;
  const float *distance, *contact_radius, *stiffness; /* [n] d > 0, r, k_c */
  const int64_t* activation;                          /* [n] */
} ogc_activation_in;

typedef struct ogc_activation_out {
  float *energy, *slope, *curvature; /* [n] g, g', g''; 0 for d >= r */
} ogc_activation_out;

OGC_PLUGIN_EXPORT int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out);

/* ---- barrier: IPC's barrier over the squared distance ------------------------------------------------------------ */

typedef struct ogc_barrier_in {
  int64_t n;
  const float *squared_distance, *activation_distance, *thickness; /* [n] D, d^, xi */
} ogc_barrier_in;

/* With g = D - xi^2 and H = d^ (d^ + 2 xi): b = -(g - H)^2 ln(g/H), db/dD and d2b/dD2; 0 for g >= H. */
typedef struct ogc_barrier_out {
  float *energy, *slope, *curvature; /* [n] */
} ogc_barrier_out;

OGC_PLUGIN_EXPORT int ogc_barrier(const ogc_barrier_in* in, ogc_barrier_out* out);

/* ---- membrane, bending, tetrahedron, …: force and block of one vertex of one stencil ----------------------------- */

enum { OGC_MEMBRANE_NONE, OGC_ST_VENANT_KIRCHHOFF, OGC_STABLE_NEO_HOOKEAN };
enum { OGC_BENDING_NONE, OGC_DISCRETE_HINGE, OGC_ISOMETRIC_QUADRATIC };
enum { OGC_DAMPING_OF_STRAIN, OGC_DAMPING_PER_VERTEX };

typedef struct ogc_membrane_case {
  ogc_vec3 corner[3], start[3]; /* the answer is about corner 0 */
  float gradient[2][2];         /* of N_1, N_2; the gradient of N_0 is minus their sum */
  float area, lame_lambda, lame_mu, damping;
  int32_t model;
  int64_t damping_form;
} ogc_membrane_case;

typedef struct ogc_membrane_in {
  int64_t n;
  const ogc_membrane_case* cases; /* [n] */
} ogc_membrane_in;

typedef struct ogc_bending_case {
  ogc_vec3 vertex[4], start[4];
  float stiffness, rest_angle, damping;
  int32_t own; /* the vertex whose force and block are returned */
  int32_t model;
  float weight[3]; /* isometric quadratic: of x1, o0, o1; the weight of x0 is minus their sum */
  int64_t damping_form;
} ogc_bending_case;

typedef struct ogc_bending_in {
  int64_t n;
  const ogc_bending_case* cases; /* [n] */
} ogc_bending_in;

typedef struct ogc_spring_case {
  ogc_vec3 vertex[3], start[3];
  float stiffness, rest_length, damping;
  float ratio; /* s: between vertex 0 and the point (1 - s) vertex 1 + s vertex 2; 0: vertex 2 is not read */
  int32_t own; /* the vertex whose force and block are returned */
  int64_t damping_form;
} ogc_spring_case;

typedef struct ogc_spring_in {
  int64_t n;
  const ogc_spring_case* cases; /* [n] */
} ogc_spring_in;

typedef struct ogc_tetrahedron_case {
  ogc_vec3 corner[4], start[4]; /* the answer is about corner 0; at rest det(x1 - x0, x2 - x0, x3 - x0) > 0 */
  float weight[3];              /* V grad N_k . grad N_0 for corners 1, 2, 3 */
  float inverse;                /* 1 / (6 V) */
  float gradient[3][3];         /* of N_1, N_2, N_3, for damping; the gradient of N_0 is minus their sum */
  float volume;                 /* V, for damping */
  float lame_lambda, lame_mu, damping;
  int64_t damping_form;
} ogc_tetrahedron_case;

typedef struct ogc_tetrahedron_in {
  int64_t n;
  const ogc_tetrahedron_case* cases; /* [n] */
} ogc_tetrahedron_in;

typedef struct ogc_force_out {
  ogc_vec3* force;   /* [n] minus the energy's derivative */
  float (*block)[6]; /* [n] xx, xy, xz, yy, yz, zz */
} ogc_force_out;

OGC_PLUGIN_EXPORT int ogc_membrane(const ogc_membrane_in* in, ogc_force_out* out);
OGC_PLUGIN_EXPORT int ogc_bending(const ogc_bending_in* in, ogc_force_out* out);
OGC_PLUGIN_EXPORT int ogc_spring(const ogc_spring_in* in, ogc_force_out* out);
/* A library with this function also gets scenes with solids from the judge. */
OGC_PLUGIN_EXPORT int ogc_tetrahedron(const ogc_tetrahedron_in* in, ogc_force_out* out);

/* The kinds of the faces in contact, and indices of their vertices: first face | second face. */
enum {
  OGC_POINT_POINT /* 0 | 1 */,
  OGC_POINT_EDGE /* 0 | 1 2 */,
  OGC_EDGE_EDGE /* 0 1 | 2 3 */,
  OGC_POINT_TRIANGLE /* 0 | 1 2 3 */
};

/* Beyond d = r there is no force, and the block has the curvature at r. */
typedef struct ogc_contact_force_case {
  uint8_t sides;
  int32_t own;
  ogc_vec3 vertex[4], previous[4];
  float rest_squared[2]; /* 0 for an edge without triangles (compare/stages/contact_force.hpp) */
  float contact_radius, stiffness;
  int64_t activation;
  uint8_t together; /* bit k: vertex k is updated together with `own` */
} ogc_contact_force_case;

typedef struct ogc_contact_force_in {
  int64_t n;
  const ogc_contact_force_case* cases; /* [n] */
} ogc_contact_force_in;

typedef struct ogc_friction_force_case {
  ogc_contact_force_case contact;
  ogc_vec3 start[4];
  float friction, slip_limit;
} ogc_friction_force_case;

typedef struct ogc_friction_force_in {
  int64_t n;
  const ogc_friction_force_case* cases; /* [n] */
} ogc_friction_force_in;

OGC_PLUGIN_EXPORT int ogc_contact_force(const ogc_contact_force_in* in, ogc_force_out* out);
OGC_PLUGIN_EXPORT int ogc_friction_force(const ogc_friction_force_in* in, ogc_force_out* out);

/* A point, vertex 0, and the triangle of a volume that pushes it out, vertices 1 2 3. The answer is the sum of normal
 * part and friction, for force and block: compare/stages/volume_force.hpp. */
typedef struct ogc_volume_force_case {
  int32_t own; /* the vertex whose force and block are returned */
  ogc_vec3 vertex[4], start[4];
  float weights[3];   /* of the closest point, by corner */
  float direction[3]; /* n, out of the volume */
  float contact_radius, stiffness, friction, slip_limit;
} ogc_volume_force_case;

typedef struct ogc_volume_force_in {
  int64_t n;
  const ogc_volume_force_case* cases; /* [n] */
} ogc_volume_force_in;

OGC_PLUGIN_EXPORT int ogc_volume_force(const ogc_volume_force_in* in, ogc_force_out* out);

#ifdef __cplusplus
}
#endif

#endif
