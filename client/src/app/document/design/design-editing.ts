import { computed, signal } from "@preact/signals";
import type { Command, DesignEdit, DesignSetting } from "../../../wire/generated";
import type { Change } from "./branch-handles";
import type { DESIGN_TEMPLATES } from "./design-keys";
import {
  bearerOf,
  type DesignKey,
  DesignModel,
  type KeyGroup,
  type KeyName,
  levelOf,
  orderOf,
  ROOT,
  type Scope,
  type Status,
  wayTo,
} from "./design-model";
import type { DesignSignal } from "./design-signal";
import { isRelation, relativeTo } from "./relative-values";

export type TemplateName = (typeof DESIGN_TEMPLATES)[number];

/** How often a value that moves is sent at most, in milliseconds. */
const SEND_EVERY = 33;
/** So many edits go into one command (`LM21`). */
const MOST_EDITS = 64;
/** How high a tree that falls below its own base stands. */
const STAND = 58;

export interface DesignEditingOptions {
  readonly design: DesignSignal;
  /** Sends a command and gives its number; 0 where no session is open. */
  readonly submit: (command: Command) => number;
  /** A number that no other gesture of this client has, if it is sent at once. */
  readonly newGesture: () => number;
  /** How many edits of designs the server has still to answer. */
  readonly unsettled: () => number;
  readonly now: () => number;
  /** Does something in so many milliseconds. */
  readonly later: (run: () => void, milliseconds: number) => void;
}

