//! Grammars.

use std::sync::Arc;

use espalier_grammar::{Derivation, Grammar, Limits, OpenSky, SHIPPED, WoodOptions};

use crate::METAMERS;

/// Reads a grammar, derives it a few steps and draws it.
pub fn read(bytes: &[u8]) -> bool {
    let Some(grammar) = Grammar::check_bytes(bytes).grammar else { return false };
    let Ok(program) = grammar.program(&[]) else { panic!("what was read can be compiled") };
    let limits = Limits { modules: 3000, parameters: 6000, nesting: 64, work: 200_000 };
    let Ok(mut derivation) = Derivation::new(Arc::new(program), crate::SEED, limits) else { return true };
    for _ in 0..4 {
        let _ended = derivation.step(&OpenSky);
        let options = WoodOptions { nodes: METAMERS as usize, extent: 500, twig_radius: 0.05 };
        if let Ok(drawn) = derivation.draw(&OpenSky, options) {
            assert!(drawn.wood.nodes.iter().all(|node| node.end.is_finite()));
        }
    }
    true
}

/// All that come with the program.
pub fn seeds() -> Vec<Vec<u8>> {
    SHIPPED.iter().map(|shipped| shipped.text.as_bytes().to_vec()).collect()
}
