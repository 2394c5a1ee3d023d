import { BARS } from "./bars";
import { NOTICES } from "./notices";
import { PANELS } from "./panels";
import { REQUESTS } from "./problems";
import { ROTATION } from "./rotation";
import { MESHES } from "./scene";
import { SHEET_TITLES } from "./sheets";
import { OPERATIONS } from "./timeline";
import { TOOLS } from "./tools";

/** The texts that a page may need before it has loaded any of its parts, in every language. */
export const FIRST = {
  ...BARS,
  ...MESHES,
  ...NOTICES,
  ...OPERATIONS,
  ...PANELS,
  ...REQUESTS,
  ...ROTATION,
  ...SHEET_TITLES,
  ...TOOLS,
} as const satisfies Record<string, readonly [string, string]>;
