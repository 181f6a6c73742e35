//! Files that somebody damaged: each is read or refused, without a panic and soon.

use std::path::Path;
use std::time::{Duration, Instant};

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::readers::READERS;

/// Mutations of the files of a format.
const TRIALS: u64 = 20_000;

/// Longest time for a file.
const LONGEST: Duration = Duration::from_secs(2);

/// What parsers are tempted by.
const TOKENS: [&[u8]; 20] = [
    b"1e308",
    b"-1",
    b"NaN",
    b"1e-400",
    b"0",
    b"18446744073709551616",
    b"\"",
    b"\\ud800",
    b"[[[[[[[[",
    b"{\"a\":",
    b"<a b=\"",
    b"&#x0;",
    b"<!--",
    b"//",
    b"/*",
    b"((((((((",
    b"\0",
    b"\xff",
    b"\xe2\x80\xae",
    b"\r\n",
];

/// One to three changes of a file: a bit, a byte, a token, a piece gone or there twice.
fn mutated(whole: &[u8], random: &mut Pcg64) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for _ in 0..=random.next_u32() % 3 {
        let mut below = |most: usize| (random.next_u64() % most.max(1) as u64) as usize;
        // Headers are at the beginning.
        let span = if below(3) == 0 { bytes.len().min(64) } else { bytes.len() };
        let at = below(span);
        let end = (at + 1 + below(24)).min(bytes.len());
        match below(6) {
            0 if at < end => bytes[at] ^= 1 << below(8),
            1 if at < end => bytes[at] = below(256) as u8,
            2 => drop(bytes.splice(at..at, TOKENS[below(TOKENS.len())].iter().copied())),
            3 => drop(bytes.splice(at..end, TOKENS[below(TOKENS.len())].iter().copied())),
            4 => drop(bytes.drain(at..end)),
            _ => bytes.extend_from_within(at..end),
        }
    }
    bytes
}

#[test]
fn mutated_files_are_read_or_refused() {
    for reader in &READERS {
        let (mut taken, mut refused) = (0, 0);
        for seed in reader.seeds {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(seed);
            let whole = std::fs::read(path).unwrap_or_else(|error| panic!("{seed}: {error}"));
            assert!((reader.read)(&whole), "{seed}: not a file of {}", reader.name);
            for trial in 0..TRIALS / reader.seeds.len() as u64 {
                let bytes = mutated(&whole, &mut Pcg64::seed_from_u64(trial));
                let start = Instant::now();
                let is_taken = (reader.read)(&bytes);
                // A machine that is busy may take long once.
                let again = start.elapsed() > LONGEST && {
                    let start = Instant::now();
                    (reader.read)(&bytes);
                    start.elapsed() > LONGEST
                };
                assert!(!again, "{seed}: trial {trial} takes more than {LONGEST:?}");
                *if is_taken { &mut taken } else { &mut refused } += 1;
            }
        }
        assert!(
            taken > TRIALS / 100 && refused > TRIALS / 20,
            "{}: {taken} taken, {refused} refused",
            reader.name
        );
    }
}
