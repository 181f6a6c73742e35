//! Procedural worlds of boxes within [`BOUNDS`], by name and seed.

use crate::camera::Place;
use crate::raster::Cuboid;
use lobefit::scene::Generator;

/// What a grid spans of a generated world, metres.
pub const BOUNDS: Cuboid = Cuboid { low: [0.0; 3], high: [128.0, 128.0, 64.0] };

/// A generator of pseudo-random numbers (SplitMix64; Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Of a seed.
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// Evenly in [low, high).
    pub fn within(&mut self, low: f32, high: f32) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((x ^ x >> 31) >> 40) as f32 / (1_u64 << 24) as f32
    }
}

/// Blocks along a side, their side with half a street about them, and half a street.
const BLOCKS: usize = 4;
const BLOCK: f32 = 32.0;
const HALF_STREET: f32 = 4.0;

/// Everything that stands in a world, its ground first.
pub fn world(kind: Generator, seed: u32) -> Vec<Cuboid> {
    let mut random = Random::new(u64::from(seed));
    let mut boxes = vec![Cuboid { low: [-512.0, -512.0, -1.0], high: [640.0, 640.0, 0.0] }];
    for block in 0..BLOCKS * BLOCKS {
        let [x, y] = [block % BLOCKS, block / BLOCKS].map(|n| BLOCK * n as f32);
        match kind {
            Generator::Town => town(&mut random, [x, y, 0.0], block, &mut boxes),
            Generator::Forest => forest(&mut random, [x, y, 0.0], &mut boxes),
        }
    }
    boxes
}

/// Four plots with a house or a garden behind a fence, an arch over the street, poles along it.
fn town(random: &mut Random, [x, y, _]: Place, block: usize, boxes: &mut Vec<Cuboid>) {
    for plot in 0..4 {
        let side = 0.5 * BLOCK - HALF_STREET;
        let [px, py] =
            [x + HALF_STREET + side * (plot % 2) as f32, y + HALF_STREET + side * (plot / 2) as f32];
        let centre = [px + 0.5 * side, py + 0.5 * side, 0.0];
        if random.within(0.0, 1.0) < 0.25 {
            fence(random, [px, py, 0.0], side, boxes);
            continue;
        }
        let [w, d] = [0, 1].map(|_| random.within(0.65, 0.95) * side);
        let height = random.within(4.0, 16.0);
        boxes.push(Cuboid::on(centre, [w, d, height]));
        if random.within(0.0, 1.0) < 0.4 {
            let above = [centre[0], centre[1], height];
            boxes.push(Cuboid::on(above, [0.5 * w, 0.5 * d, random.within(2.0, 8.0)]));
        }
    }
    if block.is_multiple_of(2) {
        arch([x, y + random.within(8.0, 24.0), 0.0], boxes);
    }
    for i in 0..4 {
        let along = 8.0 * i as f32 + random.within(2.0, 6.0);
        boxes.push(Cuboid::on([x + HALF_STREET - 0.6, y + along, 0.0], [0.2, 0.2, 6.0]));
        boxes.push(Cuboid::on([x + along, y + HALF_STREET - 0.6, 0.0], [0.15, 0.15, 4.0]));
    }
}

/// Two piers and a lintel across a street along y.
fn arch([x, y, z]: Place, boxes: &mut Vec<Cuboid>) {
    for side in [-1.0, 1.0] {
        boxes.push(Cuboid::on([x + side * 3.2, y, z], [0.8, 1.0, 4.5]));
    }
    boxes.push(Cuboid::on([x, y, z + 4.5], [7.2, 1.0, 1.5]));
}

/// Bars with holes between two rails around a garden.
fn fence(random: &mut Random, [x, y, z]: Place, side: f32, boxes: &mut Vec<Cuboid>) {
    let height = random.within(1.6, 2.4);
    let bars = (side / 0.5) as usize;
    for (near, across) in [(0.2, true), (side - 0.2, true), (0.2, false), (side - 0.2, false)] {
        let at = |along: f32| if across { [x + along, y + near, z] } else { [x + near, y + along, z] };
        let sized = |along: f32, thick: f32| if across { [along, thick] } else { [thick, along] };
        for bar in 0..bars {
            let [w, d] = sized(0.25, 0.1);
            boxes.push(Cuboid::on(at(0.5 * bar as f32 + 0.25), [w, d, height]));
        }
        let [w, d] = sized(side - 0.4, 0.06);
        for rail in [0.3, height - 0.3] {
            let [px, py, pz] = at(0.5 * side);
            boxes.push(Cuboid::on([px, py, pz + rail], [w, d, 0.12]));
        }
    }
}

/// Trees of a trunk and a crown, and a fence.
fn forest(random: &mut Random, [x, y, _]: Place, boxes: &mut Vec<Cuboid>) {
    for _ in 0..22 {
        let base = [x + random.within(0.0, BLOCK), y + random.within(0.0, BLOCK), 0.0];
        // Streets stay open: cameras move along them.
        if [base[0] - x, base[1] - y].iter().any(|away| away.min(BLOCK - away) < 3.0) {
            continue;
        }
        let (thick, height) = (random.within(0.25, 0.7), random.within(3.0, 9.0));
        boxes.push(Cuboid::on(base, [thick, thick, height]));
        let crown = random.within(1.2, 3.5);
        boxes.push(Cuboid::on([base[0], base[1], height - 0.5], [crown, crown, random.within(2.0, 5.0)]));
    }
    fence(random, [x + 10.0, y + 10.0, 0.0], 8.0, boxes);
}

/// Objects to be culled: small ones in streets and gardens, and larger ones as houses are.
pub fn objects(seed: u32, count: usize) -> Vec<Cuboid> {
    let mut random = Random::new(u64::from(seed) ^ 0x0b1e_c750);
    let object = |i: usize| {
        let base = [random.within(0.0, 128.0), random.within(0.0, 128.0), random.within(0.0, 2.0)];
        let [low, high] = if i.is_multiple_of(4) { [2.0, 6.0] } else { [0.3, 2.0] };
        Cuboid::on(base, [0, 1, 2].map(|_| random.within(low, high)))
    };
    (0..count).map(object).collect()
}
