//! Names of rows. Ids are birth order: an older row has the smaller id.

macro_rules! id {
    ($(#[doc = $doc:expr])+ $name:ident) => {
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(u32);

        impl $name {
            /// The row with this index.
            pub fn new(index: usize) -> Self {
                debug_assert!(index < u32::MAX as usize, "ids have 32 bits");
                Self(index as u32)
            }

            /// The row's index in its columns.
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// The index as 32 bits, as it travels and is hashed.
            pub fn raw(self) -> u32 {
                self.0
            }
        }
    };
}

id! {
    /// One metamer: an internode and the node at its end.
    MetamerId
}
id! {
    /// One axis: a bud and the metamers it has produced.
    AxisId
}

impl AxisId {
    /// Stands for "no such row" inside the columns.
    pub(crate) const NONE: Self = Self(u32::MAX);
}

impl MetamerId {
    /// Stands for "no such row" inside the columns; public functions return `Option` instead.
    pub(crate) const NONE: Self = Self(u32::MAX);

    pub(crate) fn some(self) -> Option<Self> {
        (self != Self::NONE).then_some(self)
    }
}
