//! Defects of a client, each with the finding that reports it.

/// Defect of a client.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Defect {
    Nothing,
    GravityLeftOn,
    StressAtStart,
    Drag,
    Pic,
    PicAtFirst,
    WeightsOfTheirOwn,
    LowWeights,
    UnevenWeightsInPic,
    GradientsOfTheirOwn,
    LossAtCrossings,
    LightNodesLeftOut,
    NoCellOnFaces,
    Leapfrog,
    ForwardEuler,
    ForceAtPresentPositions,
    ForceOfOtherPoints,
    WholeCells,
    NoDensity,
    NoWalls,
    WallsLetGo,
    StickyRollers,
    LowWallsOnly,
    FixedHoldsNormal,
    LoadAfterWalls,
    HeldAcceleration,
    AbsoluteThreshold,
}
