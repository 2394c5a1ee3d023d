/** Things whose numbers lie in one line of a texture. */
export const ITEMS_A_LINE = 512;

/** Which thing a vertex is of, and where its numbers are; see `item-texture.ts`. */
export const itemsOf = (sampler: "sampler2D" | "usampler2D", texels: number) => /* glsl */ `
uniform highp ${sampler} uItems;
uniform int uItemsDrawn[2]; // how many there are, and every how manieth is drawn
in vec2 item; // which of the things that one instance draws, and how many those are
int itemNumber() { return (gl_InstanceID * int(item.y) + int(item.x)) * uItemsDrawn[1]; }
ivec2 itemPlace(int number) {
  return ivec2((number & ${ITEMS_A_LINE - 1}) * ${texels}, number >> ${Math.log2(ITEMS_A_LINE)});
}
`;
