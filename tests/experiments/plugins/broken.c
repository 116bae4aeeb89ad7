/* A plug-in in C whose activation is right. The environment variable OGC_BROKEN names a fault. Faults of the stage
   activation appear only in cases with d = r. */
#define _GNU_SOURCE
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "compare/plugin.h"

OGC_PLUGIN("broken", OGC_HOST_MEMORY)

static int breaks(const char* how) {
  const char* const wanted = getenv("OGC_BROKEN");
  return wanted && strcmp(wanted, how) == 0;
}

/* The number of the worker's socket. */
enum { worker_socket = 3 };

static void write_to_socket(const void* bytes, size_t count) {
  if (write(worker_socket, bytes, count) < 0) perror("the socket");
}

/* Writes the head of a block: a mark and the block's length. */
static void announce(uint64_t length) {
  const uint64_t head[2] = {0x6b636f6c622d6367, length};
  write_to_socket(head, sizeof head);
}

/* Runs while the library is loaded. */
__attribute__((constructor)) static void load(void) {
  if (breaks("crash while loading")) abort();
  if (breaks("fork while loading")) fork();
  if (breaks("garbage while loading")) write_to_socket(getenv("OGC_BROKEN"), 16);
  if (breaks("hang while loading"))
    for (;;) pause();
}

/* Size of the first message of an answer. */
enum { result_bytes = 96 };

static void write_messages(void) {
  unsigned char bytes[4096] = {0};
  if (breaks("zeros")) write_to_socket(bytes, 256);
  if (breaks("three bytes")) write_to_socket(bytes, 3);
  if (breaks("absurd length")) announce(UINT64_C(1) << 62);
  if (breaks("empty message")) announce(0);
  if (breaks("no message behind its head")) announce(result_bytes);
  for (size_t i = 0; breaks("garbage") && i < sizeof bytes; ++i) bytes[i] = (unsigned char)(i * i * 7 + i / 11);
  if (breaks("garbage")) write_to_socket(bytes, sizeof bytes);
  if (breaks("half a message")) {
    announce(result_bytes);
    write_to_socket(bytes, 40);
    _exit(0);
  }
}

/* Writes the number of this process to the file "child", so that a test can check whether the process has ended. */
static void tell_number(void) {
  FILE* const file = fopen("child", "w");
  if (!file) return;
  fprintf(file, "%d\n", (int)getpid());
  fclose(file);
}

/* Starts a child process if OGC_BROKEN begins with "fork" or "clone". With "clone" the C library does not notice it. */
static void fork_child(void) {
  const char* const how = getenv("OGC_BROKEN");
  const int clones = how && strncmp(how, "clone", 5) == 0;
  if (!clones && (!how || strncmp(how, "fork", 4) != 0)) return;
  const char* const then = how + (clones ? 5 : 4);
  const pid_t child = clones ? (pid_t)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0) : fork();
  const int is_child = child == 0;
  if (is_child && strcmp(then, ", both return") == 0) return;
  if (is_child && strcmp(then, ", child exits") == 0) exit(0);
  if (is_child && strcmp(then, ", child writes") == 0) {
    const char zeros[64] = {0};
    write_to_socket(zeros, sizeof zeros);
    _exit(0);
  }
  if (is_child) {
    tell_number();
    for (;;) pause();
  }
  if (strcmp(then, ", child exits") == 0 || strcmp(then, ", child writes") == 0) waitpid(child, NULL, 0);
  if (strcmp(then, ", parent exits") == 0) _exit(5);
  if (strcmp(then, ", parent crashes") == 0) abort();
}

