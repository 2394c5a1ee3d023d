//! The plants of a scene as nodes and parts, in the order in which every file of triangles has them. Triangles come in
//! blocks, so that little is held of them at once.

use std::collections::BTreeMap;

use espalier_mesh::{Bodies, Body, Grain, RowDyes, Style, TriangleMesh, Wood, seeds};
use espalier_motion::Rig;
use espalier_plant::{MetamerId, Plant};
use espalier_settings::Appearance;
use glam::{Vec2, Vec3, Vec4};
use serde_json::{Value, json};

use crate::{
    Detail, ExportError, Model,
    billboard::Billboard,
    foliage::{
        Foliage,
        cards::{Cards, LeafForm, LeafInstance},
        living,
    },
    hull,
    lightmap::{
        LightMap, flat_cards,
        unrolled::{UnrolledWood, WoodMap},
    },
    surface::{
        Texture,
        bark::{Bark, CUT},
        thin::{self, Thin},
    },
    swaying::{Rider, Swaying},
};

/// Metamers whose leaves are made before they are written.
const BLOCK: usize = 1024;
/// The name of a plant of no known species.
const UNNAMED: &str = "Tree";

/// What triangles look like.
#[derive(Clone, Copy)]
pub(crate) enum Surface<'a> {
    /// Bark, and how deep its furrows look.
    Bark(&'a Bark, f32),
    /// What has pictures with nothing around them.
    Thin(&'a str, &'a Texture),
    /// One linear colour.
    Plain(&'static str, Vec3),
}

impl<'a> Surface<'a> {
    pub(crate) fn name(&self) -> &'a str {
        match self {
            Self::Bark(..) => "Bark",
            Self::Thin(name, _) | Self::Plain(name, _) => name,
        }
    }
}

/// Some triangles of a part, which name the block's own vertices.
pub(crate) struct Block<'a> {
    pub mesh: &'a TriangleMesh,
    pub tangents: &'a [Vec4],
    /// The linear colour of each vertex, which multiplies that of the texture.
    pub colours: &'a [Vec3],
    /// Triangles of the part's second surface.
    pub second: &'a [u32],
    /// The place of each vertex in the part's light map, upwards, where it has one.
    pub places: Option<&'a [Vec2]>,
    /// What each vertex goes along with in the wind; none where nothing sways.
    pub riders: &'a [Rider],
}

/// Gives blocks one by one, always the same; it may be asked several times.
pub(crate) type Each<'a, T> =
    &'a dyn Fn(&mut dyn FnMut(T) -> Result<(), ExportError>) -> Result<(), ExportError>;

/// Takes the blocks of a part.
pub(crate) type Take<'t> = dyn FnMut(Block<'_>) -> Result<(), ExportError> + 't;

/// Gives cards piece by piece, as [`Each`] does.
type EachCards<'a> = &'a dyn Fn(&mut dyn FnMut(&Cards) -> Result<(), ExportError>) -> Result<(), ExportError>;

/// Gives the blocks of a part, as [`Each`] does.
pub(crate) type Blocks<'a> = &'a dyn Fn(&mut Take<'_>) -> Result<(), ExportError>;

/// What one node shows.
pub(crate) struct Part<'a> {
    pub name: &'static str,
    pub surfaces: &'a [Surface<'a>],
    /// Whether the texture comes again beyond its borders.
    pub repeats: bool,
    pub lightmap: Option<&'a LightMap>,
    /// Whether its vertices have something to go along with.
    pub rides: bool,
    pub blocks: Blocks<'a>,
}

impl Part<'_> {
    /// All vertices lie within so many internodes of a place, along each axis.
    pub(crate) fn reach(&self, place: Vec3) -> Result<f32, ExportError> {
        let mut reach = 0.0f32;
        (self.blocks)(&mut |block| {
            let offsets = block.mesh.positions.iter().map(|&vertex| (vertex - place).abs().max_element());
            reach = offsets.fold(reach, f32::max);
            Ok(())
        })?;
        Ok(reach)
    }
}

