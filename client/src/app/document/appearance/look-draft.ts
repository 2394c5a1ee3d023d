import { computed, type ReadonlySignal } from "@preact/signals";
import { type Appearance, type AppearancePatch, DEFAULT_APPEARANCE } from "../../../wire/generated";
import { Draft, type DraftOptions } from "../draft";

/** Every field of an appearance by itself, as `section.field`. */
type Fields = Record<string, unknown>;

interface LookDraftOptions extends Pick<DraftOptions<Fields, Fields>, "newGesture" | "ahead" | "clock"> {
  /** Sends a change and gives the number of the command; 0 where no session is open. */
  readonly submit: (patch: AppearancePatch, gesture: number | undefined) => number;
}

/** How a tree looks, as a draft: two people who set different fields of one section do not undo each other (`AP1`). */
export class LookDraft {
  readonly value: ReadonlySignal<Appearance>;
  readonly #fields: Draft<Fields>;

  constructor({ submit, ...options }: LookDraftOptions) {
    this.#fields = new Draft<Fields>({
      none: fieldsOf(DEFAULT_APPEARANCE),
      submit: (fields, gesture) => submit(sectionsOf(fields) as AppearancePatch, gesture),
      ...options,
    });
    this.value = computed(() => sectionsOf(this.#fields.value.value) as Appearance);
  }

  /** A control moves. */
  drag(patch: AppearancePatch): void {
    this.#fields.drag(fieldsOf(patch));
  }

  /** A control is let go, or something is picked. */
  commit(patch: AppearancePatch, gesture?: number): void {
    this.#fields.commit(fieldsOf(patch), gesture);
  }

  /** The server has sent the present value. */
  receive(appearance: Appearance): void {
    this.#fields.receive(fieldsOf(appearance));
  }

  /** The server has answered all commands up to this one. */
  settle(settled: number): void {
    this.#fields.settle(settled);
  }

  /** Another session: nothing is known of it. */
  clear(): void {
    this.#fields.clear();
  }

  /** Drops the user's own values. */
  letGo(): void {
    this.#fields.letGo();
  }
}

function fieldsOf(looks: AppearancePatch): Fields {
  const named = Object.entries(looks).flatMap(([part, look]) =>
    Object.entries(look).map(([field, value]) => [`${part}.${field}`, value]),
  );
  return Object.fromEntries(named);
}

function sectionsOf(fields: Fields): Record<string, Fields> {
  const sections: Record<string, Fields> = {};
  for (const [name, value] of Object.entries(fields)) {
    const [part = "", field = ""] = name.split(".");
    sections[part] = { ...sections[part], [field]: value };
  }
  return sections;
}
