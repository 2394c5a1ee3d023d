import type { Timeline } from "../../../wire/generated";
import { partsOf } from "./authors";

/** What somebody's own Undo and Redo would do next, as far as the line of time tells. */
export interface OwnDeeds {
  /** Whether nobody else has done anything on the line: then the two go back and forth on it (`UD4`). */
  readonly isAlone: boolean;
  /** The operation that they would take back; null if there is none. */
  readonly back: number | null;
  /** The one that they would bring back (`UD3`). */
  readonly forth: number | null;
}

/** The same of the person with this number; null where nobody has said who that is. */
export function ownDeeds({ operations, done }: Pick<Timeline, "operations" | "done">, you: number | null): OwnDeeds {
  const authors = new Set(operations.flatMap(partsOf).map(({ author }) => author));
  const isAlone = [...authors].every((author) => author === (you ?? [...authors][0]));
  if (isAlone) {
    return { isAlone, back: done > 0 ? done - 1 : null, forth: done < operations.length ? done : null };
  }
  /** Their deeds in force by what they took back, and those that they have taken back since they last did anything. */
  const inForce: number[] = [];
  let takenBack: number[] = [];
  let back: number | null = null;
  for (const [at, operation] of operations.slice(0, done).entries()) {
    const own = partsOf(operation).filter(({ author }) => author === you);
    if (own.length === 0) {
      continue;
    }
    if (operation.kind === "taken_back") {
      takenBack.push(...inForce.splice(-1));
    } else if (operation.kind === "brought_back") {
      inForce.push(...takenBack.splice(-1));
    } else {
      inForce.push(...own.map(() => at));
      takenBack = [];
      // What nothing could go of was passed over (`UD7`), so that the line says what is away.
      back = own.every(({ away }) => away) ? back : at;
    }
  }
  return { isAlone, back, forth: takenBack.at(-1) ?? null };
}