/// Leaves as places of few forms.
pub(crate) struct Scatter<'a> {
    pub name: &'static str,
    pub surface: Surface<'a>,
    pub strength: f32,
    pub form: &'a LeafForm,
    pub each: Each<'a, (LeafInstance, Vec3)>,
}

/// Makes a file of nodes and parts.
pub(crate) trait Builder<'s> {
    /// The bones of the plant that is open, where it sways; they come before its parts.
    fn bones(&mut self, swaying: &'s Swaying, rig: Rig) -> Result<(), ExportError> {
        let _ = (swaying, rig);
        Ok(())
    }
    /// A node at a place, below the one that is open; what follows is below it.
    fn begin(&mut self, name: &str, place: Vec3, extras: Option<Value>) -> Result<(), ExportError>;
    /// The node that was begun last has all its parts.
    fn end(&mut self) -> Result<(), ExportError>;
    /// Triangles of the open node.
    fn part(&mut self, part: &Part<'_>) -> Result<(), ExportError>;
    /// Leaves of the open node; asked for where the model is instanced.
    fn scatter(&mut self, scatter: &Scatter<'_>) -> Result<(), ExportError>;
    /// A convex body around a piece of the open plant.
    fn hull(&mut self, name: &str, mesh: &TriangleMesh) -> Result<(), ExportError>;
}

/// The plants of a scene, ready to be drawn.
pub(crate) struct Assembly<'a> {
    plant: &'a Plant,
    looks: &'a Appearance,
    name: Option<&'a str>,
    model: &'a Model,
    dyes: &'a RowDyes,
    bark: Bark,
    thin: [Option<Thin>; 3],
    wood: Bodies,
    levels: Vec<Level<'a>>,
    swaying: Option<&'a Swaying>,
}

const PARTS: [&str; 3] = ["Leaves", "Flowers", "Fruits"];

struct Level<'a> {
    number: u8,
    bodies: Bodies,
    foliage: Foliage<'a>,
}

/// What one node of a plant shows: all of it, or a limb.
#[derive(Default)]
struct Limb<'a> {
    bodies: Vec<Body<'a>>,
    metamers: Vec<MetamerId>,
}

impl<'a> Assembly<'a> {
    pub(crate) fn of(
        plant: &'a Plant,
        style: &'a Style,
        looks: &'a Appearance,
        name: Option<&'a str>,
        model: &'a Model,
    ) -> Self {
        let wood = Bodies::of(plant, style, &looks.bark, Grain::default());
        let levels = model.detail.levels().into_iter().map(|number| {
            // A billboard shows a plant of the middle level.
            let drawn = usize::from(if number == Detail::BILLBOARD { 1 } else { number });
            Level {
                number,
                bodies: wood.in_grain(Grain::LEVELS[drawn]),
                foliage: Foliage::of(plant, style, looks, drawn).upon(&wood),
            }
        });
        let levels: Vec<_> = levels.collect();
        let borne = levels.first().map_or(looks, |level| level.foliage.look());
        Self {
            plant,
            looks,
            name,
            model,
            dyes: style.dyes(),
            bark: Bark::of(&looks.bark, style.dyes().greatest_of_bark()),
            thin: [
                Some(thin::leaves(&borne.leaves)),
                thin::flowers(&borne.flowers),
                thin::fruits(&borne.fruits),
            ],
            levels,
            wood,
            swaying: None,
        }
    }

    /// The same, with how it sways.
    pub(crate) fn moved_by(self, swaying: Option<&'a Swaying>) -> Self {
        Self { swaying, ..self }
    }

    /// How many plants there are at most.
    pub(crate) fn plants(&self) -> usize {
        (0..self.plant.metamer_count()).map(MetamerId::new).filter(|&id| self.plant.is_seed(id)).count()
    }

