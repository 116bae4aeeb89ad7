/* Your kernel before the judge: a shared library that offers one or more stages, in C, so that any language and
 * compiler will do.
 *
 *     #include "compare/plugin.h"
 *     OGC_PLUGIN("mine", OGC_HOST_MEMORY)
 *     int ogc_truncate(const ogc_truncate_in* in, ogc_truncate_out* out) { … return 0; }
 *
 *     g++ -O2 -shared -fPIC -I INCLUDE mine.cpp -o mine.so && ogc compare truncate --plugin ./mine.so
 *
 * The library offers the stages whose functions it defines. What a stage asks, to the last boundary case, stands in
 * compare/stages/STAGE.hpp; the structures here are the same questions and answers as plain arrays. A page that starts
 * from an empty file: experiments/plugins/README.md.
 *
 * Rules. A function answers all cases of `in`, writes every element of every array of `out` and nothing else, and
 * returns 0; any other value means that it failed, and is reported. Arrays of `in` are read-only. All arrays lie in the
 * memory that the library asked for: with OGC_DEVICE_MEMORY every pointer inside `in` and `out` is CUDA device memory
 * of the primary context of device 0, current when the function is called; the two structures themselves are in host
 * memory always. A function may return before the device has finished: the caller synchronises, and counts the time.
 * Calls come from one thread, one after another; a function may keep what it likes from call to call. Nothing is freed
 * by the library but what it has allocated.
 *
 * Units: metres, newtons, joules. float is IEEE single precision; indices are from 0; int64_t n is the number of cases.
 */
#ifndef OGC_COMPARE_PLUGIN_H
#define OGC_COMPARE_PLUGIN_H

#include <stdint.h>

/* Of this interface. A library built for a newer one is refused by name; so is one that is older than the oldest whose
 * structures have this layout, and one with a stage of scenes (rest_state, sweep, step) that is older than the oldest
 * whose scenes have it. (5 has other names for members: `exceeded` for `cut`, `detected` for `previous`. 7 has solids.
 * 8 has ogc_plane, and half-spaces behind the members that ogc_truncate_in had.) */
#define OGC_PLUGIN_VERSION 8
#define OGC_PLUGIN_OLDEST_VERSION 5
#define OGC_PLUGIN_OLDEST_SCENE_VERSION 7

#define OGC_HOST_MEMORY 0
#define OGC_DEVICE_MEMORY 1

#if defined(_WIN32)
#define OGC_PLUGIN_EXPORT __declspec(dllexport)
#else
#define OGC_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What a library says of itself. `version` stays first in every version of this interface. */
typedef struct ogc_plugin_info {
  int32_t version;  /* OGC_PLUGIN_VERSION */
  int32_t memory;   /* OGC_HOST_MEMORY or OGC_DEVICE_MEMORY */
  const char* name; /* for the report */
} ogc_plugin_info;

/* The one function that every library has; the macro defines it. */
OGC_PLUGIN_EXPORT const ogc_plugin_info* ogc_plugin(void);

#ifdef __cplusplus
#define OGC_PLUGIN(name, memory)                                                \
  extern "C" OGC_PLUGIN_EXPORT const ogc_plugin_info* ogc_plugin(void) {        \
    static const ogc_plugin_info info = {OGC_PLUGIN_VERSION, (memory), (name)}; \
    return &info;                                                               \
  }
#else
#define OGC_PLUGIN(name, memory)                                                \
  OGC_PLUGIN_EXPORT const ogc_plugin_info* ogc_plugin(void) {                   \
    static const ogc_plugin_info info = {OGC_PLUGIN_VERSION, (memory), (name)}; \
    return &info;                                                               \
  }
#endif

typedef struct ogc_vec3 {
  float x, y, z;
} ogc_vec3;

/* ---- closest_face: which face of a closed triangle holds the point closest to a given point ---------------------- */

/* Values of `feature`: corners, edges from corner k to corner k+1, the interior. On a plane between two of them the
 * lower-dimensional one wins. */
enum { OGC_CORNER_0, OGC_CORNER_1, OGC_CORNER_2, OGC_EDGE_01, OGC_EDGE_12, OGC_EDGE_20, OGC_INTERIOR };

typedef struct ogc_closest_face_in {
  int64_t n;
  const ogc_vec3* point;         /* [n] */
  const ogc_vec3 (*triangle)[3]; /* [n] */
} ogc_closest_face_in;

