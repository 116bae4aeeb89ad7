/* Stages of distances, contacts, bounds and impacts. */
#ifndef OGC_COMPARE_PLUGIN_GEOMETRY_H
#define OGC_COMPARE_PLUGIN_GEOMETRY_H

#include "compare/plugin/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- closest_face: the face of a closed triangle that contains the point closest to a given point ---------------- */

/* Values of `feature`: corners, edges from corner k to corner k+1, the interior. If two features are equally near, the
 * lower-dimensional one is the answer. */
enum { OGC_CORNER_0, OGC_CORNER_1, OGC_CORNER_2, OGC_EDGE_01, OGC_EDGE_12, OGC_EDGE_20, OGC_INTERIOR };

typedef struct ogc_closest_face_in {
  int64_t n;
  const ogc_vec3* point;         /* [n] */
  const ogc_vec3 (*triangle)[3]; /* [n] */
} ogc_closest_face_in;

typedef struct ogc_closest_face_out {
  uint8_t* feature;      /* [n] */
  float (*weights)[3];   /* [n] barycentric weights of the closest point, >= 0 */
  float* distance;       /* [n] rounded to nearest */
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
  float* contact_distance;                 /* [n] between the contact points, rounded to nearest */
  float* distance_below;                   /* [n] never above the exact distance of the two edges */
} ogc_closest_points_out;

OGC_PLUGIN_EXPORT int ogc_closest_points(const ogc_closest_points_in* in, ogc_closest_points_out* out);

/* ---- detect_vertex_facet, detect_edge_edge: contact sets and smallest distances ---------------------------------- */

/* Values of `kind` of a face. */
enum { OGC_FACE_VERTEX, OGC_FACE_EDGE, OGC_FACE_TRIANGLE };

typedef struct ogc_detect_in {
  ogc_topology topology;
  const int32_t* rigid_groups; /* [vertex_count] a pair whose vertices all have one number >= 0 is excluded */
  ogc_rows
      excluded_partners; /* rows by vertex, nearly all empty: a pair is excluded if a vertex of one side is in the row
                                  of a vertex of the other */
  const ogc_vec3* positions;   /* [vertex_count] */
  float contact_radius;        /* r */
  float query_radius;          /* r_q >= r */
  const uint8_t* inside_solid; /* [vertex_count] 1: inside a solid, so that it has no contacts */
} ogc_detect_in;

typedef struct ogc_vertex_facet_contact {
  int32_t vertex;
  int32_t kind, face; /* the face, by kind and number */
  int32_t owner;      /* the lowest-numbered triangle that contains the face */
} ogc_vertex_facet_contact;

/* `contacts` has room for `capacity` contacts; set `count` to the number found. If that is more than the capacity,
 * nothing need be written, and the function is called again with enough room. Contacts may have any order; list each
 * once. */
typedef struct ogc_detect_vertex_facet_out {
  ogc_vertex_facet_contact* contacts;
  int64_t capacity, count;
  float* d_min_vertex;   /* [vertex_count] over non-adjacent triangles, at most r_q, never above the exact value */
  float* d_min_triangle; /* [triangle_count] over non-adjacent vertices, otherwise as d_min_vertex */
} ogc_detect_vertex_facet_out;

OGC_PLUGIN_EXPORT int ogc_detect_vertex_facet(const ogc_detect_in* in, ogc_detect_vertex_facet_out* out);

/* Two faces of the edge-only manifold, vertices or edges, the lower one (by kind, then number) first; and the
 * lowest-numbered edges that generate the pair. */
typedef struct ogc_edge_edge_contact {
  int32_t first_kind, first_face;
  int32_t second_kind, second_face;
  int32_t first_edge, second_edge;
} ogc_edge_edge_contact;

typedef struct ogc_detect_edge_edge_out {
  ogc_edge_edge_contact* contacts; /* room for `capacity`, as in ogc_detect_vertex_facet_out */
  int64_t capacity, count;
  float* d_min_edge; /* [edge_count] over non-adjacent edges, at most r_q, never above the exact value */
} ogc_detect_edge_edge_out;

OGC_PLUGIN_EXPORT int ogc_detect_edge_edge(const ogc_detect_in* in, ogc_detect_edge_edge_out* out);

/* ---- bound: how far each vertex may move without touching anything ----------------------------------------------- */

typedef struct ogc_bound_in {
  ogc_topology topology;
  const float *d_min_vertex, *d_min_edge, *d_min_triangle; /* [vertex_count], [edge_count], [triangle_count] */
  float bounds_relaxation;                                 /* gamma_p */
  const uint8_t* inside_solid;                             /* [vertex_count] as in ogc_detect_in */
} ogc_bound_in;

typedef struct ogc_bound_out {
  float* bound; /* [vertex_count] never above gamma_p times the smallest distance of the vertex, its edges and its
                   triangles; the largest finite number for a vertex inside a solid, which needs no bound */
} ogc_bound_out;

OGC_PLUGIN_EXPORT int ogc_bound(const ogc_bound_in* in, ogc_bound_out* out);

/* ---- plane: half-spaces of near pairs, a ball for the others ---------------------------------------------------- */

typedef struct ogc_plane_in {
  ogc_topology topology;
  const int32_t* rigid_groups; /* as in ogc_detect_in */
  ogc_rows excluded_partners;  /* as in ogc_detect_in */
  const ogc_vec3* positions;   /* [vertex_count] */
  const uint8_t* is_fixed;     /* [vertex_count] 1: the vertex never moves, and has no plane */
  float query_radius;          /* r_q */
  float bounds_relaxation;     /* gamma_p */
  const uint8_t* inside_solid; /* [vertex_count] as in ogc_detect_in */
} ogc_plane_in;

