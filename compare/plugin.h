/* Lets the judge compare your kernel: a shared library that offers one or more stages, in C, so that any language and
 * compiler will do.
 *
 *     #include "compare/plugin.h"
 *     OGC_PLUGIN("mine", OGC_HOST_MEMORY)
 *     int ogc_truncate(const ogc_truncate_in* in, ogc_truncate_out* out) { … return 0; }
 *
 *     g++ -O2 -shared -fPIC -I INCLUDE mine.cpp -o mine.so && ogc compare truncate --plugin ./mine.so
 *
 * The library offers the stages whose functions it defines. compare/stages/STAGE.hpp defines each stage with all of its
 * boundary cases; the structures in compare/plugin/ hold the same inputs and outputs as plain arrays.
 * experiments/plugins/README.md is a guide that starts from an empty file.
 *
 * Rules. A function computes all cases of `in`, writes every element of every array of `out` and nothing else, and
 * returns 0. Any other value is reported as a failure. Arrays of `in` are read-only. All arrays are in the memory that
 * the library chose. With OGC_DEVICE_MEMORY every pointer inside `in` and `out` is CUDA device memory of the primary
 * context of device 0, which is current during the call; the two structures themselves are always in host memory. A
 * function may return before the device has finished: the caller synchronises, and includes this time. One thread calls
 * all functions, one after another; a function may keep data between calls. The library frees only memory that it has
 * allocated.
 *
 * Units: metres, newtons, joules. float is IEEE single precision; indices are from 0; int64_t n is the number of cases.
 */
#ifndef OGC_COMPARE_PLUGIN_H
#define OGC_COMPARE_PLUGIN_H

#include "compare/plugin/base.h"
#include "compare/plugin/forces.h"
#include "compare/plugin/geometry.h"
#include "compare/plugin/scenes.h"

#endif
