/* Stages whose input is a whole scene. */
#ifndef OGC_COMPARE_PLUGIN_SCENES_H
#define OGC_COMPARE_PLUGIN_SCENES_H

#include "compare/plugin/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* An edge with exactly two triangles; opposite[k] is the vertex of triangles[k] that is not on the edge. */
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
  int32_t vertex[3]; /* the last is -1 if ratio is 0 */
  float stiffness, rest_length, damping, ratio;
} ogc_scene_spring;

/* Settings of compare/problem/settings.hpp. */
typedef struct ogc_settings {
  float time_step, contact_radius, detection_radius_cap, bounds_relaxation, detection_fraction, friction_velocity;
  float settled_move; /* 0: a step has all its iterations */
  int64_t iterations, detection_every, detection_gap, guess_rounds;
  int64_t lanes;                            /* width of sums; 0: the library chooses */
  int64_t contact_activation, damping_form; /* OGC_ACTIVATION_…, OGC_DAMPING_… */
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
  const void* reserved[8]; /* null; later versions may use them for rods, volumes and pairs of bodies */
} ogc_scene;

/* ---- rest_state: what is computed once from the rest shape ------------------------------------------------------- */

/* The rest state as stage sweep reads it. Lists have the order of the topology, without fixed bodies, models `none` and
 * triangles of solids; tetrahedra have the order of the scene. */
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
      *meeting_friction;            /* [body_count * body_count] for bodies a and b at a * body_count + b */
  const int32_t (*solid_corner)[4]; /* [tetrahedron_count] */
  const int32_t* solid_body;        /* [tetrahedron_count] */
  const float *volume, *inverse;    /* [tetrahedron_count] V and 1 / (6 V) */
  const float (*solid_weight)[6];   /* [tetrahedron_count] V grad N_k . grad N_l for the pairs 01, 02, 03, 12, 13, 23 */
  const float (*solid_gradient)[3][3]; /* [tetrahedron_count] of N_1, N_2, N_3 */
  const void* reserved[8];             /* null */
} ogc_rest;

/* The rest state to write. Each list has room for its capacity; set its count, as for contacts. */
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
  const ogc_edge_edge_contact* edge_edge;       /* [edge_edge_count] found at X_prev, sorted */
} ogc_sweep_in;

typedef struct ogc_sweep_out {
  ogc_vec3* position; /* [vertex_count] each within its bound of X_prev, exactly */
  int32_t* cut;       /* [1] number of proposals beyond their bound */
} ogc_sweep_out;

OGC_PLUGIN_EXPORT int ogc_sweep(const ogc_sweep_in* in, ogc_sweep_out* out);

/* ---- step: a whole step, reported event by event ----------------------------------------------------------------- */

typedef struct ogc_step_in {
  ogc_scene scene;
  const ogc_vec3 *start, *velocity; /* [vertex_count] */
  const ogc_vec3* prescribed;       /* [vertex_count] targets of prescribed vertices; `start` for others */
} ogc_step_in;

/* Values of `kind` of an event. */
enum { OGC_DETECTION, OGC_GUESS, OGC_SWEEP };

/* Lists have room for their capacities; set their counts, as for contacts. The i-th detection is the i-th event of that
 * kind. The two lists of contacts contain the contacts of all detections; those of a detection end at its
 * `vertex_facet_end` and `edge_edge_end`. */
typedef struct ogc_step_out {
  ogc_rest_state_out rest;                /* of the sweeps */
  int32_t* colour;                        /* [vertex_count] of the sweeps; -1: prescribed or fixed */
  float* query_radius;                    /* [1] */
  ogc_vec3 *target, *position, *velocity; /* [vertex_count] y, and the end of the step */
  int64_t event_capacity, event_count;
  int32_t* kind;            /* [event_count] */
  int32_t* cut;             /* [event_count] for guess and sweep; 0 for a detection */
  ogc_vec3* event_position; /* [event_count][vertex_count] after the event; X_prev for a detection */
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