    /// At most so many nodes will have parts; none where no plant has grown.
    pub(crate) fn most_parts(&self) -> usize {
        if living(self.plant).next().is_none() {
            return 0;
        }
        let most = u32::from(self.model.by_limb);
        let stems = self.wood.limbs().all().iter().filter(|limb| limb.level <= most).count();
        let leaves = if self.model.instanced { LeafForm::PROTOTYPES } else { 1 };
        let parts = PARTS.len() + leaves + 2 * usize::from(self.model.hull);
        stems * self.levels.len() * parts
    }

    /// Gives all nodes and parts to what makes a file of them.
    pub(crate) fn build(&self, builder: &mut dyn Builder<'a>) -> Result<(), ExportError> {
        let (plant, by_seed) = (self.plant, self.by_seed());
        let is_standing = |&id: &MetamerId| plant.is_seed(id) && plant.is_alive(id);
        let seeds: Vec<_> = (0..plant.metamer_count()).map(MetamerId::new).filter(is_standing).collect();
        for (number, &seed) in (1..).zip(&seeds) {
            let name = self.name.unwrap_or(UNNAMED);
            let name = if seeds.len() == 1 { name.to_owned() } else { format!("{name} {number}") };
            let ids = by_seed.get(&seed).map_or(&[][..], Vec::as_slice);
            let place = plant.metamers().end(seed);
            builder.begin(&name, place, Some(json!({ "row": seed.raw(), "metamers": ids.len() })))?;
            if !ids.is_empty() {
                self.plant(builder, &name, number, seed, ids)?;
            }
            builder.end()?;
        }
        Ok(())
    }

    fn plant(
        &self,
        builder: &mut dyn Builder<'a>,
        name: &str,
        number: usize,
        seed: MetamerId,
        ids: &[MetamerId],
    ) -> Result<(), ExportError> {
        let place = self.plant.metamers().end(seed);
        if let (Some(swaying), Some(most)) = (self.swaying, self.model.sway) {
            builder.bones(swaying, swaying.rig(seed, most))?;
        }
        for level in &self.levels {
            let is_set = self.model.detail == Detail::Set;
            if is_set {
                let extras = json!({ "lod": level.number });
                builder.begin(&format!("{name}_LOD{}", level.number), place, Some(extras))?;
            }
            let limbs = self.limbs(level, seed, ids);
            if level.number == Detail::BILLBOARD {
                self.billboard(builder, level, &limbs, place, number)?;
            } else if self.model.by_limb {
                for (number, (stem, limb)) in limbs.iter().enumerate() {
                    let begins = &self.wood.limbs().all()[*stem as usize];
                    let name = if begins.level == 0 { "Trunk".to_owned() } else { format!("Limb {number}") };
                    let foot = self.wood.places()[begins.node as usize];
                    let axis = self.plant.metamers().axis(MetamerId::new(begins.first as usize));
                    builder.begin(&name, foot, Some(json!({ "axis": axis.raw() })))?;
                    self.parts(builder, level, limb)?;
                    builder.end()?;
                }
            } else {
                for limb in limbs.values() {
                    self.parts(builder, level, limb)?;
                }
            }
            if is_set {
                builder.end()?;
            }
        }
        if self.model.hull
            && let Some(level) = self.levels.first()
        {
            for (number, mesh) in (1..).zip(hull::of_plant(self.plant, &level.foliage, ids)) {
                builder.hull(&format!("UCX_{name}_{number:02}"), &mesh)?;
            }
        }
        Ok(())
    }

    /// The living metamers of each plant.
    fn by_seed(&self) -> BTreeMap<MetamerId, Vec<MetamerId>> {
        let seed_of = seeds(self.plant);
        let mut by_seed: BTreeMap<MetamerId, Vec<MetamerId>> = BTreeMap::new();
        for id in living(self.plant) {
            by_seed.entry(seed_of[id.index()]).or_default().push(id);
        }
        by_seed
    }

