// The parts of the module `_fast`, each in a source of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "compare/contestant.hpp"

namespace ogc::python {

class Worlds;

/// Returns rows as a structured array, numpy.recarray (bind_scenes.cpp).
nanobind::object table_of(const std::vector<compare::StepMetrics>& rows);
/// Starts copies of a scene side by side (bind_worlds.cpp).
std::unique_ptr<Worlds> worlds_of_scene(const compare::Scene& scene, std::int64_t count, const std::string& backend,
                                        bool energies);

void bind_contacts(nanobind::module_& module);    ///< Mesh, ContactFinder, ContactSets, find_contacts
void bind_forces(nanobind::module_& module);      ///< ContactForces, ContactForceSums
void bind_guard(nanobind::module_& module);       ///< Guard, GuardReport
void bind_state_view(nanobind::module_& module);  ///< StateView
void bind_worlds(nanobind::module_& module);      ///< Worlds, worlds
void bind_scenes(nanobind::module_& module);      ///< Scene, Body, Simulation, Snapshot, the built-in scenes

}  // namespace ogc::python