/** What a person on this page does to the design in force. */
export class DesignEditing {
  readonly model = computed(() => {
    const told = this.#options.design.inForce.value;
    return told ? new DesignModel(told) : null;
  });
  /** The branch whose values are shown. */
  readonly chosen = signal(ROOT);
  /** Of what values are said: of the chosen branch, or of all of its order. */
  readonly scope = computed<Scope>(() => (this.chosen.value === ROOT ? "branch" : this.#scope.value));
  /** What the shown parameters are about. */
  readonly group = signal<KeyGroup>("all");
  /** The parameter whose way is shown. */
  readonly key = signal<KeyName | null>(null);
  /** Branches that show what they bear. */
  readonly unfolded = signal<ReadonlySet<string>>(new Set([ROOT]));
  /** How many designs somebody has begun on this page. */
  readonly begun = signal(0);
  /** The branch whose values are to be given to another. */
  readonly copied = signal<string | null>(null);

  #options: DesignEditingOptions;
  #scope = signal<Scope>("branch");
  #gesture: number | undefined;
  /** The row of the design in force, or none, as the page asked for that of a tree that stands. */
  #described: number | null | undefined;
  #sentAt = Number.NEGATIVE_INFINITY;
  /** What moved while the server was busy, to be sent once it is not. */
  #waiting: readonly DesignEdit[] | null = null;
  /** What was said before the movement. */
  #before: { readonly path: string; readonly of: string; readonly model: DesignModel } | null = null;

  constructor(options: DesignEditingOptions) {
    this.#options = options;
  }

  /** Begins with a template, or with a plain tree; one that is open gives its place to it. */
  begin(template: TemplateName | null): void {
    this.begun.value += 1;
    const open = this.#options.design.inForce.peek()?.steps_on_top === 0;
    const [command, stand] = [
      { kind: "new_design", ...(template ? { template } : {}) } as const,
      template === "kengai",
    ];
    if (open && !stand) {
      this.#options.submit(command);
    } else {
      if (stand) {
        this.#options.submit(STAND_OF_KENGAI);
      }
      this.#options.submit({ ...command, position: [0, stand ? STAND + 0.5 : 0, 0] });
    }
    this.chosen.value = ROOT;
  }

  /** Begins with a graph from a file. */
  open(graph: unknown): void {
    this.begun.value += 1;
    const open = this.#options.design.inForce.peek()?.steps_on_top === 0;
    this.#options.submit({ kind: "new_design", graph, ...(open ? {} : { position: [0, 0, 0] }) });
    this.chosen.value = ROOT;
  }

  /** Begins with a design of the largest tree as it stands, or of the one of a row; what grew gives its place to it. */
  describe(row?: number): void {
    this.#described = this.#options.design.inForce.peek()?.row ?? null;
    this.#options.submit({ kind: "fit_design", ...(row === undefined ? {} : { row }) });
  }

  /** Whether what was asked for by `describe` stands now; it says so once. */
  isDescribed(): boolean {
    const told = this.#options.design.inForce.value;
    const stands = this.#described !== undefined && told?.overlap !== undefined && told.row !== this.#described;
    if (stands) {
      this.#described = undefined;
    }
    return stands;
  }

  /** Shows the design that `describe` asked for as a tree that begins. */
  showDescribed(): void {
    this.begun.value += 1;
    this.chosen.value = ROOT;
  }

  release(): void {
    this.#options.submit({ kind: "release_design" });
  }

  /** From now on values are said of the chosen branch, or of all of its order. */
  speakOf(scope: Scope): void {
    this.#scope.value = scope;
  }

  /** Branches that say something of a parameter themselves say nothing of it any more. */
  follow(key: KeyName, paths: readonly string[]): void {
    this.#edit(paths.slice(0, MOST_EDITS).map((path) => ({ edit: "clear", of: path, key })));
  }

  choose(path: string): void {
    this.chosen.value = path;
    // The list shows what is chosen.
    this.unfolded.value = new Set([...this.unfolded.peek(), ...wayTo(path).slice(0, -1)]);
  }

  /**
   * The laterals of a branch from base to tip. Of the plant and its limbs all are told; of branches above only while they
   * are on the way to the one that is looked at, and null until they are.
   */
  laterals(path: string): readonly string[] | null {
    const model = this.model.value;
    if (!model || path in model.told.laterals) {
      return model?.laterals(path) ?? null;
    }
    const { of, branches } = this.#options.design.placed.value;
    const isTold = orderOf(path) < 2 || wayTo(of).includes(path);
    return isTold
      ? branches
          .filter((branch) => bearerOf(branch.path) === path)
          .sort((a, b) => a.at - b.at)
          .map((branch) => branch.path)
      : null;
  }

  fold(path: string, open: boolean): void {
    const unfolded = new Set(this.unfolded.peek());
    if (open) {
      unfolded.add(path);
    } else {
      unfolded.delete(path);
    }
    this.unfolded.value = unfolded;
  }

  /** A value while it moves: all of one movement is one deed. */
  drag(key: DesignKey, value: unknown): void {
    this.#move([this.#set(key, value)]);
  }

  /** A value that was dragged is as it was before. */
  undrag(key: DesignKey): void {
    this.unshape({ kind: "value", key: key.name, value: null, isPrivate: false });
  }

  /** A value that was let go, typed or picked. */
  commit(key: DesignKey, value: unknown): void {
    this.#settle([this.#set(key, value)]);
  }

  /** What a hand does to the chosen branch in the picture, while it does it, and once it is done. */
  shape(change: Change): void {
    this.#move(this.#changed(change));
  }

  shaped(change: Change): void {
    this.#settle(this.#changed(change));
  }

  /** Takes back what a hand has done since it took hold: what was said before is said again. */
  unshape(change: Change): void {
    const before = this.#before;
    this.#before = null;
    this.#waiting = null;
    if (this.#gesture === undefined || !before) {
      this.#gesture = undefined;
      return;
    }
    const keys: readonly KeyName[] = change.kind === "value" ? [change.key] : change.keys;
    const { path, of, model } = before;
    const owners = of === path ? [path] : [of, path];
    const edits = keys.flatMap((key) =>
      owners.map((owner): DesignEdit => {
        const setting = model.settingOf(owner, key);
        if (setting?.shared !== undefined) {
          return { edit: "set_shared", share: setting.shared, value: model.graph.shares?.[setting.shared]?.value };
        }
        return setting ? { edit: "set", of: owner, key, value: setting } : { edit: "clear", of: owner, key };
      }),
    );
    if (change.kind === "edits" && change.edits.some(({ edit }) => edit === "anchor")) {
      edits.push({ edit: "anchor", node: path, at: model.anchorOf(path) });
    }
    this.#edit(edits, this.#gesture);
    this.#gesture = undefined;
  }

  /** Says a value in another way; what the branch has by it stays as near as can be. */
  say(key: DesignKey, status: Status): void {
    const [path, model] = [this.chosen.peek(), this.model.peek()];
    if (!model) {
      return;
    }
    const of = this.#of();
    const { value, inherited, isPrivate, setting: former, ...has } = model.resolve(path, key, this.scope.peek());
    if (status === has.status && of === has.origin) {
      return;
    }
    const rest = isPrivate ? { private: true } : {};
    if (status === "inherited") {
      this.#edit([{ edit: "clear", of, key: key.name }]);
    } else if (status === "own") {
      this.#edit([{ edit: "set", of, key: key.name, value: { own: value, ...rest } }]);
    } else if (isRelation(status)) {
      const said = relativeTo(inherited, value, key, status);
      const setting = status === "offset" ? { add: said } : { multiply: said };
      const from = former?.below ? { below: true } : {};
      this.#edit([{ edit: "set", of, key: key.name, value: { ...setting, ...rest, ...from } }]);
    } else {
      this.#share(key, value);
    }
  }

  /** Keeps a value from the branches above, or gives it to them. */
  hide(key: DesignKey, isPrivate: boolean): void {
    const of = this.#of();
    const setting = { ...(this.model.peek()?.settingOf(of, key.name) ?? { inherited: true }) };
    delete setting.private;
    const value: DesignSetting = isPrivate ? { ...setting, private: true } : setting;
    const says = value.inherited !== true || isPrivate;
    this.#edit([says ? { edit: "set", of, key: key.name, value } : { edit: "clear", of, key: key.name }]);
  }

  /** Inherits a value along the axis, from the next branch beneath, or from the bearer again. */
  inheritBelow(key: DesignKey, below: boolean): void {
    const of = this.#of();
    const setting = { ...(this.#said(key.name) ?? { inherited: true }) };
    delete setting.below;
    const value: DesignSetting = below ? { ...setting, below: true } : setting;
    const says = value.inherited !== true || value.private === true || below;
    this.#edit([says ? { edit: "set", of, key: key.name, value } : { edit: "clear", of, key: key.name }]);
  }

  /** Gives a value to the bearer, so that all it bears inherit it. */
  promote(key: DesignKey): void {
    const [path, model] = [this.chosen.peek(), this.model.peek()];
    const bearer = bearerOf(path);
    if (model && bearer !== null) {
      const { value } = model.resolve(path, key);
      this.#edit([
        { edit: "set", of: bearer, key: key.name, value: { own: value } },
        { edit: "clear", of: path, key: key.name },
      ]);
    }
  }

  copy(): void {
    this.copied.value = this.chosen.peek();
  }

  paste(): void {
    const from = this.copied.peek();
    if (from !== null) {
      this.#edit([{ edit: "copy", from, to: this.chosen.peek() }]);
    }
  }

  forget(path: string): void {
    this.#edit([{ edit: "forget", node: path }]);
  }

  wake(path: string): void {
    this.#edit([{ edit: "wake", node: path }]);
  }

  rename(name: string): void {
    this.#edit([{ edit: "name", node: this.chosen.peek(), name: name.trim() || null }]);
  }

  /** A branch shares its value with all that stand on the same axis. */
  #share(key: DesignKey, value: unknown): void {
    const [path, model] = [this.chosen.peek(), this.model.peek()];
    const bearer = bearerOf(path);
    if (!model || bearer === null) {
      return;
    }
    const taken = Object.keys(model.graph.shares ?? {}).map(Number);
    const siblings = model.laterals(bearer);
    this.#edit([
      {
        edit: "share",
        share: Math.max(0, ...taken) + 1,
        key: key.name,
        value,
        members: siblings.includes(path) ? [...siblings] : [path],
      },
    ]);
  }

  /** The edit that makes a value of the chosen branch this: relative values stay relative, shared ones shared. */
  #set(key: DesignKey, value: unknown): DesignEdit {
    const [of, setting] = [this.#of(), this.#said(key.name)];
    const rest = setting?.private ? { private: true } : {};
    const from = setting?.below ? { below: true } : {};
    if (setting?.shared !== undefined) {
      return { edit: "set_shared", share: setting.shared, value };
    }
    if (setting?.add !== undefined) {
      return { edit: "set", of, key: key.name, value: { add: value, ...rest, ...from } };
    }
    if (setting?.multiply !== undefined) {
      return { edit: "set", of, key: key.name, value: { multiply: value, ...rest, ...from } };
    }
    return { edit: "set", of, key: key.name, value: { own: value, ...rest } };
  }

  /** The edit that a hand asks for. A hand says what is to be, so nothing stays relative that it has touched. */
  #changed(change: Change): readonly DesignEdit[] {
    if (change.kind === "edits") {
      return change.edits;
    }
    const [path, of, setting] = [this.chosen.peek(), this.#of(), this.#said(change.key)];
    if (setting?.shared !== undefined) {
      return [{ edit: "set_shared", share: setting.shared, value: change.value }];
    }
    if (of !== path) {
      const edit: DesignEdit = { edit: "set", of, key: change.key, value: { own: change.value } };
      return this.model.peek()?.settingOf(path, change.key)
        ? [edit, { edit: "clear", of: path, key: change.key }]
        : [edit];
    }
    const isPrivate = path !== ROOT && (change.isPrivate || setting?.private === true);
    const value = { own: change.value, ...(isPrivate ? { private: true } : {}) };
    return [{ edit: "set", of, key: change.key, value }];
  }

  /** Of what values are said: the chosen branch, or its level. */
  #of(): string {
    const path = this.chosen.peek();
    return this.scope.peek() === "order" ? levelOf(path) : path;
  }

  /** What is said of a parameter there. */
  #said(key: KeyName): DesignSetting | undefined {
    const [path, model] = [this.chosen.peek(), this.model.peek()];
    return (this.scope.peek() === "order" ? model?.saidOfOrder(path, key) : model?.said(path, key))?.setting;
  }

  /** Sends what moves, as often as the server takes it; the newest waits. */
  #move(edits: readonly DesignEdit[]): void {
    const isEarly = this.#options.now() - this.#sentAt < SEND_EVERY;
    if (isEarly || (this.#gesture !== undefined && this.#options.unsettled() > 0)) {
      const isAlone = this.#waiting === null;
      this.#waiting = edits;
      if (isAlone) {
        this.#options.later(() => this.#waiting && this.#retry(this.#waiting), SEND_EVERY);
      }
      return;
    }
    this.#waiting = null;
    if (this.#gesture === undefined) {
      this.#gesture = this.#options.newGesture();
      const model = this.model.peek();
      this.#before = model && { path: this.chosen.peek(), of: this.#of(), model };
    }
    this.#sentAt = this.#options.now();
    this.#edit(edits, this.#gesture);
  }

  #retry(edits: readonly DesignEdit[]): void {
    this.#waiting = null;
    this.#move(edits);
  }

  #settle(edits: readonly DesignEdit[]): void {
    this.#waiting = null;
    this.#before = null;
    this.#edit(edits, this.#gesture);
    this.#gesture = undefined;
  }

  #edit(edits: readonly DesignEdit[], gesture?: number): void {
    this.#options.submit({
      kind: "edit_design",
      edits: [...edits],
      ...(gesture === undefined ? {} : { gesture }),
    });
  }
}

/** What a tree stands on that falls below its own base. */
const STAND_OF_KENGAI: Command = {
  kind: "place_obstacle",
  obstacle: {
    shape: { kind: "box", size: [12, STAND, 12] },
    pose: { position: [0, STAND / 2, 0], rotation: [0, 0, 0, 1] },
  },
};