typedef struct ogc_closest_face_out {
  uint8_t* feature;      /* [n] */
  float (*weights)[3];   /* [n] barycentric weights of the closest point, >= 0 */
  float* distance;       /* [n] nearest */
  float* distance_below; /* [n] never above the exact distance */
} ogc_closest_face_out;

OGC_PLUGIN_EXPORT int ogc_closest_face(const ogc_closest_face_in* in, ogc_closest_face_out* out);

/* ---- closest_points: the closest points of two closed edges ------------------------------------------------------ */

enum { OGC_END_0, OGC_END_1, OGC_EDGE_INTERIOR };

typedef struct ogc_closest_points_in {
  int64_t n;
  const ogc_vec3 (*first)[2], (*second)[2]; /* [n] */
} ogc_closest_points_in;

typedef struct ogc_closest_points_out {
  uint8_t *first_feature, *second_feature; /* [n] */
  uint8_t* nearly_parallel;                /* [n] 0 or 1 */
  float (*parameters)[2];                  /* [n] of the contact points, in [0, 1] from end 0 to end 1 */
  float* contact_distance;                 /* [n] between the contact points, nearest */
  float* distance_below;                   /* [n] never above the exact distance of the two edges */
} ogc_closest_points_out;

OGC_PLUGIN_EXPORT int ogc_closest_points(const ogc_closest_points_in* in, ogc_closest_points_out* out);

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

/* Row i is items[offsets[i]] … items[offsets[i + 1] - 1], ascending. */
typedef struct ogc_rows {
  const int32_t* offsets; /* [rows + 1] */
  const int32_t* items;
} ogc_rows;

/* Edges are numbered by smaller, then larger vertex. */
typedef struct ogc_topology {
  int32_t vertex_count, edge_count, triangle_count;
  const int32_t (*edges)[2];                                  /* [edge_count] smaller vertex first */
  const int32_t (*triangles)[3];                              /* [triangle_count] */
  const int32_t (*triangle_edges)[3];                         /* [triangle_count] from corner k to corner k+1 */
  ogc_rows vertex_edges, vertex_triangles, vertex_neighbours; /* rows by vertex */
  ogc_rows edge_triangles, edge_opposite; /* rows by edge; edge_opposite: vertices that share a triangle with it */
} ogc_topology;

/* ---- detect_vertex_facet, detect_edge_edge: contact sets and smallest distances ---------------------------------- */

/* Values of `kind` of a face. */
enum { OGC_FACE_VERTEX, OGC_FACE_EDGE, OGC_FACE_TRIANGLE };

typedef struct ogc_detect_in {
  ogc_topology topology;
  const int32_t* rigid_groups; /* [vertex_count] a pair whose vertices all carry one number >= 0 is left out */
  ogc_rows excluded_partners;  /* rows by vertex, nearly all empty: a pair is left out where a vertex of one side stands
                                  in the row of one of the other */
  const ogc_vec3* positions;   /* [vertex_count] */
  float contact_radius;        /* r */
  float query_radius;          /* r_q >= r */
  const uint8_t* inside_solid; /* [vertex_count] 1: inside a solid, takes no part; since version 7 */
} ogc_detect_in;

typedef struct ogc_vertex_facet_contact {
  int32_t vertex;
  int32_t kind, face; /* the face, by kind and number */
  int32_t owner;      /* the lowest-numbered triangle that contains the face */
} ogc_vertex_facet_contact;

/* `contacts` has room for `capacity`; set `count` to the number found. Where that is more than the capacity, nothing
 * need be written: the function is called once more with room for as many. In any order, each contact once. */
typedef struct ogc_detect_vertex_facet_out {
  ogc_vertex_facet_contact* contacts;
  int64_t capacity, count;
  float* d_min_vertex;   /* [vertex_count] over non-adjacent triangles, at most r_q, never above the exact value */
  float* d_min_triangle; /* [triangle_count] over non-adjacent vertices, likewise */
} ogc_detect_vertex_facet_out;

OGC_PLUGIN_EXPORT int ogc_detect_vertex_facet(const ogc_detect_in* in, ogc_detect_vertex_facet_out* out);

/* Two faces of the edge-only manifold, vertices or edges, the lower (by kind, then number) first; the lowest-numbered
 * edges that generate the pair. */
typedef struct ogc_edge_edge_contact {
  int32_t first_kind, first_face;
  int32_t second_kind, second_face;
  int32_t first_edge, second_edge;
} ogc_edge_edge_contact;

