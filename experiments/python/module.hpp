// The parts of the module `_fast`, each in a source of its own.
#pragma once

#include <nanobind/nanobind.h>

namespace ogc::python {

void bind_contacts(nanobind::module_& module);    ///< Mesh, ContactFinder, ContactSets, find_contacts
void bind_forces(nanobind::module_& module);      ///< ContactForces, ContactForceSums
void bind_guard(nanobind::module_& module);       ///< Guard, GuardReport
void bind_state_view(nanobind::module_& module);  ///< StateView
void bind_scenes(nanobind::module_& module);      ///< Scene, Body, Simulation, Snapshot, the built-in scenes

}  // namespace ogc::python
