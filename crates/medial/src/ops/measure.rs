//! What the significance of a point of an axis is measured by.

use crate::axis::names;

/// A measure of how much of a shape a point of its axis stands for.
///
/// All but the last four grow from the leaves to the root, or nearly; removing what lies below a
/// threshold from the leaves inwards keeps components and cycles in any case. With `W` the length of
/// the boundary between both footpoints on the side of the leaves, `r` the radius:
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Measure {
    /// The greatest distance from the disk to a corner on the side of the leaves: how far the boundary
    /// moves if all of that is replaced by the disk.
    Excess,
    /// Excess as a share of the radius.
    RelativeExcess,
    /// The least of that between a point and the root: how far a limb stands out of the shape where it
    /// grows out of it \[HD86\].
    Prominence,
    /// `W` \[OK95\].
    Potential,
    /// `W` less the distance of the footpoints \[OK95\].
    Chord,
    /// `W` less the arc of the disk that it faces \[OK95\].
    Circularity,
    /// Burn time less the radius \[LCLJ11\].
    Erosion,
    /// The longest way along the axis to a leaf.
    Length,
    /// The angle between the footpoints, seen from the centre, in radians.
    Angle,
    /// Half the distance of the footpoints \[CL05\].
    HalfChord,
    /// The radius.
    Radius,
    /// By how much all disks have to grow until a larger one holds this one \[GMPW09\]; 1 at least.
    Scale,
}

names!(
    Measure, "measure",
    Excess => "excess", RelativeExcess => "relative_excess", Prominence => "prominence", Potential => "potential",
    Chord => "chord", Circularity => "circularity", Erosion => "erosion", Length => "length",
    Angle => "angle", HalfChord => "half_chord", Radius => "radius",
    Scale => "scale",
);

impl Measure {
    /// Whether it grows towards the root, so that what lies above a threshold is all that is kept.
    ///
    /// With the others points below it may be kept, so that what is above stays connected.
    #[must_use]
    pub const fn is_monotone(self) -> bool {
        !matches!(self, Self::Angle | Self::HalfChord | Self::Radius | Self::Scale)
    }
}
