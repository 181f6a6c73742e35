//! Results of the studies as plain data, written as they are to `results.json`.

mod coupling;
mod parallax;

pub use coupling::{
    CouplingStudy, FurnaceStrip, FurnaceStripRow, LitRow, LitStrip, Meaning, Ranked, Ranking,
};
pub use parallax::{
    BakePolicy, ChainFindings, ChainGain, ChainParts, ChainSize, ParallaxStudy, SeamPicture, SeamRow,
    SlideLaw,
};
pub use parallax::{
    FittedLobe, LookupCost, RandomReference, RandomRoom, RandomRow, RoomGeometry, RoomPicture,
    RoomPictureRow, RoomPictures, RoomsFindings,
};
pub use parallax::{
    PlacedTaps, RuleCurves, RuleExpectation, RuleRefit, RuleSpread, SeedCell, SeedFindings, SeedFit,
    SeedSlant, SlantFindings, SlantFootprints, SlantLobe, SlantRow,
};
pub use parallax::{ProxiesFindings, ProxyCrossing, ProxyFamily, ProxyGain};
