// Shows a sample tree without a server: `npm run dev`, then open /test/preview.html?seed=3&height=26&orders=3&frame.
import { TreeTable } from "../src/scene/tree-table";
import { Viewport } from "../src/scene/viewport";
import { sampleTree } from "./sample-tree";

const query = new URLSearchParams(location.search);
const number = (name: string, otherwise: number) => Number(query.get(name) ?? otherwise);
const canvas = document.querySelector("canvas")!;
const table = new TreeTable();
const viewport = new Viewport(canvas, table);
const sample = sampleTree({ seed: number("seed", 3), height: number("height", 26), orders: number("orders", 3) });
// With `&grow` it eases in, as growth that was just computed does.
table.apply({ ...sample, catchUp: !query.has("grow") });
viewport.changed();
if (query.has("frame")) viewport.frameTree();
Object.assign(globalThis, { table, viewport });
