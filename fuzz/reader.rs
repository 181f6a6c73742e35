//! A reader of files, by its name in the environment, on what coverage finds.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;

#[path = "../tests/scene/readers.rs"]
mod readers;

static READ: LazyLock<fn(&[u8]) -> bool> = LazyLock::new(|| {
    let name = std::env::var("LOBEFIT_READER").expect("LOBEFIT_READER names a reader");
    readers::READERS.iter().find(|reader| reader.name == name).expect("a reader of this name").read
});

fuzz_target!(|bytes: &[u8]| {
    READ(bytes);
});
