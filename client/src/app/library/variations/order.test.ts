import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";
import { FIRST_WISH, LAST_SEED, lastSeed, MOST_TREES, mostFirst, orderOf } from "./order";

const OAK = { template: "oak" };

it("JB1: an order names the seeds, how far to grow, and what to write", () => {
  const options = new Map([
    ["lod", "set"],
    ["hull", "true"],
  ]);
  expect(orderOf(OAK, { ...FIRST_WISH, trees: 50, first: 7 }, "glb", options)).toEqual({
    template: "oak",
    seeds: "7-56",
    format: "glb",
    options: { lod: "set", hull: true },
  });
  expect(orderOf(OAK, { ...FIRST_WISH, until: "steps", steps: 12 }, "png", new Map())).toMatchObject({ steps: 12 });
  expect(orderOf(OAK, { ...FIRST_WISH, until: "metamers", metamers: 900 }, "png", new Map())).toMatchObject({
    metamers: 900,
  });
  expect(lastSeed({ trees: MOST_TREES, first: mostFirst(MOST_TREES) })).toBe(LAST_SEED);
});

it("JB1: bounds and names are those of the server's own description", () => {
  const path = join(import.meta.dirname, "../../../../../proto/openapi.json");
  const { schemas } = JSON.parse(readFileSync(path, "utf8")).components;
  const [text, list] = schemas.GrowTrees.properties.seeds.anyOf;
  expect([list.maxItems, list.items.maximum]).toEqual([MOST_TREES, LAST_SEED]);
  const whole = orderOf(OAK, FIRST_WISH, "glb", new Map());
  expect(whole.seeds).toMatch(new RegExp(text.pattern));
  for (const name of [...Object.keys(whole), "steps", "metamers"]) {
    expect(Object.keys(schemas.GrowTrees.properties), name).toContain(name);
  }
  const told = (name: string) => Object.keys(schemas[name].properties).sort();
  const ofJobs = ["ahead", "all", "done", "failed", "growing", "id", "notes", "problem", "results", "state"];
  expect(told("JobNow")).toEqual(ofJobs);
  expect(told("GrownTree")).toEqual(["address", "bytes", "metamers", "seed"]);
});
