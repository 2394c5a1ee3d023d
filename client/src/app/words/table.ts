import { FIRST } from "./first";
import { LATER } from "./later";

/** Every text a person reads: English, German. One file an area; a key begins with its area. */
export const TABLE = { ...FIRST, ...LATER } as const;