/* Values of `kind` of a pair: `first` is a vertex and `second` a triangle, or both are edges, first < second. */
enum { OGC_VERTEX_TRIANGLE_PAIR, OGC_EDGE_EDGE_PAIR };

/* A half-space normal . x <= offset of a vertex of the pair. The vertices of one side have a normal n, those of the
 * other side -n, bit by bit. */
typedef struct ogc_vertex_plane {
  int32_t vertex;
  int32_t kind, first, second;
  ogc_vec3 normal;
} ogc_vertex_plane;

/* A pair needs a plane if it is nearer than the 17th nearest pair of each of its vertices; other pairs may have one.
 * `planes` and `offset` have room for `capacity`, as lists of contacts have; list each vertex of each pair once, in any
 * order. A bound is never above gamma_p r_q, and never above gamma_p times the distance of a pair of the vertex that no
 * plane separates. */
typedef struct ogc_plane_out {
  ogc_vertex_plane* planes;
  double* offset; /* of each plane */
  int64_t capacity, count;
  float* bound; /* [vertex_count] */
} ogc_plane_out;

OGC_PLUGIN_EXPORT int ogc_plane(const ogc_plane_in* in, ogc_plane_out* out);

/* ---- truncate: a vertex kept within its bound -------------------------------------------------------------------- */

/* normal . x <= offset */
typedef struct ogc_half_space {
  ogc_vec3 normal;
  double offset;
} ogc_half_space;

/* Libraries without ogc_plane only get cases without half-spaces from the judge. */
typedef struct ogc_truncate_in {
  int64_t n;
  const ogc_vec3 *previous, *position; /* [n] */
  const float* bound;                  /* [n] b >= 0 */
  const int32_t* half_space_offsets;   /* [n + 1] case i has half_spaces[offsets[i]] ... [offsets[i + 1] - 1] */
  const ogc_half_space* half_spaces;
  const ogc_vec3* current;      /* [n] current position, in its region */
  const float (*block)[6];      /* [n] H: xx, xy, xz, yy, yz, zz; positive definite */
  const uint8_t* is_prescribed; /* [n] 1: the vertex does not slide, and H is not set */
} ogc_truncate_in;

typedef struct ogc_truncate_out {
  ogc_vec3* position; /* [n] as stored, exactly within the bound of `previous` and each half-space; the given
                         position bit for bit if nothing is cut */
  uint8_t* cut;       /* [n] 1 if the given position was farther than the bound, or beyond a half-space */
} ogc_truncate_out;

OGC_PLUGIN_EXPORT int ogc_truncate(const ogc_truncate_in* in, ogc_truncate_out* out);

/* ---- initial_guess: one round of the guess loop for one vertex --------------------------------------------------- */

typedef struct ogc_initial_guess_case {
  ogc_vec3 start, velocity, acceleration;
  float time_step;
  ogc_vec3 previous;
  float bound;
  uint8_t reserved; /* 0 */
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

/* ---- ccd: the time of impact of a vertex and a triangle, or of two edges ---------------------------------------- */

/* Values of `kind`: vertex 0 and triangle 1 2 3, or edges 0 1 and 2 3. */
enum { OGC_CCD_VERTEX_TRIANGLE, OGC_CCD_EDGE_EDGE };

typedef struct ogc_ccd_case {
  uint8_t kind;
  ogc_vec3 from[4], to[4]; /* vertex k is at from + t (to - from) at time t in [0, 1] */
} ogc_ccd_case;

typedef struct ogc_ccd_in {
  int64_t n;
  const ogc_ccd_case* cases; /* [n] */
} ogc_ccd_in;

typedef struct ogc_ccd_out {
  float* time; /* [n] in [0, 1]: the faces share no point before it; 1 if they never meet, 0 if they touch at 0 */
} ogc_ccd_out;

OGC_PLUGIN_EXPORT int ogc_ccd(const ogc_ccd_in* in, ogc_ccd_out* out);

/* ---- volume_depth: the parts of a closed surface that contain a point, or are nearer to it than r --------------- */

typedef struct ogc_volume_depth_in {
  ogc_topology topology;     /* of the volume: each edge has two triangles, or one at a rim */
  const ogc_vec3* positions; /* [vertex_count] */
  float contact_radius;      /* r */
  int64_t n;
  const ogc_vec3* points; /* [n] points to test */
} ogc_volume_depth_in;

/* A contact of a point with a part, that is, with a connected component of the volume; no component is a cavity. */
typedef struct ogc_volume_contact {
  int32_t point;
  int32_t inside;     /* 1: the part contains the point */
  int32_t triangle;   /* the lowest-numbered triangle that contains the face */
  int32_t kind, face; /* the face whose interior holds the closest point, by kind (OGC_FACE_VERTEX, ...) and number */
} ogc_volume_contact;

typedef struct ogc_volume_numbers {
  float weights[3];   /* of the closest point, by corner of the triangle */
  ogc_vec3 direction; /* a unit vector out of the part */
  float depth;        /* distance + r inside, r - distance outside */
} ogc_volume_numbers;

/* `contacts` and `numbers` have room for `capacity`, as lists of contacts have; any order is allowed. */
typedef struct ogc_volume_depth_out {
  ogc_volume_contact* contacts;
  ogc_volume_numbers* numbers; /* of each contact */
  int64_t capacity, count;
} ogc_volume_depth_out;

OGC_PLUGIN_EXPORT int ogc_volume_depth(const ogc_volume_depth_in* in, ogc_volume_depth_out* out);

#ifdef __cplusplus
}
#endif

#endif
