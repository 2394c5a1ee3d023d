import type { Field } from "./generated-models";

/** What a number is about. */
export type FieldNumber = (typeof Field)[keyof typeof Field];

/** Gives the numbers of a body, one after the other; mirrors `proto/src/frame/layout.rs`. */
export interface NumberSource {
  number(field: FieldNumber): number;
  byte(field: FieldNumber): number;
  /** What kind of change comes next; null at the end. */
  change(field: FieldNumber): number | null;
}
