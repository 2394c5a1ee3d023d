import { computed, signal } from "@preact/signals";
import { DRAW_MODES } from "../../scene/mode/draw-mode";
import type { Vec3 } from "../../scene/vector";
import type { Bookmark, Comment, NewComment, NewMention, PinPlace, Thread } from "../../wire/generated";
import { findSession } from "../connection/session-api";
import { browserClock } from "../page/clock";
import { OFFERED_FOR } from "../page/toasts";
import { explained } from "../problems/explained";
import { RequestFailed } from "../requests/request";
import type { Studio } from "../studio";
import { place, seen, told } from "../together/cameras";
import { pointerAt } from "../together/own-pointer";
import { onWood } from "../together/wood-place";
import { say } from "../words/say";
import * as api from "./comment-api";
import { type Deletion, Deletions, without } from "./deletions";
import { callsForMe, isForMe, newCalls, unreadIn } from "./filters";
import { type Line, picture } from "./view-picture";

/** So much of a comment is quoted, in characters. */
const QUOTED = 40;

/** A comment that is being written. */
export interface Draft {
  /** The thread that it answers in; null for a new one. */
  readonly thread: number | null;
  /** Where a new one is pinned; null for the tree as a whole. */
  readonly pin: PinPlace | null;
}

/** Comments that were not seen. */
export interface News {
  readonly count: number;
  /** Whether one of them is for whoever looks. */
  readonly isForMe: boolean;
  readonly text: string;
}

