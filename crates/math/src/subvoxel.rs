//! Binary sub-voxels: a byte is a cell of 2 x 2 x 2, and eight such bytes are a super-voxel.
//!
//! Bit b = x + 2 y + 4 z of a byte is the sub-voxel at (x, y, z), each 0 or 1. Byte b of a
//! super-voxel, its bits 8 b to 8 b + 7, is the cell at (x, y, z) of the same order: together they
//! are two levels of an octree in Morton order.

/// What stands for the centroid of a mask of no sub-voxel: outside of the cell, as no centroid is.
pub const NO_CENTROID: [f32; 3] = [-1.0; 3];

/// Sub-voxels with x = 1, with y = 1 and with z = 1.
pub const UPPER: [u8; 3] = [0xaa, 0xcc, 0xf0];

/// The mean position of the set sub-voxels of a byte in the cell [0, 1]^3, whose centres lie at
/// 0.25 and 0.75: (n + 2 k)/(4 n) along an axis with k of the n set ones in its upper half, rounded
/// once. None of mask 0.
pub fn centroid(mask: u8) -> Option<[f32; 3]> {
    let count = |of: u8| (mask & of).count_ones() as f32;
    let n = count(0xff);
    (n > 0.0).then(|| UPPER.map(|half| (n + 2.0 * count(half)) / (4.0 * n)))
}

/// The byte of a super-voxel: bit b is set where any bit of its byte b is.
pub fn supervoxel_mask(bytes: u64) -> u8 {
    bytes.to_le_bytes().iter().enumerate().fold(0, |mask, (b, byte)| mask | u8::from(*byte != 0) << b)
}

/// The Morton index of a place whose coordinates are below 2^10: bit 3 i of it is bit i of x, bit 3
/// i + 1 that of y, bit 3 i + 2 that of z.
pub fn morton(place: [u32; 3]) -> u32 {
    let spread = |x: u32| {
        let x = (x | x << 16) & 0x0300_00ff;
        let x = (x | x << 8) & 0x0300_f00f;
        let x = (x | x << 4) & 0x030c_30c3;
        (x | x << 2) & 0x0924_9249
    };
    spread(place[0]) | spread(place[1]) << 1 | spread(place[2]) << 2
}

/// The place of a Morton index below 2^30.
pub fn from_morton(index: u32) -> [u32; 3] {
    let gathered = |x: u32| {
        let x = x & 0x0924_9249;
        let x = (x | x >> 2) & 0x030c_30c3;
        let x = (x | x >> 4) & 0x0300_f00f;
        let x = (x | x >> 8) & 0x0300_00ff;
        (x | x >> 16) & 0x3ff
    };
    [0, 1, 2].map(|axis| gathered(index >> axis))
}
