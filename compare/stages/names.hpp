// Declares the inputs, outputs and truths of all stages; compare/stages/STAGE.hpp defines them.
#pragma once

namespace ogc::compare {

struct ActivationIn;
struct ActivationOut;
struct ActivationTruth;
struct BarrierIn;
struct BarrierOut;
struct BarrierTruth;
struct BendingIn;
struct BlockIn;
struct BlockOut;
struct BlockTruth;
struct BoundIn;
struct BoundOut;
struct BoundTruth;
struct CcdIn;
struct CcdOut;
struct CcdTruth;
struct ClosestFaceIn;
struct ClosestFaceOut;
struct ClosestFaceTruth;
struct ClosestPointsIn;
struct ClosestPointsOut;
struct ClosestPointsTruth;
struct ContactForceIn;
struct DetectIn;
struct DetectEdgeEdgeOut;
struct DetectEdgeEdgeTruth;
struct DetectVertexFacetOut;
struct DetectVertexFacetTruth;
struct ForceOut;
struct ForceTruth;
struct FrictionForceIn;
struct InitialGuessIn;
struct InitialGuessOut;
struct InitialGuessTruth;
struct MembraneIn;
struct OrientationIn;
struct OrientationOut;
struct OrientationTruth;
struct PlaneIn;
struct PlaneOut;
struct PlaneTruth;
struct RestStateIn;
struct RestStateOut;
struct RestStateTruth;
struct RodIn;
struct SpringIn;
struct StepIn;
struct StepOut;
struct StepTruth;
struct SweepIn;
struct SweepOut;
struct SweepTruth;
struct TetrahedronIn;
struct TruncateIn;
struct TruncateOut;
struct TruncateTruth;
struct VolumeDepthIn;
struct VolumeDepthOut;
struct VolumeDepthTruth;
struct VolumeForceIn;

}  // namespace ogc::compare
