//! The surroundings of a grammar that is written anew over what stands of it: with other values, another text or another
//! body.

use espalier_growth::{Change, Drawn, Generator, Growth, Rewriting, Rewritten, Scene};
use espalier_plant::MetamerId;

use super::{Source, WriteError, Written};

/// What laying down a node or a metamer costs, beside what drawing and deriving a module cost.
const LAYING: u64 = 4;

/// The same scene in which a grammar grows from its axiom, step by step, as if it had never stood there. Otherwise the
/// first shoots would be asked for their light in the shade of the crown that takes their place.
#[derive(Clone, Debug)]
pub(super) struct Anew {
    pub scene: Scene,
    /// The light and vigor in it.
    pub growth: Growth,
    /// What stands of the grammar there.
    stands: Rewritten,
    /// The depth at which it stands there.
    pub depth: Option<u32>,
}

impl Anew {
    /// The scene without what a grammar has written, and what has grown on that.
    pub fn new(scene: &Scene, growth: &Growth, source: &Source, now: &Written) -> Self {
        let (mut scene, mut growth) = (scene.clone(), growth.clone());
        // What dies here is not dead in the document; what may stand there is checked there.
        scene.set_metamer_budget(u32::MAX);
        let id = |row: u32| MetamerId::new(row as usize);
        let wood: Vec<_> = now.rows.iter().map(|&(_, row)| id(row)).collect();
        scene.record_edit(|step| step.prune(&wood));
        growth.follow(&scene, &Change::Edited);
        if source.asks_of_vigor {
            growth.look(&scene);
        }
        let plant = scene.plant();
        let rows = now.rows.iter().copied().filter(|&(_, row)| plant.is_seed(id(row))).collect();
        Self { scene, growth, stands: Rewritten { rows, ..Rewritten::default() }, depth: None }
    }

    /// The names of what stands there.
    pub fn keys(&self) -> Vec<u64> {
        self.stands.rows.iter().map(|&(key, _)| key).collect()
    }

    /// What copying and laying down cost.
    pub fn cost(&self) -> u64 {
        LAYING * self.scene.plant().metamer_count() as u64
    }

    /// Lets it stand there as it is drawn at a depth.
    pub fn lay_down(
        &mut self,
        source: &Source,
        drawn: &espalier_grammar::Drawn,
        depth: u32,
    ) -> Result<(), WriteError> {
        let now = Drawn { wood: &drawn.wood, keys: &drawn.keys };
        let Rewritten { rows, ends, .. } = &self.stands;
        let rewriting = Rewriting { now, before: None, rows, ends, at: source.at };
        rewriting.check(&self.scene)?;
        let parameters = self.growth.parameters();
        self.stands = self.scene.record_growth(|step| rewriting.write(step, parameters))?;
        self.growth.follow(&self.scene, &Change::Edited);
        if source.asks_of_vigor {
            self.growth.look(&self.scene);
        }
        self.depth = Some(depth);
        Ok(())
    }
}
