// Fig. 10 and 1: fifty square cloths fall off-centre onto a fixed cylinder, and from there to the ground.
#pragma once

#include "compare/problem/scene.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {

/// Holds the sizes; the defaults are the paper's with 246,000 vertices. Heights are multiples of the contact radius.
/// The edges of the ground's triangles are proportional to those of the cloths.
struct FiftyLayersSizes {
  std::string name = "fifty_layers";    ///< name of the scene
  compare::Index layers = 50;           ///< number of cloths
  compare::Index vertices_a_side = 70;  ///< along each side of each cloth
  double contact_radius = 3e-3;         ///< r [m]
  double shift = 3e-3;                  ///< standard deviation of each layer's shift in x and in z [m]
  CylinderCells cylinder{};             ///< cells of the cylinder's mesh
  /// 4 s. Layers come to rest later than this; `ogc run --steps` extends the run.
  std::int64_t steps = 4800;
  std::uint64_t seed = 0;  ///< seed of the shifts
};

/// Returns the scene. Layers of 1 m × 1 m lie 1.05 r apart, the lowest at y = 0.30 m. Below them are a cylinder of
/// radius 0.25 m and length 0.5 m along z about (−0.18, 0, 0), and a ground of 4 m × 4 m at y = −0.60 m. Each layer is
/// one body, the lowest first. The start equals the rest shape and has no intersections by construction.
compare::Scene fifty_layers(const FiftyLayersSizes& sizes = {});

/// Returns the sizes of Table 1's row with 1M vertices: 50 × (141 × 141), r = 2 mm.
FiftyLayersSizes fifty_layers_1m_sizes();

/// Returns the sizes of two hundred layers with 980,000 vertices, like a scene of *Divide and Truncate* (Chen, Hsu,
/// Ayman, Macklin, 2026). We do not know the sheets of that scene, so the layers are those of fifty_layers (our
/// choice). The stack is 0.94 m high, so the run has 7,200 steps.
FiftyLayersSizes two_hundred_layers_sizes();

}  // namespace ogc::experiments
