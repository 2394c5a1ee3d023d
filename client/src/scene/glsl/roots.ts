/** Roots that a tree stands on at most; \`rootOf\` says which of them a seed has. */
export const MOST_ROOTS = 8;

/** The roots of a tree, by its number (see `TreeTable.numberOf`); `uBarkShape` says how much it has of them. */
export const ROOTS = /* glsl */ `
struct Root {
  float turn; // where it leaves, around the vertical
  float strong; // 0 to 1
  float narrow; // the more, the narrower the rib that it makes in the trunk
  float high; // over how much height that fades
  float chance; // of its own, 0 to 1
};
float chanceOf(uint tree, uint number) {
  uint mixed_ = tree * 747796405u + number * 2891336453u + 17u;
  mixed_ = (mixed_ ^ (mixed_ >> 16)) * 0x7feb352du;
  mixed_ = (mixed_ ^ (mixed_ >> 15)) * 0x846ca68bu;
  return float((mixed_ ^ (mixed_ >> 16)) >> 8) / 16777216.0;
}
int rootsOf(uint tree) { return 5 + int(3.99 * chanceOf(tree, 0u)); }
Root rootOf(uint tree, int i) {
  uint first = 8u * uint(i + 1);
  float turn = 6.2831853 * (float(i) + 0.72 * chanceOf(tree, first)) / float(rootsOf(tree));
  float strong = 0.3 + 0.7 * chanceOf(tree, first + 1u);
  return Root(turn, strong, mix(5.0, 9.0, chanceOf(tree, first + 2u)), (0.6 + 0.6 * chanceOf(tree, first + 3u)) * (0.55 + 0.6 * strong), chanceOf(tree, first + 4u));
}
/** How far from where it begins it ends, as the trunk is thick. */
float rootReach(Root root) { return (1.8 + 3.4 * root.strong) * min(uBarkShape.y, 1.5); }
/** Where the middle of a root runs, from the seed, and how thick it is: over the ground, and by and by into it. */
vec4 rootAt(Root root, float foot, float u) {
  float spreads = min(uBarkShape.y, 1.5);
  float reach = rootReach(root);
  float far = 0.5 + reach * u;
  float own = max(0.0, far - 1.7) / reach;
  float aside = reach * (0.9 * (root.chance - 0.5) * own * own + 0.12 * sin(7.0 * own * (0.8 + root.chance)) * own * (root.chance > 0.5 ? -1.0 : 1.0));
  float thick = spreads * (0.16 + 0.32 * root.strong) * (1.0 - 0.75 * u);
  // Its back comes out of the trunk and goes down into the ground.
  float back = spreads * (0.62 * root.strong * exp(-1.7 * max(0.0, far - 1.1)) + 0.15 * root.strong * (1.0 + 0.4 * sin(11.0 * u + 17.0 * root.chance)) - (0.06 + 0.27 * root.strong) * smoothstep(0.28, 0.92, u));
  float up = back - thick;
  vec2 towards = vec2(cos(root.turn), sin(root.turn));
  // Those of a sapling lie in the ground.
  up -= 1.5 * thick * (1.0 - smoothstep(0.12, 0.5, foot));
  return foot * vec4(towards.x * far - towards.y * aside, up, towards.y * far + towards.x * aside, thick);
}
`;
