//! Pictures of species and grammars: a tree grown through its schedule, or derived, drawn from the front.

use std::{collections::BTreeMap, sync::Arc};

use espalier_export::picture::{self, Canvas, Look};
use espalier_grammar::{SHIPPED, Shipped};
use espalier_growth::species::{self, Species};
use espalier_proto::Problem;
use espalier_session::{Document, Principal, grammar_script, script, shipped_grammar};
use tokio::sync::OnceCell;

use crate::pool::{Class, Panicked, Person, SimulationPool};

/// The seed of pictures that are made once.
const SEED: u32 = 1;
/// Pixels of such a picture, across and down: three of a card's for one on a sharp screen.
const SIZE: (usize, usize) = (384, 396);

/// A tree of a species at its age.
pub fn portrait(species: &Species, seed: u32, (width, height): (usize, usize)) -> Result<Canvas, Problem> {
    let mut document = Document::new(seed);
    for action in script(species) {
        document.apply(&Principal::visitor(), &action.into())?;
    }
    let style = document.style();
    Ok(picture::draw(document.portrait(), &style, &Look::from(species), width, height))
}

/// What a grammar that comes with the program writes.
fn portrait_of_grammar(shipped: &Shipped, (width, height): (usize, usize)) -> Result<Canvas, Problem> {
    let mut document = Document::new(SEED);
    // Each of them is read by a test.
    if let Ok(action) = grammar_script(shipped.text, None) {
        document.apply(&Principal::visitor(), &action.into())?;
    }
    let style = document.style();
    let look = Look { appearance: *document.appearance(), ..Look::default() };
    Ok(picture::draw(document.portrait(), &style, &look, width, height))
}

/// A picture as a file, with what tells it from any other.
#[derive(Clone, Debug)]
pub struct Print {
    /// The PNG file.
    pub png: Arc<[u8]>,
    /// A tag in quotes, as HTTP has it.
    pub tag: String,
}

/// What there are pictures of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sitter<'a> {
    /// A species, by its slug.
    Species(&'a str),
    /// A grammar that comes with the program, by its name.
    Grammar(&'a str),
}

impl Sitter<'_> {
    fn drawn(self) -> Result<Option<Canvas>, Problem> {
        match self {
            Self::Species(slug) => species::find(slug).map(|one| portrait(one, SEED, SIZE)).transpose(),
            Self::Grammar(name) => {
                shipped_grammar(name).map(|one| portrait_of_grammar(one, SIZE)).transpose()
            }
        }
    }
}

/// Pictures of all species and of grammars that come with the program, each made when it is first asked for.
#[derive(Clone, Debug)]
pub struct Portraits(Arc<BTreeMap<Sitter<'static>, OnceCell<Print>>>);

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PortraitError {
    /// The drawing panicked.
    #[error(transparent)]
    Panicked(#[from] Panicked),
    /// The species' schedule cannot be done.
    #[error("its schedule cannot be done: {0}")]
    Schedule(#[from] Problem),
}

impl Default for Portraits {
    fn default() -> Self {
        let species = species::all().iter().map(|species| Sitter::Species(species.slug));
        let grammars = SHIPPED.iter().map(|shipped| Sitter::Grammar(shipped.name));
        Self(Arc::new(species.chain(grammars).map(|sitter| (sitter, OnceCell::new())).collect()))
    }
}

impl Portraits {
    /// The picture of somebody, if there is such a one.
    pub async fn of(
        &self,
        sitter: Sitter<'_>,
        pool: &SimulationPool,
    ) -> Result<Option<Print>, PortraitError> {
        let mut all = self.0.iter();
        let Some((&sitter, cell)) = all.find(|(known, _)| **known == sitter) else { return Ok(None) };
        let made = cell.get_or_try_init(|| async {
            let canvas = pool.run(Class::Whole, Person::default(), move |_| sitter.drawn());
            let png = canvas.await??.map(|canvas| canvas.png()).unwrap_or_default();
            Ok::<_, PortraitError>(Print { tag: tag_of(&png), png: png.into() })
        });
        made.await.map(|print| Some(print.clone()))
    }
}

/// FNV-1a of the bytes, which differs where pictures do.
fn tag_of(png: &[u8]) -> String {
    let add = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!("\"{:016x}\"", png.iter().fold(0xcbf2_9ce4_8422_2325, add))
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use super::*;

    #[tokio::test]
    async fn gr7_grammars_have_pictures() {
        let (portraits, pool) = (Portraits::default(), SimulationPool::new(NonZeroUsize::new(1)).unwrap());
        let pictures = ["koch", "fern-frond", "barron-binary"].map(Sitter::Grammar);
        for sitter in pictures {
            let print = portraits.of(sitter, &pool).await.unwrap().expect("a picture");
            assert!(print.png.starts_with(b"\x89PNG") && print.png.len() > 4000, "{sitter:?}");
        }
    }

    #[tokio::test]
    async fn a_picture_is_made_once_and_the_same() {
        let (portraits, pool) = (Portraits::default(), SimulationPool::new(NonZeroUsize::new(1)).unwrap());
        let first = portraits.of(Sitter::Species("juniper"), &pool).await.unwrap().expect("a picture");
        let second = portraits.of(Sitter::Species("juniper"), &pool).await.unwrap().expect("a picture");
        assert!(Arc::ptr_eq(&first.png, &second.png), "it is kept");
        let anew =
            Portraits::default().of(Sitter::Species("juniper"), &pool).await.unwrap().expect("a picture");
        assert_eq!((&anew.png, anew.tag), (&first.png, first.tag));
        assert!(first.png.starts_with(b"\x89PNG") && first.png.len() > 4000);
        assert!(portraits.of(Sitter::Grammar("triffid"), &pool).await.unwrap().is_none());
    }
}
