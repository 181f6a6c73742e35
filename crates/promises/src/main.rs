//! Prints `docs/promises.md`.

fn main() {
    print!("{}", lobefit_promises::page());
}
