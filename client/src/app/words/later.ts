import { ACCOUNTS } from "./accounts";
import { ARCHITECTURE } from "./architecture";
import { BACKGROUND } from "./background";
import { BRANCHES } from "./branches";
import { BRUSH } from "./brush";
import { CHIPS } from "./chips";
import { COLOURS } from "./colours";
import { COMMENTS } from "./comments";
import { CONTROLS } from "./controls";
import { DRAWMODE } from "./drawmode";
import { ENTRY } from "./entry";
import { EXPORTS } from "./exports";
import { FINDING } from "./finding";
import { GIFTS } from "./gifts";
import { GRAMMARS } from "./grammars";
import { HELP } from "./help";
import { LEAVES } from "./leaves";
import { LIBRARY } from "./library";
import { LINKS } from "./links";
import { PARAMETERS } from "./parameters";
import { PROBLEMS, REFUSALS } from "./problems";
import { REPLAY } from "./replay";
import { SCENE } from "./scene";
import { SERVER } from "./server";
import { SETTINGS } from "./settings";
import { SHEETS } from "./sheets";
import { STRUCTURE } from "./structure";
import { SUN } from "./sun";
import { TIMELINE } from "./timeline";
import { TOGETHER } from "./together";
import { SHAPING } from "./tools";
import { TRANSFERS } from "./transfers";
import { VARIATIONS } from "./variations";
import { WIND } from "./wind";

/** The texts of the parts that are loaded when they are first needed; a page loads them in one language. */
export const LATER = {
  ...ACCOUNTS,
  ...COLOURS,
  ...COMMENTS,
  ...DRAWMODE,
  ...ARCHITECTURE,
  ...BRUSH,
  ...PARAMETERS,
  ...LEAVES,
  ...CONTROLS,
  ...BRANCHES,
  ...BACKGROUND,
  ...SETTINGS,
  ...SERVER,
  ...PROBLEMS,
  ...REFUSALS,
  ...REPLAY,
  ...SCENE,
  ...SHEETS,
  ...ENTRY,
  ...EXPORTS,
  ...FINDING,
  ...GIFTS,
  ...LIBRARY,
  ...LINKS,
  ...SUN,
  ...SHAPING,
  ...HELP,
  ...CHIPS,
  ...TOGETHER,
  ...TRANSFERS,
  ...VARIATIONS,
  ...TIMELINE,
  ...STRUCTURE,
  ...GRAMMARS,
  ...WIND,
} as const satisfies Record<string, readonly [string, string]>;
