//! Lookups in rooms.

use serde::Serialize;

use lobefit::report::Image;

/// What was found in the rooms.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomsFindings {
    /// What lookups take at run time.
    pub costs: Vec<LookupCost>,
    /// What the lobe of a surface is taken for, fitted.
    pub lobes: Vec<FittedLobe>,
    /// What methods are off by at those points.
    pub random: Vec<RandomRoom>,
    /// Pictures.
    pub pictures: Vec<RoomPictures>,
    /// The method that others are compared with.
    #[serde(skip)]
    pub rival: String,
    /// Methods in charts and pictures.
    #[serde(skip)]
    pub chosen: Vec<String>,
}

/// Errors at points at random in a room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RandomRoom {
    /// The room.
    pub room: String,
    /// Roughness of each column, the root of alpha.
    pub roughness: Vec<f64>,
    /// By reference.
    pub references: Vec<RandomReference>,
}

/// Errors against one reference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RandomReference {
    /// What the truth is.
    pub name: String,
    /// Its own relative L2 noise, from its two halves, by roughness.
    pub noise: Vec<f64>,
    /// By method.
    pub rows: Vec<RandomRow>,
}

/// Errors of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RandomRow {
    /// The method.
    pub name: String,
    /// Fetches.
    pub fetches: usize,
    /// Relative L2 of linear radiance, by roughness.
    pub l2: Vec<f64>,
    /// Mean absolute error of x/(1 + x), by roughness.
    pub mae: Vec<f64>,
    /// Frostbite's relative L2 over this one's, the geometric mean over the roughnesses.
    pub gain_l2: f64,
    /// The least of these ratios.
    pub least_l2: f64,
    /// The same of `mae`.
    pub gain_mae: f64,
}

/// Constants of a lobe that stand for GGX's with a number of fetches. Errors are geometric means
/// over the roughnesses of the relative L2 in the practice room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FittedLobe {
    /// Fetches.
    pub fetches: usize,
    /// Constants of the share of the normal in the axis.
    pub lean: [f64; 3],
    /// Constants of the ratio of the footprint.
    pub narrow: [f64; 3],
    /// Constants of the ratio of the widths.
    pub squash: [f64; 2],
    /// Error with them.
    pub error: f64,
    /// Error with the constants that the methods have.
    pub shipped: f64,
    /// The same by the width that lookups are emitted with.
    pub emitted: f64,
    /// Error of the round lobe about the mirror ray.
    pub mirror: f64,
    /// The same by the width that lookups are emitted with.
    pub mirror_emitted: f64,
    /// Error of the round lobe about the published dominant direction.
    pub dominant: f64,
}

/// A plane seen by a camera in a room. Pairs are by reference: the round lobe cut off at the plane,
/// GGX.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomPictures {
    /// Room and plane.
    pub name: String,
    /// Pixels along each side.
    pub side: usize,
    /// Pixels that reflect.
    pub pixels: usize,
    /// Roughness of each column, the root of alpha.
    pub roughness: Vec<f64>,
    /// Relative L2 noise of each reference, from its two halves, by roughness.
    pub noise: [Vec<f64>; 2],
    /// Mean FLIP between the halves of each reference, by roughness.
    pub flip_of_noise: [Vec<f64>; 2],
    /// Second differences of displayed luminance of the round lobe's own picture, on the edges of
    /// the room in it and elsewhere, by roughness.
    pub detail: [Vec<f64>; 2],
    /// By method.
    pub rows: Vec<RoomPictureRow>,
    /// What the page shows.
    #[serde(skip)]
    pub shown: Vec<RoomPicture>,
}

/// Pictures of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomPictureRow {
    /// The method.
    pub name: String,
    /// Fetches of a pixel; 0 of a reference.
    pub fetches: usize,
    /// Mean FLIP of the pixels that reflect, by roughness.
    pub flip: [Vec<f64>; 2],
    /// Relative L2 of their linear radiance, by roughness.
    pub l2: [Vec<f64>; 2],
    /// Error of the second differences of displayed luminance against the round lobe on the edges
    /// of the room in the picture, by roughness.
    pub edges: Vec<f64>,
    /// The same elsewhere.
    pub elsewhere: Vec<f64>,
}

impl RoomPictureRow {
    /// A row without columns.
    pub fn new(name: String, fetches: usize) -> RoomPictureRow {
        let pair = || [Vec::new(), Vec::new()];
        RoomPictureRow { name, fetches, flip: pair(), l2: pair(), edges: Vec::new(), elsewhere: Vec::new() }
    }
}

/// Pictures of one roughness, as displayed.
#[derive(Clone, Debug, PartialEq)]
pub struct RoomPicture {
    /// The root of alpha.
    pub roughness: f64,
    /// The two references.
    pub references: Vec<Image>,
    /// By method.
    pub pictures: Vec<Image>,
    /// FLIP of each pixel against each reference, by method.
    pub maps: Vec<[Vec<f64>; 2]>,
}

/// Fetches and operations of an emitted lookup.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LookupCost {
    /// Proxy and edges.
    pub lookup: String,
    /// Fetches.
    pub fetches: u32,
    /// Operations, as the manifest counts them.
    pub operations: u32,
    /// The method that measures it, where one does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
}
