//! The intervals in which the numbers of a scene lie.

use lobefit_strict::intervals;
pub(super) use lobefit_strict::number::{DielectricIor, In, NotNegative, Numbers, Span, Unit, Whole, inside};

intervals! {
    /// Index of refraction in air of any material; at 1 there is no interface.
    Ior = 1.0, 4.0, false, "[1, 4], of glass [1, 3]";
    /// Index of refraction of glass: at 1 its albedo is a limit.
    GlassIor = 1.0, super::limits::GLASS_IOR, false, "[1, 3]";
    /// A limit on an error: albedos lie in [0, 1], so an error of 1 is none.
    ErrorLimit = 0.0, 1.0, true, "(0, 1]";
    /// Cosine of the view angle.
    Cosine = super::limits::MU_MIN, 1.0, false, "[0.0001, 1]";
    /// Length of the mean of a texel's normals.
    MeanLength = 0.5, 1.0, false, "[0.5, 1]";
    /// Angular radius of a light.
    LightRadius = 0.0, 0.5, false, "[0, 0.5], in radians";
    /// Texels of an axis.
    AxisSize = super::limits::AXIS_MIN as f64, super::limits::AXIS_MAX as f64, false, "[2, 1024] ([4, 256] with a third axis)";
    /// Operations of a fit.
    Ops = 1.0, super::limits::FIT_OPS as f64, false, "[1, 1000]";
    /// Ratio of the distances of shading point and probe from what they see.
    Ratio = lobefit_truth::quantity::footprint::RHO[0], lobefit_truth::quantity::footprint::RHO[1], false, "[0.000001, 1000]";
    /// Levels of a prefiltered chain.
    Levels = super::limits::LEVELS_MIN as f64, super::limits::LEVELS_MAX as f64, false, "[2, 16]";
    /// Planes of a proxy: 4 bound a body.
    Planes = super::limits::PLANES_MIN as f64, super::limits::PLANES_MAX as f64, false, "[4, 64]";
    /// Fetches of a lookup.
    TapCount = 1.0, super::limits::TAPS_MAX as f64, false, "[1, 3]";
    /// A GGX width above a mirror's.
    Width = 0.0, 1.0, true, "(0, 1]";
    /// An angle from the axis of a lobe, radians; its end is rounded up to any 7 digits.
    QuarterTurn = 0.0, 1.570797, false, "[0, pi/2], in radians";
    /// Texels of a side of an occlusion buffer.
    BufferSide = 16.0, 1024.0, false, "[16, 1024]";
    /// Frames that depth is old.
    Latency = 1.0, 8.0, false, "[1, 8]";
    /// Voxels of a side of a grid: a super-voxel has two.
    GridSide = 2.0, 512.0, false, "[2, 512]";
    /// Seeds.
    Seed = 0.0, 4294967295.0, false, "[0, 4294967295]";
    /// Versions of the scene format.
    Version = 1.0, 1.0, false, "the versions that this program reads: 1";
}
