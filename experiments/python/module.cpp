// The module `_fast`: everything that needs neither CGAL nor GMP, so that its licence is that of this project.
#include "experiments/python/module.hpp"

#include "experiments/python/arrays.hpp"

NB_MODULE(_fast, module) {
  module.doc() = "The fast path of the OGC Testbed. Use the package ogc_testbed, which has all of its names.";
  ogc::python::translate_errors();
  ogc::python::bind_state_view(module);
  ogc::python::bind_contacts(module);
  ogc::python::bind_guard(module);
  ogc::python::bind_forces(module);
  ogc::python::bind_worlds(module);
  ogc::python::bind_scenes(module);
}
