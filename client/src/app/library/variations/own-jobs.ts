import { newClientKey } from "../../connection/client-record";
import { browserClock } from "../../page/clock";
import { kept } from "../../page/settings";
import * as api from "./job-api";
import { Jobs, type Ordered } from "./jobs";

let own: Jobs | null = null;

/** The jobs of whoever is at this page; what was ordered is found again after a reload. */
export function ownJobs(): Jobs {
  own ??= new Jobs({
    api,
    ordered: kept<readonly Ordered[]>(localStorage, "variations", [], areOrdered),
    clock: browserClock,
    newKey: newClientKey,
  });
  return own;
}

function areOrdered(value: unknown): boolean {
  return Array.isArray(value) && value.every(isOrdered);
}

function isOrdered(value: unknown): boolean {
  const order = value as Partial<Ordered> | null;
  return (
    typeof order === "object" &&
    order !== null &&
    [order.id, order.name, order.ending].every((text) => typeof text === "string")
  );
}