typedef struct ogc_detect_edge_edge_out {
  ogc_edge_edge_contact* contacts; /* as above */
  int64_t capacity, count;
  float* d_min_edge; /* [edge_count] over non-adjacent edges, at most r_q, never above the exact value */
} ogc_detect_edge_edge_out;

OGC_PLUGIN_EXPORT int ogc_detect_edge_edge(const ogc_detect_in* in, ogc_detect_edge_edge_out* out);

/* ---- bound: how far each vertex may move without touching anything ----------------------------------------------- */

typedef struct ogc_bound_in {
  ogc_topology topology;
  const float *d_min_vertex, *d_min_edge, *d_min_triangle; /* [vertex_count], [edge_count], [triangle_count] */
  float bound_relaxation;                                  /* gamma_p */
  const uint8_t* inside_solid;                             /* [vertex_count] as in ogc_detect_in */
} ogc_bound_in;

typedef struct ogc_bound_out {
  float* bound; /* [vertex_count] never above gamma_p times the smallest distance of the vertex, its edges and its
                   triangles; of a vertex inside a solid, which nothing bounds, the largest finite number */
} ogc_bound_out;

OGC_PLUGIN_EXPORT int ogc_bound(const ogc_bound_in* in, ogc_bound_out* out);

/* ---- plane: half-spaces of near pairs, a ball for the others ---------------------------------------------------- */

typedef struct ogc_plane_in {
  ogc_topology topology;
  const int32_t* rigid_groups; /* as in ogc_detect_in */
  ogc_rows excluded_partners;  /* likewise */
  const ogc_vec3* positions;   /* [vertex_count] */
  const uint8_t* is_fixed;     /* [vertex_count] 1: never moves, and bears no plane */
  float query_radius;          /* r_q */
  float bound_relaxation;      /* gamma_p */
  const uint8_t* inside_solid; /* [vertex_count] as in ogc_detect_in */
} ogc_plane_in;

/* Values of `kind` of a pair: `first` is a vertex and `second` a triangle, or both are edges, first < second. */
enum { OGC_VERTEX_TRIANGLE_PAIR, OGC_EDGE_EDGE_PAIR };

/* normal . x <= offset, borne by a vertex of the pair: the vertices of one side have a normal n, those of the other -n,
 * bit by bit. */
typedef struct ogc_vertex_plane {
  int32_t vertex;
  int32_t kind, first, second;
  ogc_vec3 normal;
} ogc_vertex_plane;

/* Pairs nearer than the 17th nearest of each of their vertices need a plane; more may have one. `planes` and `offset`
 * have room for `capacity`, as lists of contacts do; in any order, each vertex of each pair once. A bound is never
 * above gamma_p times r_q, nor times the distance of a pair of the vertex that no plane holds apart. */
typedef struct ogc_plane_out {
  ogc_vertex_plane* planes;
  double* offset; /* of each of them */
  int64_t capacity, count;
  float* bound; /* [vertex_count] */
} ogc_plane_out;

OGC_PLUGIN_EXPORT int ogc_plane(const ogc_plane_in* in, ogc_plane_out* out);

/* ---- activation: contact energy over distance -------------------------------------------------------------------- */

/* Which energy. */
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

/* ---- truncate: a vertex kept within its bound -------------------------------------------------------------------- */

/* normal . x <= offset */
typedef struct ogc_half_space {
  ogc_vec3 normal;
  double offset;
} ogc_half_space;

/* Libraries without ogc_plane are asked about balls alone. What follows `bound` is there since version 8. */
typedef struct ogc_truncate_in {
  int64_t n;
  const ogc_vec3 *previous, *position; /* [n] */
  const float* bound;                  /* [n] b >= 0 */
  const int32_t* half_space_offsets;   /* [n + 1] those of case i: half_spaces[offsets[i]] ... [offsets[i + 1] - 1] */
  const ogc_half_space* half_spaces;
  const ogc_vec3* current;      /* [n] where the vertex is, in its region */
  const float (*block)[6];      /* [n] H: xx, xy, xz, yy, yz, zz; positive definite */
  const uint8_t* is_prescribed; /* [n] 1: it does not slide, and H is not to be read */
} ogc_truncate_in;

