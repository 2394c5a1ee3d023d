// Shows a sample tree without a server: `npm run dev`, then open /test/preview.html?seed=3&height=26&orders=3&frame.
// What it looks like may be given as JSON, section by section: &leaves={"shape":"needle"}&fruits={"kind":"cone"}; a view as in links:
// &yaw=30&zoom=2.

import { viewIn } from "../src/scene/camera/view";
import { Viewport } from "../src/scene/viewport";
import { type Appearance, DEFAULT_APPEARANCE } from "../src/wire/generated";
import { PlainTable } from "./plain-table";
import { sampleTree } from "./sample-tree";
import { type Skeleton, skeletonTree } from "./skeleton-tree";

const query = new URLSearchParams(location.search);
const number = (name: string, otherwise: number) => Number(query.get(name) ?? otherwise);
const canvas = document.querySelector("canvas")!;
const table = new PlainTable();
const viewport = new Viewport(canvas, table);
const appearance: Appearance = structuredClone(DEFAULT_APPEARANCE);
for (const [section, look] of Object.entries(appearance)) Object.assign(look, JSON.parse(query.get(section) ?? "{}"));
viewport.setAppearance(appearance);
viewport.setLeafSize(number("leaf", 0.7));
// A tree that `espalier grow --export TREE.json` wrote: &tree=/TREE.json&leaves_per_node=5.
const file = query.get("tree");
const sample = file
  ? skeletonTree((await (await fetch(file)).json()) as Skeleton, number("leaves_per_node", 5))
  : sampleTree({ seed: number("seed", 3), height: number("height", 26), orders: number("orders", 3) });
// With `&grow` it eases in, as growth that was just computed does.
table.apply({ ...sample, catchUp: !query.has("grow") });
viewport.changed();
const view = viewIn(location.search);
if (view) viewport.camera.look(view);
if (query.has("frame")) viewport.camera.fitTree();
Object.assign(globalThis, { table, viewport, appearance });
