//! What the numbers of a body are about: each field has models of its own.

/// How a field's values are told in bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Any number of 32 bits: how long it is, then its bits.
    Number,
    /// A byte, from its highest bit on.
    Byte,
}

/// Contexts of a number: 16 for how long it is, and three for the two bits below the highest, for each length.
pub(super) const NUMBER_CONTEXTS: usize = 64;
/// Contexts of a byte: one for each beginning of it.
pub(super) const BYTE_CONTEXTS: usize = 256;

macro_rules! fields {
    ($($(#[$doc:meta])+ $field:ident $name:literal $shape:ident),+ $(,)?) => {
        /// What a number in a body is about.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        pub enum Field {
            $($(#[$doc])+ $field),+
        }

        impl Field {
            /// All of them; the number of a field is its place here.
            pub const ALL: &[Self] = &[$(Self::$field),+];

            /// Its name in `PROTOCOL.md`.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$field => $name),+
                }
            }

            /// How its values are told.
            pub fn shape(self) -> Shape {
                match self {
                    $(Self::$field => Shape::$shape),+
                }
            }
        }
    };
}

fields! {
    /// The first change.
    FirstChange "code of a change, the first" Number,
    /// What follows a change that forgets rows.
    ChangeAfterTruncate "code of a change after truncate" Number,
    /// What follows whole chunks.
    ChangeAfterReplace "code of a change after replace" Number,
    /// What follows new rows.
    ChangeAfterAppend "code of a change after append" Number,
    /// What follows new values.
    ChangeAfterPatch "code of a change after patch" Number,
    /// Rows that stay.
    Truncate "rows of truncate" Number,
    /// Which chunk the first change is about.
    FirstChunk "chunk, the first" Number,
    /// How far a chunk is from that of the change before.
    Chunk "chunk" Number,
    /// Age of a change.
    Age "age" Number,
    /// Rows a chunk has so far.
    Start "start" Number,
    /// How many rows.
    Count "count of rows" Number,
    /// Parent of the first row.
    FirstParent "parent, the first" Number,
    /// Parents of the others.
    Parent "parent" Number,
    /// Across the parent's way, where an axis goes on.
    OnAcross "position across, of what goes on" Number,
    /// Along it, where an axis goes on.
    OnAlong "position along, of what goes on" Number,
    /// Across it, of other rows.
    Across "position across" Number,
    /// Along it, of other rows.
    Along "position along" Number,
    /// Radius of the first row.
    FirstRadius "radius, the first" Number,
    /// Radii of the others.
    Radius "radius" Number,
    /// Leaves and vigor of the first row.
    FirstFoliage "foliage, the first" Byte,
    /// Those of the others.
    Foliage "foliage" Byte,
    /// Light of the first row.
    FirstLight "light, the first" Byte,
    /// Light of the others.
    Light "light" Byte,
    /// When the first row was born.
    FirstBorn "born, the first" Number,
    /// When the others were.
    Born "born" Number,
    /// Which column is patched.
    Column "column of patch" Number,
    /// How many radii are patched.
    RadiusCount "count of radii" Number,
    /// How many leaves and vigors are.
    FoliageCount "count of foliage" Number,
    /// How many values of light are.
    LightCount "count of light" Number,
    /// How many values of another column are.
    OtherCount "count of others" Number,
    /// The first row whose radius is patched.
    FirstRadiusGap "gap of radii, the first" Number,
    /// Rows skipped behind one that none was skipped before.
    RadiusGapAfterNone "gap of radii after a gap of 0" Number,
    /// Rows skipped behind one that some were skipped before.
    RadiusGap "gap of radii" Number,
    /// The first row whose leaves or vigor are patched.
    FirstFoliageGap "gap of foliage, the first" Number,
    /// As of radii.
    FoliageGapAfterNone "gap of foliage after a gap of 0" Number,
    /// As of radii.
    FoliageGap "gap of foliage" Number,
    /// The first row whose light is patched.
    FirstLightGap "gap of light, the first" Number,
    /// As of radii.
    LightGapAfterNone "gap of light after a gap of 0" Number,
    /// As of radii.
    LightGap "gap of light" Number,
    /// Gaps of other columns.
    OtherGap "gap of others" Number,
    /// By how much radii change.
    NewRadius "change of radius" Number,
    /// By how much leaves and vigor do.
    NewFoliage "change of foliage" Byte,
    /// By how many levels light does.
    NewLight "change of light" Number,
    /// New parents and births.
    NewNumber "new parent or born" Number,
    /// New places, each of their numbers.
    NewPosition "new position" Number,
    /// How many organs a row is given.
    Organs "organs of a row" Byte,
    /// Each byte of an organ.
    Organ "byte of an organ" Byte,
}

impl Field {
    /// How many contexts it has.
    pub(super) fn contexts(self) -> usize {
        match self.shape() {
            Shape::Number => NUMBER_CONTEXTS,
            Shape::Byte => BYTE_CONTEXTS,
        }
    }
}