typedef struct ogc_truncate_out {
  ogc_vec3* position; /* [n] as stored, |position - previous| <= bound and each half-space kept exactly; bit for bit
                         what came in where nothing is cut */
  uint8_t* cut;       /* [n] 1 where the given position was farther than the bound, or beyond a half-space */
} ogc_truncate_out;

OGC_PLUGIN_EXPORT int ogc_truncate(const ogc_truncate_in* in, ogc_truncate_out* out);

/* ---- membrane, bending, tetrahedron, …: force and block of one vertex of one stencil ----------------------------- */

enum { OGC_MEMBRANE_NONE, OGC_ST_VENANT_KIRCHHOFF, OGC_STABLE_NEO_HOOKEAN };
enum { OGC_BENDING_NONE, OGC_DISCRETE_HINGE, OGC_ISOMETRIC_QUADRATIC };
enum { OGC_DAMPING_OF_STRAIN, OGC_DAMPING_PER_VERTEX };

typedef struct ogc_membrane_case {
  ogc_vec3 corner[3], start[3]; /* asked about corner 0 */
  float gradient[2][2];         /* of N_1, N_2; that of N_0 is minus their sum */
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
  int32_t own; /* which vertex is asked about */
  int32_t model;
  float weight[3]; /* isometric quadratic: of x1, o0, o1; that of x0 is minus their sum */
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
  int32_t own; /* which vertex is asked about */
  int64_t damping_form;
} ogc_spring_case;

typedef struct ogc_spring_in {
  int64_t n;
  const ogc_spring_case* cases; /* [n] */
} ogc_spring_in;

