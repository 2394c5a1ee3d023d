import type { SavedTree } from "../src/wire/generated";

/** A tree as a library lists it. */
export function savedTree(fields: Partial<SavedTree> = {}): SavedTree {
  const at = "2026-01-01T00:00:00Z";
  return {
    id: "t1",
    name: "Oak",
    note: "",
    version: 1,
    metamers: 5,
    saved_at: at,
    created_at: at,
    template: false,
    tags: [],
    favourite: false,
    people: 0,
    revision: 1,
    thumbnail: "/api/v1/trees/t1/versions/1/thumbnail",
    ...fields,
  };
}
