// What shaders and painters have to agree on. The page needs these before anything is painted.

/** Texels along each side of a tile of leaves at its finest. */
export const TILE_SIDE = 256;
/** What is painted stays this far from its tile's edges, in its own length, so that neighbours never show. */
export const TILE_MARGIN = 0.02;
/** Leaves in the picture of a sprig, which stands for so many single ones from afar. */
export const SPRIG_LEAVES = 6;
/** Half the width of a sprig's card, in its own lengths. */
export const SPRIG_REACH = 0.5;
/** Slopes of bark up to this are kept; steeper ones are cut off. */
export const MOST_SLOPE = 2;
/** Shades of bark up to this. */
export const MOST_SHADE = 1.25;
