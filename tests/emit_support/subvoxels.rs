//! Masks of sub-voxels, and what their lookups return.

use lobefit_math::subvoxel::{NO_CENTROID, centroid, supervoxel_mask};

/// Masks with super-voxels.
pub const PAIRS: usize = 1 << 14;

/// Every mask again and again, with the halves of a super-voxel: sparse ones, full ones, and of all
/// kinds of bytes.
fn pairs() -> impl Iterator<Item = (u8, u64)> {
    let mut state = 1_u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state ^ state >> 29
    };
    (0..PAIRS).map(move |i| {
        let bytes = match i % 4 {
            0 => next(),
            1 => next() & next() & next() & next(),
            2 => 1 << (next() % 64) | 1 << (next() % 64),
            _ => !(0xff << (8 * (next() % 8))),
        };
        (i as u8, if i == 0 { 0 } else { bytes })
    })
}

/// The bits of mask, low and high half, as numbers of four bytes.
pub fn points() -> Vec<u8> {
    let words = |(mask, bytes): (u8, u64)| [u32::from(mask), bytes as u32, (bytes >> 32) as u32];
    pairs().flat_map(words).flat_map(u32::to_le_bytes).collect()
}

/// The centroid twice, as both functions give it, and the mask of the super-voxel.
pub fn expected() -> Vec<f32> {
    let values = |(mask, bytes): (u8, u64)| {
        let centre = centroid(mask).unwrap_or(NO_CENTROID);
        [&centre[..], &centre, &[f32::from(supervoxel_mask(bytes))]].concat()
    };
    pairs().flat_map(values).collect()
}
