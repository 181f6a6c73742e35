//! The quantities that `eval` computes: their columns and domains, as the contract names them.

/// An input column: its name and the closed interval of its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Input {
    pub name: &'static str,
    pub min: f64,
    pub max: f64,
}

/// A quantity: the columns that it reads and those that it appends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quantity {
    pub name: &'static str,
    pub inputs: &'static [Input],
    pub outputs: &'static [&'static str],
}

const ALPHA: Input = Input { name: "alpha", min: 0.0, max: 1.0 };
const MU: Input = Input { name: "mu", min: 0.0, max: 1.0 };

/// All of them.
pub(super) static QUANTITIES: [Quantity; 2] = [
    Quantity { name: "ggx-reflection", inputs: &[ALPHA, MU], outputs: &["E", "A", "B", "loss", "error"] },
    Quantity { name: "ggx-average", inputs: &[ALPHA], outputs: &["E_avg", "loss_avg", "error"] },
];

/// The quantity of a name.
pub(super) fn from_name(name: &str) -> Result<&'static Quantity, String> {
    QUANTITIES.iter().find(|q| q.name == name).ok_or_else(|| {
        let names: Vec<&str> = QUANTITIES.iter().map(|q| q.name).collect();
        format!("no such quantity in this version; the quantities are {}", names.join(", "))
    })
}
