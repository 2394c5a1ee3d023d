//! Pictures of species: a tree grown through its schedule, drawn from the front.

use std::{collections::BTreeMap, sync::Arc};

use espalier_export::picture::{self, Canvas, Look};
use espalier_growth::species::{self, Species};
use espalier_mesh::Style;
use espalier_proto::Problem;
use espalier_session::{Document, Principal, script, style_options};
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
    let style = Style::new(style_options(&document.parameters()));
    Ok(picture::draw(document.portrait(), &style, &Look::from(species), width, height))
}

/// A picture as a file, with what tells it from any other.
#[derive(Clone, Debug)]
pub struct Print {
    /// The PNG file.
    pub png: Arc<[u8]>,
    /// A tag in quotes, as HTTP has it.
    pub tag: String,
}

/// Pictures of all species, each made when it is first asked for.
#[derive(Clone, Debug)]
pub struct Portraits(Arc<BTreeMap<&'static str, OnceCell<Print>>>);

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
        Self(Arc::new(species::all().iter().map(|species| (species.slug, OnceCell::new())).collect()))
    }
}

impl Portraits {
    /// The picture of the species with this slug, if there is one.
    pub async fn of(&self, slug: &str, pool: &SimulationPool) -> Result<Option<Print>, PortraitError> {
        let (Some(cell), Some(species)) = (self.0.get(slug), species::find(slug)) else { return Ok(None) };
        let made = cell.get_or_try_init(|| async {
            let canvas = pool.run(Class::Whole, Person::default(), |_| {
                portrait(species, SEED, SIZE).map(|canvas| canvas.png())
            });
            let canvas = canvas.await??;
            Ok::<_, PortraitError>(Print { tag: tag_of(&canvas), png: canvas.into() })
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
    async fn a_picture_is_made_once_and_the_same() {
        let (portraits, pool) = (Portraits::default(), SimulationPool::new(NonZeroUsize::new(1)).unwrap());
        let first = portraits.of("juniper", &pool).await.unwrap().expect("a picture");
        let second = portraits.of("juniper", &pool).await.unwrap().expect("a picture");
        assert!(Arc::ptr_eq(&first.png, &second.png), "it is kept");
        let anew = Portraits::default().of("juniper", &pool).await.unwrap().expect("a picture");
        assert_eq!((&anew.png, anew.tag), (&first.png, first.tag));
        assert!(first.png.starts_with(b"\x89PNG") && first.png.len() > 4000);
        assert!(portraits.of("triffid", &pool).await.unwrap().is_none());
    }
}
