/* Libraries that are refused when they are loaded. A definition such as OGC_TEST_NEWER selects one. */
#include "compare/plugin.h"

#if defined(OGC_TEST_NEWER)
const ogc_plugin_info* ogc_plugin(void) {
  static const ogc_plugin_info info = {OGC_PLUGIN_VERSION + 1, OGC_HOST_MEMORY, "newer"};
  return &info;
}
#elif defined(OGC_TEST_OLDER)
const ogc_plugin_info* ogc_plugin(void) {
  static const ogc_plugin_info info = {OGC_PLUGIN_VERSION - 1, OGC_HOST_MEMORY, "older"};
  return &info;
}
#elif defined(OGC_TEST_EMPTY)
OGC_PLUGIN("empty", OGC_HOST_MEMORY)
#elif defined(OGC_TEST_MEMORY)
OGC_PLUGIN("odd memory", 9)
#endif

#if !defined(OGC_TEST_EMPTY)
int ogc_bound(const ogc_bound_in* in, ogc_bound_out* out) {
  (void)in;
  (void)out;
  return 0;
}
#endif
