import { say } from "../../../words/say";
import type { Swatch } from "../../controls/colour-field";

/** Names of the colours that are offered. */
const NAMED = {
  "spring-green": [150, 186, 84],
  green: [88, 128, 52],
  "dark-green": [52, 92, 48],
  "blue-green": [92, 128, 112],
  "grey-green": [138, 150, 112],
  copper: [138, 66, 48],
  white: [246, 240, 236],
  cream: [244, 226, 182],
  rose: [240, 170, 190],
  pink: [216, 92, 136],
  purple: [142, 84, 158],
  yellow: [232, 196, 66],
  orange: [222, 128, 48],
  red: [178, 44, 34],
  "dark-red": [112, 28, 40],
  blue: [66, 74, 122],
  brown: [118, 84, 56],
  "dark-brown": [72, 54, 42],
  grey: [121, 110, 97],
  "light-grey": [172, 168, 160],
  "red-brown": [142, 86, 62],
  chalk: [226, 222, 214],
  sky: [190, 208, 222],
  sage: [190, 200, 180],
  dusk: [86, 92, 112],
  night: [38, 42, 52],
} as const;

type Name = keyof typeof NAMED;

function swatches(...names: readonly Name[]): () => readonly Swatch[] {
  return () => names.map((name) => ({ colour: NAMED[name], label: say(`colours.${name}`) }));
}

/** Colours that suit. */
export const SWATCHES = {
  leaves: swatches("spring-green", "green", "dark-green", "blue-green", "grey-green", "copper"),
  flowers: swatches("white", "cream", "rose", "pink", "purple", "yellow"),
  fruits: swatches("red", "dark-red", "orange", "yellow", "blue", "brown"),
  bark: swatches("grey", "light-grey", "chalk", "brown", "dark-brown", "red-brown"),
  backdrop: swatches("chalk", "sky", "sage", "rose", "dusk", "night"),
} as const;
