import { BEND } from "./bend/descriptor";
import { BRANCH } from "./branch/descriptor";
import { BRUSH } from "./brush/descriptor";
import type { Service, ToolDescriptor, ToolLater } from "./descriptor";
import { LASSO } from "./lasso/descriptor";
import { obstacleMover } from "./obstacle/mover";
import { PRUNE } from "./prune/descriptor";
import { SEED } from "./seed/descriptor";
import { WIDTH } from "./width/descriptor";

/** All tools, as they stand in the side bar; the first is chosen where no other is. */
export const TOOLS = {
  brush: BRUSH,
  lasso: LASSO,
  bend: BEND,
  width: WIDTH,
  prune: PRUNE,
  branch: BRANCH,
  seed: SEED,
} as const;

export type ToolName = keyof typeof TOOLS;
export type MadeTools = { readonly [Name in ToolName]?: Awaited<ReturnType<(typeof TOOLS)[Name]["make"]>> };

export const TOOL_NAMES = Object.keys(TOOLS) as ToolName[];
export const FIRST_TOOL: ToolName = "brush";

/** What takes a finger before the chosen tool does, while the scene is arranged. */
export const makeMover = obstacleMover;

/** The tool that does something for the rest of the page. */
export function toolFor(service: Service): ToolName {
  return TOOL_NAMES.find((name) => descriptorOf(name).serves === service) ?? FIRST_TOOL;
}

/** What is known of a tool, whichever it is. */
export function descriptorOf(name: ToolName): ToolDescriptor {
  return TOOLS[name];
}

/** The tool that a key on the keyboard chooses. */
export function toolOfKey(key: string): ToolName | undefined {
  return TOOL_NAMES.find((name) => descriptorOf(name).key.toLowerCase() === key.toLowerCase());
}

/** The later parts of all tools. */
export async function laterOfAll(): Promise<Readonly<Record<ToolName, ToolLater>>> {
  const all = await Promise.all(TOOL_NAMES.map(async (name) => [name, await descriptorOf(name).later()] as const));
  return Object.fromEntries(all) as Record<ToolName, ToolLater>;
}