typedef struct ogc_tetrahedron_case {
  ogc_vec3 corner[4], start[4]; /* asked about corner 0; at rest det(x1 - x0, x2 - x0, x3 - x0) > 0 */
  float weight[3];              /* V grad N_k . grad N_0 of corners 1, 2, 3 */
  float inverse;                /* 1 / (6 V) */
  float gradient[3][3];         /* of N_1, N_2, N_3; that of N_0 is minus their sum; of the damping */
  float volume;                 /* V of the damping */
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
/* A library that has it is asked about scenes with solids, too. */
OGC_PLUGIN_EXPORT int ogc_tetrahedron(const ogc_tetrahedron_in* in, ogc_force_out* out);

/* The faces that meet in a contact, and their vertices: first side | second side. */
enum {
  OGC_POINT_POINT /* 0 | 1 */,
  OGC_POINT_EDGE /* 0 | 1 2 */,
  OGC_EDGE_EDGE /* 0 1 | 2 3 */,
  OGC_POINT_TRIANGLE /* 0 | 1 2 3 */
};

typedef struct ogc_contact_force_case {
  uint8_t sides;
  int32_t own;
  ogc_vec3 vertex[4], previous[4];
  float rest_squared[2]; /* 0 of an edge without triangles: compare/stages/contact_force.hpp */
  float contact_radius, stiffness;
  int64_t activation;
  uint8_t together; /* bit k: vertex k is updated together with the own one */
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

/* ---- initial_guess: one round of the guess loop for one vertex --------------------------------------------------- */

typedef struct ogc_initial_guess_case {
  ogc_vec3 start, velocity, acceleration;
  float time_step;
  ogc_vec3 previous;
  float bound;
  uint8_t held;
} ogc_initial_guess_case;

typedef struct ogc_initial_guess_in {
  int64_t n;
  const ogc_initial_guess_case* cases; /* [n] */
} ogc_initial_guess_in;

typedef struct ogc_initial_guess_out {
  ogc_vec3 *target, *position; /* [n] y, and x */
  uint8_t* cut;                /* [n] */
} ogc_initial_guess_out;

OGC_PLUGIN_EXPORT int ogc_initial_guess(const ogc_initial_guess_in* in, ogc_initial_guess_out* out);

/* ---- block: is a point in the block of a face? ------------------------------------------------------------------- */

enum { OGC_VERTEX_IN_SURFACE, OGC_EDGE_IN_EDGES };

typedef struct ogc_block_question {
  uint8_t kind;
  int32_t of;
  uint8_t face_kind;
  int32_t face;
} ogc_block_question;

typedef struct ogc_block_in {
  ogc_topology topology;
  const ogc_vec3* positions; /* [vertex_count] */
  int64_t n;
  const ogc_block_question* questions; /* [n] */
} ogc_block_in;

typedef struct ogc_block_out {
  uint8_t* inside; /* [n] 0 or 1 */
} ogc_block_out;

OGC_PLUGIN_EXPORT int ogc_block(const ogc_block_in* in, ogc_block_out* out);

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* An edge with exactly two triangles; opposite[k]: the vertex of triangles[k] that is not on it. */
typedef struct ogc_hinge {
  int32_t edge, triangles[2], opposite[2];
} ogc_hinge;

/* A range of vertices, triangles and tetrahedra with one material. The triangles of a body with tetrahedra are their
 * boundary: they meet other surfaces, but have neither mass nor energies of their own. */
typedef struct ogc_body {
  int32_t first_vertex, vertex_count, first_triangle, triangle_count, first_tetrahedron, tetrahedron_count;
  int32_t fixed;             /* 1: never moves, has no energies */
  int32_t membrane, bending; /* OGC_MEMBRANE_NONE, …, OGC_BENDING_NONE, … */
  float density, lame_lambda, lame_mu, membrane_damping, bending_stiffness, bending_damping, contact_stiffness,
      friction;
  float solid_density, solid_lambda, solid_mu, solid_damping; /* of the volume */
} ogc_body;

typedef struct ogc_scene_spring {
  int32_t vertex[3]; /* the last is -1 where ratio is 0 */
  float stiffness, rest_length, damping, ratio;
} ogc_scene_spring;

/* As in compare/problem/settings.hpp. */
typedef struct ogc_settings {
  float time_step, contact_radius, query_radius_cap, bound_relaxation, redetect_fraction, friction_velocity;
  int64_t iterations, redetect_every, guess_rounds;
  int64_t lanes;                    /* width of sums; 0: as you like */
  int64_t activation, damping_form; /* OGC_ACTIVATION_…, OGC_DAMPING_… */
} ogc_settings;

typedef struct ogc_scene {
  ogc_topology topology;
  int32_t hinge_count, body_count, spring_count, tetrahedron_count;
  const ogc_hinge* hinges;         /* [hinge_count] */
  const ogc_body* bodies;          /* [body_count] cover all vertices, triangles and tetrahedra, in order */
  const ogc_scene_spring* springs; /* [spring_count] */
  const ogc_vec3* rest_positions;  /* [vertex_count] */
  const int32_t* rigid_groups;     /* [vertex_count] -1: free; 0: fixed; k >= 1: prescribed, by the k-th motion */
  ogc_rows excluded_partners;      /* as in ogc_detect_in */
  const int32_t (*tetrahedra)[4];  /* [tetrahedron_count] of positive volume at rest */
  const uint8_t* inside_solid;     /* [vertex_count] as in ogc_detect_in */
  ogc_settings settings;
  ogc_vec3 gravity;
  const void* reserved[8]; /* null: for rods, volumes and pairs of bodies */
} ogc_scene;

/* ---- rest_state: what is computed once of the rest shape --------------------------------------------------------- */

/* The rest state as sweep reads it; lists in the order of the topology, without fixed bodies and without models `none`.
 * The triangles of solids are not in it, and their tetrahedra are in the order of the scene's. */
typedef struct ogc_rest {
  const float* mass; /* [vertex_count] */
  int32_t triangle_count, hinge_count, tetrahedron_count;
  const int32_t (*corner)[3];                /* [triangle_count] */
  const int32_t* triangle_body;              /* [triangle_count] */
  const float* area;                         /* [triangle_count] */
  const float (*gradient)[2][2];             /* [triangle_count] of N_1, N_2 */
  const int32_t (*hinge_vertex)[4];          /* [hinge_count] x0 < x1 of the edge, the opposite vertices */
  const int32_t* hinge_body;                 /* [hinge_count] */
  const float *rest_angle, *hinge_stiffness; /* [hinge_count] */
  const float (*weight)[3];                  /* [hinge_count] isometric quadratic: of x1, o0, o1; otherwise 0 */
  const float* edge_length_squared;          /* [edge_count] */
  const float *meeting_stiffness,
      *meeting_friction;            /* [body_count * body_count] of bodies a and b at a * body_count + b */
  const int32_t (*solid_corner)[4]; /* [tetrahedron_count] */
  const int32_t* solid_body;        /* [tetrahedron_count] */
  const float *volume, *inverse;    /* [tetrahedron_count] V and 1 / (6 V) */
  const float (*solid_weight)[6];   /* [tetrahedron_count] V grad N_k . grad N_l of the pairs 01, 02, 03, 12, 13, 23 */
  const float (*solid_gradient)[3][3]; /* [tetrahedron_count] of N_1, N_2, N_3 */
  const void* reserved[8];             /* null */
} ogc_rest;

/* Likewise, to be written. A list has room for its capacity; set its count, as with contacts. */
typedef struct ogc_rest_state_out {
  float* mass;
  int64_t triangle_capacity, triangle_count, hinge_capacity, hinge_count, tetrahedron_capacity, tetrahedron_count;
  int32_t (*corner)[3];
  int32_t* triangle_body;
  float* area;
  float (*gradient)[2][2];
  int32_t (*hinge_vertex)[4];
  int32_t* hinge_body;
  float *rest_angle, *hinge_stiffness;
  float (*weight)[3];
  float* edge_length_squared;
  float *meeting_stiffness, *meeting_friction;
  int32_t (*solid_corner)[4];
  int32_t* solid_body;
  float *volume, *inverse;
  float (*solid_weight)[6];
  float (*solid_gradient)[3][3];
  void* reserved[8]; /* null */
} ogc_rest_state_out;

OGC_PLUGIN_EXPORT int ogc_rest_state(const ogc_scene* in, ogc_rest_state_out* out);

/* ---- sweep: one iteration over all colours ----------------------------------------------------------------------- */

typedef struct ogc_sweep_in {
  ogc_scene scene;
  ogc_rest rest;
  const int32_t* colour;                           /* [vertex_count] -1: prescribed or fixed */
  const ogc_vec3 *old, *start, *target, *previous; /* [vertex_count] x, x at the start of the step, y, X_prev */
  const float* bound;                              /* [vertex_count] */
  int64_t vertex_facet_count, edge_edge_count;
  const ogc_vertex_facet_contact* vertex_facet; /* [vertex_facet_count] found at X_prev, sorted */
  const ogc_edge_edge_contact* edge_edge;       /* [edge_edge_count] likewise */
} ogc_sweep_in;

typedef struct ogc_sweep_out {
  ogc_vec3* position; /* [vertex_count] each within its bound of X_prev, exactly */
  int32_t* cut;       /* [1] how many proposals lay beyond their bound */
} ogc_sweep_out;

OGC_PLUGIN_EXPORT int ogc_sweep(const ogc_sweep_in* in, ogc_sweep_out* out);

/* ---- step: a whole step, told event by event --------------------------------------------------------------------- */

typedef struct ogc_step_in {
  ogc_scene scene;
  const ogc_vec3 *start, *velocity; /* [vertex_count] */
  const ogc_vec3* prescribed;       /* [vertex_count] where prescribed vertices are to go; of others `start` */
} ogc_step_in;

/* Values of `kind` of an event. */
enum { OGC_DETECTION, OGC_GUESS, OGC_SWEEP };

/* Lists have room for their capacities; set their counts, as with contacts. The i-th detection is the i-th event of
 * that kind. Of all detections together are the two lists of contacts: those of the i-th end where `vertex_facet_end`
 * and `edge_edge_end` say. */
typedef struct ogc_step_out {
  ogc_rest_state_out rest;                /* of the sweeps */
  int32_t* colour;                        /* [vertex_count] of the sweeps; -1: prescribed or fixed */
  float* query_radius;                    /* [1] */
  ogc_vec3 *target, *position, *velocity; /* [vertex_count] y, and the end of the step */
  int64_t event_capacity, event_count;
  int32_t* kind;            /* [event_count] */
  int32_t* cut;             /* [event_count] of guess and sweep; of a detection 0 */
  ogc_vec3* event_position; /* [event_count][vertex_count] after the event; of a detection X_prev */
  int64_t detection_capacity, detection_count;
  float *d_min_vertex, *bound;               /* [detection_count][vertex_count] */
  float* d_min_triangle;                     /* [detection_count][triangle_count] */
  float* d_min_edge;                         /* [detection_count][edge_count] */
  int32_t *vertex_facet_end, *edge_edge_end; /* [detection_count] */
  int64_t vertex_facet_capacity, vertex_facet_count, edge_edge_capacity, edge_edge_count;
  ogc_vertex_facet_contact* vertex_facet;
  ogc_edge_edge_contact* edge_edge;
} ogc_step_out;

OGC_PLUGIN_EXPORT int ogc_step(const ogc_step_in* in, ogc_step_out* out);

#ifdef __cplusplus
}
#endif

#endif