static void break_activation(const ogc_activation_in* in, ogc_activation_out* out, int64_t i) {
  volatile float* const nowhere = NULL;
  if (breaks("crash")) *nowhere = 1;
  if (breaks("hang and tell")) tell_number();
  if (breaks("hang") || breaks("hang and tell"))
    for (;;) pause();
  if (breaks("exit")) exit(7);
  if (breaks("nan")) out->slope[i] = NAN;
  if (breaks("before")) out->energy[-1] = 0;
  if (breaks("behind")) out->curvature[in->n] = 0;
  if (breaks("far behind")) out->curvature[in->n + 100000] = 0;
  if (breaks("input")) ((float*)in->distance)[i] = 0;
  write_messages();
  fork_child();
  if (breaks("close"))
    for (int descriptor = 3; descriptor < 64; ++descriptor) close(descriptor);
}

/* Sets g[0], g[1], g[2] to g, g' and g'' at a distance d < r. */
static void activate(int64_t kind, double d, double r, double k, double g[3]) {
  const double tau = r / 2, depth = r - d, share = depth / d, log = log1p(share);
  const double inner = kind == OGC_ACTIVATION_OGC_AS_PRINTED ? tau * k * tau * tau : tau * k * tau;
  const int two_stages = kind == OGC_ACTIVATION_OGC || kind == OGC_ACTIVATION_OGC_AS_PRINTED;
  if (two_stages && d < tau)
    g[0] = k / 2 * tau * tau + inner * (log - log1p(1)), g[1] = -inner / d, g[2] = inner / d / d;
  else if (two_stages || kind == OGC_ACTIVATION_QUADRATIC)
    g[0] = k / 2 * depth * depth, g[1] = -k * depth, g[2] = k;
  else if (kind == OGC_ACTIVATION_CUBIC)
    g[0] = 2 * k / (3 * r) * depth * depth * depth, g[1] = -2 * k / r * depth * depth, g[2] = 4 * k / r * depth;
  else
    g[0] = k * depth * depth * log, g[1] = -k * depth * (2 * log + share), g[2] = k * (2 * log + share * (4 + share));
}

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  printf("a plug-in may print\n");
  for (int64_t i = 0; i < in->n; ++i) {
    const double d = in->distance[i], r = in->contact_radius[i];
    double g[3] = {0, 0, 0};
    if (d < r) activate(in->activation[i], d, r, in->stiffness[i], g);
    if (breaks("unwritten") && d == r) continue;
    out->energy[i] = (float)g[0];
    out->slope[i] = (float)g[1];
    out->curvature[i] = (float)g[2];
    if (d == r) break_activation(in, out, i);
  }
  for (int64_t i = 0; breaks("status") && i < in->n; ++i)
    if (in->distance[i] == in->contact_radius[i]) return 5;
  return 0;
}

/* Gives wrong answers only: most faults count contacts without writing them. */
int ogc_detect_vertex_facet(const ogc_detect_in* in, ogc_detect_vertex_facet_out* out) {
  for (int32_t v = 0; v < in->topology.vertex_count; ++v) out->d_min_vertex[v] = 0;
  for (int32_t t = 0; t < in->topology.triangle_count; ++t) out->d_min_triangle[t] = 0;
  if (breaks("no count")) return 0;
  out->count = breaks("growing") ? out->capacity + 1 : breaks("few") ? 3 : 0;
  if (breaks("wild contact")) {
    out->count = 2;
    out->contacts[0] = (ogc_vertex_facet_contact){1000000000, 2, -5, 77};
    out->contacts[1] = (ogc_vertex_facet_contact){-3, 1, 2000000000, -1000000};
  }
  if (breaks("absurd count")) out->count = INT64_C(1) << 60;
  if (breaks("few")) out->contacts[0] = (ogc_vertex_facet_contact){0, 0, 0, 0};
  return 0;
}

/* Answers with a face of a kind that does not exist. */
int ogc_detect_edge_edge(const ogc_detect_in* in, ogc_detect_edge_edge_out* out) {
  for (int32_t e = 0; e < in->topology.edge_count; ++e) out->d_min_edge[e] = 0;
  out->count = 1;
  out->contacts[0] = (ogc_edge_edge_contact){7, 0, 0, 0, 0, 0};
  return 0;
}