/** All that is said of the tree on the page, and what is being said. */
export class Conversation {
  /** The saved tree; null where the page shows none. */
  readonly tree = signal<string | null>(null);
  /** By their numbers, newest first; null until they were read. */
  readonly threads = computed(() => {
    const told = this.#told.value;
    return told && without(told, this.tree.value, this.#deletions.all.value);
  });
  readonly draft = signal<Draft | null>(null);
  /** Whether the next touch of the picture says where a thread is pinned. */
  readonly placing = signal(false);
  /** Whether a finger draws over the view; it stands still meanwhile. */
  readonly sketching = signal(false);
  /** What was drawn over it. */
  readonly lines = signal<readonly Line[]>([]);
  readonly sending = signal(false);
  /** What this person is called here: by themselves, and by whoever invited them. */
  readonly self = computed<readonly string[]>(() => {
    const { settings, together } = this.#studio;
    const here = together.people.value;
    const own = here?.people.find(({ devices }) => devices.some(({ device }) => device === here.you));
    return [settings.author.value.trim(), own?.name ?? ""].filter((name) => name !== "");
  });
  /** What was not seen, in words; null where all was. */
  readonly news = computed<News | null>(() => {
    const threads = [...(this.threads.value?.values() ?? [])];
    const count = threads.reduce((sum, thread) => sum + unreadIn(thread).length, 0);
    const isForMe = threads.some(callsForMe);
    const text = say(isForMe ? "comments.unread.me" : "comments.unread", { count });
    return count === 0 ? null : { count, isForMe, text };
  });
  /** The same as the server has them. */
  #told = signal<ReadonlyMap<number, Thread> | null>(null);
  #deletions = new Deletions({
    within: OFFERED_FOR,
    clock: browserClock,
    send: (deletion) => this.#delete(deletion),
  });
  #studio: Studio;
  #session: string | null = null;

  constructor(studio: Studio) {
    this.#studio = studio;
  }

  /** Reads everything, where the page shows a saved tree. */
  async load(): Promise<void> {
    const session = this.#studio.link.session.peek();
    this.#session = session;
    await this.#try(async () => {
      const found = session === null ? null : await findSession(session);
      if (this.#session !== session) {
        return;
      }
      this.tree.value = found?.tree?.id ?? null;
      this.#studio.comments.stale.value = new Set();
      const all = found?.tree ? await api.listThreads(found.tree.id) : [];
      if (this.#session === session) {
        this.#told.value = new Map(all.map((thread) => [thread.thread, thread]));
      }
    });
  }

  /** Reads what has changed. */
  async refresh(): Promise<void> {
    const { stale } = this.#studio.comments;
    const [tree, changed] = [this.tree.peek(), stale.peek()];
    if (tree === null || this.threads.peek() === null) {
      return this.load();
    }
    stale.value = new Set();
    for (const number of changed) {
      try {
        const before = this.threads.peek()?.get(number);
        const thread = await api.findThread(tree, number);
        this.#take(thread);
        this.#tell(before, thread);
      } catch (error) {
        if (!isMissing(error)) {
          return this.#failed(error);
        }
        this.#drop(number);
      }
    }
  }

  /** The thread is shown, and with that seen. */
  show(thread: Thread): void {
    const { comments, layout } = this.#studio;
    comments.open.value = thread.thread;
    layout.panel.value = "comments";
    this.see(thread);
  }

  see(thread: Thread): void {
    const [tree, newest] = [this.tree.peek(), thread.comments.at(-1)?.comment ?? 0];
    if (tree !== null && newest > thread.seen) {
      for (const { author } of unreadIn(thread).filter(isForMe)) {
        this.#studio.toasts.withdraw(calls(author));
      }
      this.#take({ ...(this.#told.peek()?.get(thread.thread) ?? thread), seen: newest });
      void this.#try(() => api.seeThread(tree, thread.thread, newest));
    }
  }

  /** Begins to write: in a thread, or a new one. */
  write(draft: Draft): void {
    this.lines.value = [];
    this.sketching.value = false;
    this.placing.value = false;
    this.draft.value = draft;
    this.#studio.layout.panel.value = "comments";
  }

  /** Writes nothing after all. */
  giveUp(): void {
    this.draft.value = null;
    this.placing.value = false;
    this.sketching.value = false;
    this.lines.value = [];
  }

  /** Where a thread would be pinned at a place of the canvas; null where there is no wood. */
  pinAt(x: number, y: number): PinPlace | null {
    const { stage, table } = this.#studio;
    const wood = this.#wood();
    const pointer = stage.view ? pointerAt(x, y, stage.view, table, wood) : null;
    if (pointer?.kind !== "wood") {
      return null;
    }
    const [end, begin] = [wood.placeOf(pointer.row), wood.placeOf(wood.parentOf(pointer.row))];
    if (!end || !begin) {
      return null;
    }
    const { row, along, offset } = pointer;
    return { row, along, offset, place: place(onWood({ along, offset }, begin, end)) };
  }

  /** Says it; true once the server has it. */
  async send(text: string, mentions: readonly NewMention[], showsView: boolean): Promise<boolean> {
    const [draft, tree] = [this.draft.peek(), this.tree.peek()];
    if (draft === null || tree === null || this.sending.peek()) {
      return false;
    }
    this.sending.value = true;
    const sent = await this.#try(async () => {
      const comment = await this.#comment(text, mentions, showsView);
      const session = this.#session ?? "";
      const pin = draft.pin === null ? {} : { pin: { session, at: draft.pin } };
      const thread = await (draft.thread === null
        ? api.beginThread(tree, { ...pin, comment })
        : api.answerIn(tree, draft.thread, comment));
      this.#take(thread);
      this.#studio.comments.open.value = thread.thread;
    });
    this.sending.value = false;
    if (sent) {
      this.giveUp();
    }
    return sent;
  }

  async resolve(thread: Thread): Promise<void> {
    const tree = this.tree.peek();
    if (tree !== null) {
      await this.#try(async () =>
        this.#take(await api.resolveThread(tree, thread.thread, thread.resolved === undefined)),
      );
    }
  }

  /** Changes one's own words; true once the server has them. */
  async edit(thread: Thread, comment: number, text: string): Promise<boolean> {
    const tree = this.tree.peek();
    return (
      tree !== null && this.#try(async () => this.#take(await api.editComment(tree, thread.thread, comment, text)))
    );
  }

  /** Takes a comment away; one's own can be brought back for a while. */
  async delete({ thread }: Thread, { comment, own, text }: Comment): Promise<void> {
    const tree = this.tree.peek();
    if (tree === null) {
      return;
    }
    const deletion = { tree, thread, comment, said: deleted(text) };
    if (!this.#deletions.begin(deletion)) {
      return;
    }
    if (own) {
      this.#studio.toasts.show(deletion.said, {
        label: say("comments.undo"),
        act: () => this.#deletions.takeBack(deletion),
      });
    } else {
      await this.#deletions.settle(deletion);
    }
  }

  /** The page or the session is left, from which nothing can be brought back any more. */
  leaving(): void {
    for (const { said } of this.#deletions.all.peek()) {
      this.#studio.toasts.withdraw(said);
    }
    this.#deletions.settleAll();
  }

  /** Shows what somebody saw, as far as this page alone is concerned: their camera and draw mode. */
  visit({ camera, mode }: Bookmark): void {
    const { stage, drawMode } = this.#studio;
    stage.view?.camera.visit(seen(camera));
    const known = DRAW_MODES.find((one) => one === mode);
    if (known) {
      drawMode.value = known;
    }
  }

  /** Shows the step that somebody saw as well, in a copy of the session, so that nobody else is moved. */
  lookBack({ thread }: Thread, bookmark: Bookmark): void {
    const { link, comments, time } = this.#studio;
    const session = link.session.peek();
    const look = { thread, step: bookmark.step, show: () => this.visit(bookmark) };
    if (link.replaying.peek()) {
      time.to(look.step);
      look.show();
    } else if (session !== null) {
      comments.lookBack = { session, ...look };
      link.replay(true);
      // What is open is forgotten with the session that is left.
      comments.open.value = thread;
    }
  }

  /** Where a thread is drawn: its place, whether that is on the wood it was about, and the wood that is left below. */
  whereIs(thread: Thread): { readonly at: Vec3; readonly stands: boolean; readonly below: Vec3 | null } | null {
    const at = thread.at;
    if (!at) {
      return null;
    }
    const pin = this.#studio.comments.pins.peek().get(thread.thread);
    const row = pin?.row;
    const wood = this.#wood((row) => this.#studio.stage.seenAt(row));
    const stands = pin?.state === "standing" || pin?.state === "regrown";
    const end = row === undefined ? null : wood.placeOf(row);
    const begin = row === undefined ? null : wood.placeOf(wood.parentOf(row));
    if (stands && end && begin) {
      return { at: onWood({ along: at.along, offset: at.offset }, begin, end), stands, below: null };
    }
    return { at: at.place, stands: false, below: end };
  }

  clear(): void {
    this.#session = null;
    this.tree.value = null;
    this.#told.value = null;
    this.giveUp();
  }

  async #comment(text: string, mentions: readonly NewMention[], showsView: boolean): Promise<NewComment> {
    const { settings } = this.#studio;
    const author = settings.author.peek().trim();
    const bookmark = showsView ? this.#bookmark() : null;
    const lines = this.lines.peek();
    const seen = showsView ? await picture(this.#studio.stage, lines) : null;
    return {
      text,
      ...(author === "" ? {} : { author }),
      ...(mentions.length === 0 ? {} : { mentions: [...mentions] }),
      ...(this.#session !== null && mentions.some(({ person }) => person !== undefined)
        ? { session: this.#session }
        : {}),
      ...(bookmark ? { bookmark } : {}),
      ...(bookmark && lines.length > 0 ? { sketch: lines.map((line) => line.map(([x, y]) => [x, y])) } : {}),
      ...(seen ? { picture: seen } : {}),
    };
  }

  #bookmark(): Bookmark | null {
    const { stage, time, drawMode } = this.#studio;
    const view = stage.view?.camera.rig.view;
    const line = time.timeline.peek();
    return view ? { camera: told(view), step: line?.step ?? 0, line: line?.line ?? 0, mode: drawMode.peek() } : null;
  }

  #wood(placeOf = (row: number) => this.#studio.stage.placeOf(row)) {
    const { table } = this.#studio;
    return {
      placeOf: (row: number) => (row < 0 ? null : placeOf(row)),
      parentOf: (row: number) => table.parent[row] ?? -1,
    };
  }

  #take(thread: Thread): void {
    const others = [...(this.#told.peek() ?? [])].filter(([number]) => number !== thread.thread);
    const all = [...others, [thread.thread, thread] as const];
    this.#told.value = new Map(all.sort(([a], [b]) => b - a));
  }

  /** Whoever is named in what was just said is told so, unless they read it already. */
  #tell(before: Thread | undefined, thread: Thread): void {
    const { comments, layout, toasts } = this.#studio;
    const isRead = layout.panel.peek() === "comments" && comments.open.peek() === thread.thread;
    const call = newCalls(before, thread).at(-1);
    if (call && !isRead) {
      toasts.show(calls(call.author), {
        label: say("comments.read"),
        act: () => this.show(this.threads.peek()?.get(thread.thread) ?? thread),
      });
    }
  }

  async #delete({ tree, thread, comment }: Deletion): Promise<void> {
    try {
      await api.deleteComment(tree, thread, comment);
    } catch (error) {
      if (!isMissing(error)) {
        this.#studio.toasts.show(await explained(error));
        return;
      }
    }
    const told = this.tree.peek() === tree && this.#told.peek()?.get(thread);
    if (!told) {
      return;
    }
    const comments = told.comments.filter((one) => one.comment !== comment);
    if (comments.length > 0) {
      this.#take({ ...told, comments });
    } else {
      this.#drop(thread);
    }
  }

  #drop(number: number): void {
    const { open } = this.#studio.comments;
    this.#told.value = new Map([...(this.#told.peek() ?? [])].filter(([other]) => other !== number));
    if (open.peek() === number) {
      open.value = null;
    }
  }

  /** Whether it was done; what went wrong is said. */
  async #try(act: () => Promise<void>): Promise<boolean> {
    try {
      await act();
      return true;
    } catch (error) {
      await this.#failed(error);
      return false;
    }
  }

  async #failed(error: unknown): Promise<void> {
    const { layout, toasts, comments } = this.#studio;
    // Whoever has asked for nothing is not told that it could not be had; opening the panel asks again.
    if (layout.panel.peek() !== "comments" && comments.pins.peek().size === 0) {
      return;
    }
    toasts.show(await explained(error));
  }
}

/** Whether the server no longer has what was asked for. */
function isMissing(error: unknown): boolean {
  return error instanceof RequestFailed && error.status === 404;
}

/** What is said of a comment that can be brought back. */
function deleted(text: string): string {
  return say("comments.deleted", { text: text.length > QUOTED ? `${text.slice(0, QUOTED - 1).trimEnd()}…` : text });
}

/** What whoever somebody has named is told. */
function calls(name: string): string {
  return say("comments.calls", { name });
}
