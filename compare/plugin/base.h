/* Defines what all parts of the interface share: version, description of a library, points, meshes. */
#ifndef OGC_COMPARE_PLUGIN_BASE_H
#define OGC_COMPARE_PLUGIN_BASE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface. A library that was built for another version is rejected with a message, because its
 * structures have another layout. */
#define OGC_PLUGIN_VERSION 11

#define OGC_HOST_MEMORY 0
#define OGC_DEVICE_MEMORY 1

#if defined(_WIN32)
#define OGC_PLUGIN_EXPORT __declspec(dllexport)
#else
#define OGC_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/* Description of a library. `version` stays first in every version of this interface. */
typedef struct ogc_plugin_info {
  int32_t version;  /* OGC_PLUGIN_VERSION */
  int32_t memory;   /* OGC_HOST_MEMORY or OGC_DEVICE_MEMORY */
  const char* name; /* name in the report */
} ogc_plugin_info;

/* The only function that every library must have; the macro OGC_PLUGIN defines it. */
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

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

/* Rows of different length: row i is items[offsets[i]] … items[offsets[i + 1] - 1], ascending. */
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
  ogc_rows edge_triangles, edge_opposite; /* rows by edge; edge_opposite: vertices of its triangles opposite to it */
} ogc_topology;

#ifdef __cplusplus
}
#endif

#endif
