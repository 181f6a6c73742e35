//! Real chains of levels, and viewpoints of their texels.

use serde::Serialize;

use lobefit::report::Image;

/// What was found about chains. Errors are relative: the root of the sum of squares over channels
/// and points at random, over that of the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChainFindings {
    /// Roughness of the entries of all lists of errors.
    pub roughness: Vec<f64>,
    /// Radii of the lobe on a wall within which an edge is near.
    pub near: f64,
    /// What the references at points are off by, by room: relative, by roughness.
    pub noise: Vec<(String, Vec<f64>)>,
    /// The error of one chain taken apart, by room.
    pub parts: Vec<ChainParts>,
    /// Chains of several maps and sizes.
    pub sizes: Vec<ChainSize>,
    /// Lookups end to end.
    pub gains: Vec<ChainGain>,
    /// The parameter of the sliding viewpoint.
    pub slide: SlideLaw,
    /// Viewpoints of bakes.
    pub policies: Vec<BakePolicy>,
    /// Floors.
    pub seams: Vec<SeamRow>,
}

/// What a chain is off by for the fetches of our lookup, in units of those fetches integrated
/// exactly; by roughness.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ChainParts {
    /// The room.
    pub room: String,
    /// The whole chain: 16 bits, seamless, prefiltered from the room.
    pub total: Vec<f64>,
    /// Two integrated lobes mixed for one between them.
    pub levels: Vec<f64>,
    /// Texels, from those.
    pub texels: Vec<f64>,
    /// 16 bits, from 32.
    pub half: Vec<f64>,
    /// The whole chain read without the neighbours of its faces.
    pub clamped: Vec<f64>,
    /// The whole chain prefiltered from its capture.
    pub captured: Vec<f64>,
    /// Two chains of different rays apart.
    pub noise: Vec<f64>,
}

/// What a whole chain is off by.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChainSize {
    /// The room.
    pub room: String,
    /// The map in words.
    pub chain: String,
    /// Whose it is.
    pub like: String,
    /// Texels along a side of a face of the first level.
    pub size: usize,
    /// Bytes of the chain in 16 bits, four channels.
    pub bytes: usize,
    /// As [`ChainParts::total`].
    pub total: Vec<f64>,
}

/// A lookup end to end, against lobes traced from the points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChainGain {
    /// The room.
    pub room: String,
    /// The lookup.
    pub method: String,
    /// Error with fetches integrated.
    pub exact: Vec<f64>,
    /// Error with fetches from the chain.
    pub chain: Vec<f64>,
    /// Geometric mean over roughness of Frostbite's error over this one's, fetches integrated.
    pub gain_exact: f64,
    /// The same from the chain, both.
    pub gain_chain: f64,
}

/// How the loss depends on the radii over which a viewpoint slides.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlideLaw {
    /// Radii tried.
    pub widths: Vec<f64>,
    /// The room that it is fitted in.
    pub room: String,
    /// The geometric mean error over roughness by radii.
    pub loss: Vec<f64>,
    /// The best.
    pub best: f64,
}

/// A law of a bake and how it is looked up.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BakePolicy {
    /// The room.
    pub room: String,
    /// The law.
    pub policy: String,
    /// Error with fetches integrated, over all points.
    pub whole: Vec<f64>,
    /// Over those far from edges.
    pub far: Vec<f64>,
    /// Over those near edges.
    pub near: Vec<f64>,
    /// Error with fetches from the law's own chain.
    pub chain: Vec<f64>,
    /// Geometric mean over roughness of Frostbite's error over this one's, fetches integrated.
    pub gain: f64,
    /// The same from chains, both.
    pub gain_chain: f64,
}

/// The floor of a room under a roughness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeamRow {
    /// The room.
    pub room: String,
    /// Roughness of the floor.
    pub roughness: f64,
    /// What the reference is off by at edges and elsewhere, from one that is integrated more
    /// coarsely.
    pub noise: [f64; 2],
    /// The reference, with the second differences of its own, and every law, with those of its
    /// error.
    pub pictures: Vec<SeamPicture>,
}

/// A picture of a floor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeamPicture {
    /// The law.
    pub policy: String,
    /// Mean magnitude of the second difference of the error of displayed luminance across edges of
    /// the proxy.
    pub edge: f64,
    /// The same elsewhere.
    pub elsewhere: f64,
    /// As displayed, linear RGB in [0, 1].
    #[serde(skip)]
    pub picture: Image,
}