    /// A plant's limbs by the number of the one that each begins with, or all of it in one.
    fn limbs<'b>(&self, level: &'b Level<'_>, seed: MetamerId, ids: &[MetamerId]) -> BTreeMap<u32, Limb<'b>> {
        let all = self.wood.limbs();
        let most = u32::from(self.model.by_limb);
        let stem_of = |id: &MetamerId| {
            let mut limb = all.limb(id.raw())?;
            while all.all()[limb as usize].level > most
                && let Some(bearer) = all.all()[limb as usize].bearer
            {
                limb = bearer;
            }
            Some(limb)
        };
        let mut limbs: BTreeMap<u32, Limb<'b>> = BTreeMap::new();
        for body in level.bodies.iter().filter(|body| body.seed() == seed) {
            if let Some(stem) = body.metamers().first().and_then(stem_of) {
                limbs.entry(stem).or_default().bodies.push(body);
            }
        }
        for &id in ids {
            if let Some(stem) = stem_of(&id) {
                limbs.entry(stem).or_default().metamers.push(id);
            }
        }
        limbs
    }

    fn parts(
        &self,
        builder: &mut dyn Builder<'a>,
        level: &Level<'_>,
        limb: &Limb<'_>,
    ) -> Result<(), ExportError> {
        let surfaces = [Surface::Bark(&self.bark, self.looks.bark.relief), Surface::Plain("Cut", CUT)];
        if !limb.bodies.is_empty() {
            let map = self.model.lightmap.map(|texels| WoodMap::of(&limb.bodies, texels));
            let blocks: Blocks<'_> = &|take| match &map {
                Some(map) => self.unrolled_wood(limb, map, take),
                None => self.wood(limb, take),
            };
            let lightmap = map.as_ref().map(|map| &map.map);
            let rides = self.swaying.is_some();
            builder.part(&Part {
                name: "Wood",
                surfaces: &surfaces,
                repeats: true,
                lightmap,
                rides,
                blocks,
            })?;
        }
        for (kind, thin) in self.thin.iter().enumerate() {
            let (name, Some(thin)) = (PARTS[kind], thin) else { continue };
            let surface = Surface::Thin(name, &thin.texture);
            if kind == 0 && self.model.instanced {
                let each: Each<'_, (LeafInstance, Vec3)> = &|take| {
                    for &id in &limb.metamers {
                        level.foliage.instances(id).try_for_each(&mut *take)?;
                    }
                    Ok(())
                };
                let (strength, form) = (thin.strength, level.foliage.form());
                builder.scatter(&Scatter { name, surface, strength, form, each })?;
                continue;
            }
            let each: EachCards<'_> = &|take| cards(level, limb, kind, thin.strength, take);
            self.cards(builder, name, surface, self.swaying.is_some(), each)?;
        }
        Ok(())
    }

    fn wood(&self, limb: &Limb<'_>, take: &mut Take<'_>) -> Result<(), ExportError> {
        let Some(first) = limb.bodies.first() else { return Ok(()) };
        let mut wood = Wood::of(first.seed());
        let mut colours = Vec::new();
        for body in &limb.bodies {
            body.sweep(&mut wood);
            colours.extend(self.bark.tints(&wood, self.dyes));
            let (mesh, tangents) = (&wood.surface, &wood.tangents);
            let riders = self.riders(body, mesh);
            let (second, riders) = (&wood.cuts[..], &riders[..]);
            take(Block { mesh, tangents, colours: &colours, second, places: None, riders })?;
            wood.clear();
            colours.clear();
        }
        Ok(())
    }

    /// Wood with its places in a light map.
    fn unrolled_wood(&self, limb: &Limb<'_>, map: &WoodMap, take: &mut Take<'_>) -> Result<(), ExportError> {
        map.each(&limb.bodies, |body, UnrolledWood { wood, places }| {
            let colours: Vec<Vec3> = self.bark.tints(wood, self.dyes).collect();
            let (mesh, tangents) = (&wood.surface, &wood.tangents);
            let riders = self.riders(body, mesh);
            let (second, places, riders) = (&wood.cuts[..], Some(&places[..]), &riders[..]);
            take(Block { mesh, tangents, colours: &colours, second, places, riders })
        })
    }

    /// What the vertices of a body go along with; nothing where nothing sways.
    fn riders(&self, body: &Body<'_>, mesh: &TriangleMesh) -> Vec<Rider> {
        self.swaying.map_or_else(Vec::new, |swaying| swaying.along(body, &mesh.positions))
    }

    /// A part of cards, with their places in a light map where one is asked for.
    fn cards(
        &self,
        builder: &mut dyn Builder<'a>,
        name: &'static str,
        surface: Surface<'_>,
        rides: bool,
        each: EachCards<'_>,
    ) -> Result<(), ExportError> {
        let map = match self.model.lightmap {
            None => None,
            Some(texels) => {
                let mut sizes = Vec::new();
                each(&mut |cards| {
                    sizes.extend(flat_cards::sizes(cards));
                    Ok(())
                })?;
                Some(LightMap::of(&sizes, texels))
            }
        };
        let lightmap = map.as_ref();
        let blocks: Blocks<'_> = &|take| {
            let (mut piece, mut places) = (0, Vec::new());
            each(&mut |cards| {
                places.clear();
                if let Some(map) = lightmap {
                    flat_cards::places(cards, map, piece, &mut places);
                    piece += cards.grids.len();
                }
                take(Block { places: lightmap.map(|_| &places[..]), ..shown(cards) })
            })
        };
        builder.part(&Part { name, surfaces: &[surface], repeats: false, lightmap, rides, blocks })
    }

    /// Two crossed cards with pictures of the plant.
    fn billboard(
        &self,
        builder: &mut dyn Builder<'a>,
        level: &Level<'_>,
        limbs: &BTreeMap<u32, Limb<'_>>,
        place: Vec3,
        number: usize,
    ) -> Result<(), ExportError> {
        let each = |take: &mut dyn FnMut(&Texture, Block<'_>) -> Result<(), ExportError>| {
            for limb in limbs.values() {
                self.wood(limb, &mut |block| take(&self.bark.texture, block))?;
                for (kind, thin) in self.thin.iter().enumerate() {
                    let Some(thin) = thin else { continue };
                    let mut take = |cards: &Cards| take(&thin.texture, shown(cards));
                    cards(level, limb, kind, thin.strength, &mut take)?;
                }
            }
            Ok(())
        };
        let Billboard { cards, texture } = Billboard::of(place, &each)?;
        // Each plant has pictures of its own.
        let name = if number == 1 { "Billboard".to_owned() } else { format!("Billboard_{number}") };
        self.cards(builder, "Billboard", Surface::Thin(&name, &texture), false, &|take| take(&cards))
    }
}

/// Cards as a block that is in no light map.
fn shown(cards: &Cards) -> Block<'_> {
    let Cards { mesh, tangents, hues, riders, .. } = cards;
    Block { mesh, tangents, colours: hues, second: &[], places: None, riders }
}

/// Gives leaves, flowers or fruits.
fn cards(
    level: &Level<'_>,
    limb: &Limb<'_>,
    kind: usize,
    strength: f32,
    take: &mut dyn FnMut(&Cards) -> Result<(), ExportError>,
) -> Result<(), ExportError> {
    let mut cards = Cards::default();
    for block in limb.metamers.chunks(BLOCK) {
        for &id in block {
            match kind {
                0 => level.foliage.add_leaves(&mut cards, id),
                1 => level.foliage.add_flowers(&mut cards, id),
                _ => level.foliage.add_fruits(&mut cards, id),
            }
            cards.ride_on(id);
        }
        for hue in &mut cards.hues {
            *hue *= strength;
        }
        take(&cards)?;
        cards.clear();
    }
    Ok(())
}
