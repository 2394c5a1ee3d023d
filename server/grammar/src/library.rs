//! Grammars that come with the program.

/// A grammar that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shipped {
    /// What it is called in addresses and on the command line.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($name:literal),+ $(,)?) => {
        /// All grammars that come with the program: curves, then herbs and leaves, then trees.
        pub const SHIPPED: &[Shipped] = &[
            $(Shipped { name: $name, text: include_str!(concat!("../grammars/", $name, ".lsys")) }),+
        ];
    };
}

shipped![
    "koch",
    "sierpinski",
    "dragon",
    "bush-bracketed",
    "bush-3d",
    "stochastic-twins",
    "signal",
    "fern-frond",
    "compound-leaf",
    "lilac",
    "mycelis",
    "timed-shoot",
    "barron-binary",
    "monopodial",
    "sympodial",
    "ternary-wind",
    "honda-maple",
    "leeuwenberg",
    "massart",
    "rauh",
    "topiary-box",
    "light-seeker",
];
