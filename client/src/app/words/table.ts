import { ARCHITECTURE } from "./architecture";
import { BACKGROUND } from "./background";
import { BARS } from "./bars";
import { BRANCHES } from "./branches";
import { BRUSH } from "./brush";
import { COLOURS } from "./colours";
import { CONTROLS } from "./controls";
import { DRAWMODE } from "./drawmode";
import { HELP } from "./help";
import { LEAVES } from "./leaves";
import { NOTICES } from "./notices";
import { PANELS } from "./panels";
import { PARAMETERS } from "./parameters";
import { PROBLEMS } from "./problems";
import { ROTATION } from "./rotation";
import { SCENE } from "./scene";
import { SETTINGS } from "./settings";
import { SHEETS } from "./sheets";
import { SUN } from "./sun";
import { TIMELINE } from "./timeline";
import { TOOLS } from "./tools";

/** Every text a person reads: English, German. One file an area; a key begins with its area. */
export const TABLE = {
  ...COLOURS,
  ...ARCHITECTURE,
  ...BRUSH,
  ...PARAMETERS,
  ...LEAVES,
  ...DRAWMODE,
  ...CONTROLS,
  ...BRANCHES,
  ...BACKGROUND,
  ...BARS,
  ...NOTICES,
  ...PANELS,
  ...ROTATION,
  ...SETTINGS,
  ...PROBLEMS,
  ...SCENE,
  ...SHEETS,
  ...SUN,
  ...TIMELINE,
  ...TOOLS,
  ...HELP,
} as const satisfies Record<string, readonly [string, string]>;
