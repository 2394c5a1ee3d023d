import { type ReadonlySignal, signal } from "@preact/signals";
import {
  type Command,
  DEFAULT_PARAMETERS,
  type Parameters,
  type ParametersPatch,
  type Programme,
  type Stage,
} from "../../../wire/generated";
import { alike } from "../draft";

/** A programme in force, and the parameters that were set by hand and do not follow it. */
export interface ProgrammeInForce {
  readonly programme: Programme;
  readonly byHand: readonly (keyof Parameters)[];
}

export interface ProgrammeControlOptions {
  readonly submit: (command: Command) => void;
  /** The age of the plants; null before the server has said anything. */
  readonly age: () => number | null;
  /** The tree has come to the age at which it is grown up, while a control that makes it grow was held. */
  readonly grownUp: () => void;
}

/** A stage in which parameters change. */
export type Change = Extract<Stage, { kind: "change" }>;

/** The programme of the session: what it says, and how it is changed (`PG`). */
export class ProgrammeControl {
  readonly inForce: ReadonlySignal<ProgrammeInForce | null>;
  #inForce = signal<ProgrammeInForce | null>(null);
  #options: ProgrammeControlOptions;
  /** The gesture that makes the tree grow, and where its growth ends. */
  #growing: { readonly gesture: number | undefined; readonly until: number | null; notified: boolean } | null = null;

  constructor(options: ProgrammeControlOptions) {
    this.#options = options;
    this.inForce = this.#inForce;
  }

  receive(programme: Programme | null, byHand: readonly string[]): void {
    this.#inForce.value = programme && { programme, byHand: byHand as readonly (keyof Parameters)[] };
  }

  /** Puts a programme in force; what was set by hand follows it unless it is to be kept. */
  set(programme: Programme | null, options: { readonly keep?: boolean; readonly gesture?: number } = {}): void {
    this.#options.submit({ kind: "set_programme", programme, ...options });
  }

  /** Gives parameters back to the programme; all of them where none is named. */
  follow(...parameters: readonly (keyof Parameters)[]): void {
    this.#options.submit({ kind: "follow_programme", parameters: [...parameters] });
  }

  /** The command that sets parameters: what is set to what the programme has follows it. */
  setting(parameters: ParametersPatch): Command {
    const { programme } = this.#inForce.peek() ?? {};
    const names = Object.keys(parameters) as (keyof Parameters)[];
    const own = programme && valuesAt(programme, this.#options.age() ?? 0);
    const follows = own !== undefined && names.length > 0 && names.every((name) => alike(parameters[name], own[name]));
    return follows ? { kind: "follow_programme", parameters: names } : { kind: "set_parameters", parameters };
  }

  /** A command of a control that makes the tree grow: it ends when the tree is grown up, and goes on when held anew. */
  paced(command: Command): Command {
    if (command.kind !== "grow") {
      return command;
    }
    const { programme } = this.#inForce.peek() ?? {};
    const age = this.#options.age();
    if (programme === undefined || age === null) {
      return command;
    }
    if (this.#growing === null || this.#growing.gesture !== command.gesture) {
      const until = age < programme.age ? programme.age : null;
      this.#growing = { gesture: command.gesture, until, notified: false };
    }
    const { until, notified } = this.#growing;
    if (until === null) {
      return command;
    }
    if (age >= until && !notified) {
      this.#growing.notified = true;
      this.#options.grownUp();
    }
    return { ...command, until };
  }
}

/** The parameters of a programme at an age. */
export function valuesAt(programme: Programme, age: number): Parameters {
  const stage = changesOf(programme).findLast((change) => change.age <= age);
  return { ...DEFAULT_PARAMETERS, ...programme.parameters, ...stage?.parameters };
}

/** The parameters that a grown-up tree has by a programme, where those in force at an age differ by hand from it. */
export function grownUp(programme: Programme, age: number, now: Parameters): Parameters {
  const own = new Map<string, unknown>(Object.entries(valuesAt(programme, age)));
  const byHand = Object.entries(now).filter(([name, value]) => !alike(value, own.get(name)));
  return { ...valuesAt(programme, programme.age), ...Object.fromEntries(byHand) };
}

/** The stages in which parameters change, in order. */
export function changesOf({ stages }: Programme): readonly Change[] {
  return stages.filter((stage) => stage.kind === "change");
}

/** A programme with other stages of change; strokes and seeds stay where they are. */
export function withChanges(programme: Programme, changes: readonly Change[]): Programme {
  const others = programme.stages.filter(({ kind }) => kind !== "change");
  // Where ages are the same a change comes first, for what is drawn then is drawn by it.
  return { ...programme, stages: [...changes, ...others].sort((a, b) => a.age - b.age) };
}
