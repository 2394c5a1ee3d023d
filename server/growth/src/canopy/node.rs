//! What must be known of every node of a canopy in every sweep over it.

/// One node: a few bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node(u8);

impl Node {
    /// It continues its parent's axis.
    const MAIN: u8 = 1;
    /// Its axis' bud sits here.
    const TIP: u8 = 2;
    /// Lateral buds that have not grown sit here, and would grow in light.
    const LATERALS: u8 = 4;
    /// It has died, and is left out when the canopy is next packed.
    const DEAD: u8 = 8;

    /// A node without buds.
    pub fn new(is_main: bool) -> Self {
        Self(if is_main { Self::MAIN } else { 0 })
    }

    pub fn is_main(self) -> bool {
        self.0 & Self::MAIN != 0
    }

    pub fn is_tip(self) -> bool {
        self.0 & Self::TIP != 0
    }

    pub fn is_dead(self) -> bool {
        self.0 & Self::DEAD != 0
    }

    /// Whether any bud sits here that makes something of light.
    pub fn has_buds(self) -> bool {
        self.0 & (Self::TIP | Self::LATERALS) != 0
    }

    pub fn set_tip(&mut self, is_tip: bool) {
        self.set(Self::TIP, is_tip);
    }

    pub fn set_laterals(&mut self, has_laterals: bool) {
        self.set(Self::LATERALS, has_laterals);
    }

    /// From now on it has no buds.
    pub fn die(&mut self) {
        self.0 = self.0 & Self::MAIN | Self::DEAD;
    }

    fn set(&mut self, bit: u8, is_set: bool) {
        self.0 = self.0 & !bit | if is_set { bit } else { 0 };
    }
}
