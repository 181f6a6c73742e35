//! What the studies found out, and their pages.

mod findings;
mod sections;

pub use findings::{
    BakePolicy, ChainFindings, ChainGain, ChainParts, ChainSize, SeamPicture, SeamRow, SlideLaw,
};
pub use findings::{
    CouplingStudy, FurnaceStrip, FurnaceStripRow, LitRow, LitStrip, Meaning, Ranked, Ranking,
};
pub use findings::{
    FittedLobe, LookupCost, ParallaxStudy, RandomReference, RandomRoom, RandomRow, RoomGeometry, RoomPicture,
    RoomPictureRow, RoomPictures, RoomsFindings,
};
pub use findings::{
    PlacedTaps, RuleCurves, RuleExpectation, RuleRefit, RuleSpread, SeedCell, SeedFindings, SeedFit,
    SeedSlant, SlantFindings, SlantFootprints, SlantLobe, SlantRow,
};
pub use findings::{ProxiesFindings, ProxyCrossing, ProxyFamily, ProxyGain};
pub use sections::{coupling, parallax, surfaces};
