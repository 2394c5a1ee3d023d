import { batch, effect, signal } from "@preact/signals";
import { TreeTable } from "../scene/tree-table";
import { Viewport } from "../scene/viewport";
import { decodeFrame, type Frame } from "../wire/frame";
import type { Command, DocumentState, Parameters, Problem } from "../wire/generated";
import { stepRadius } from "./brush-radius";
import { BrushTool, SEND_EVERY } from "./brush-tool";
import { leaveRecord, newClientKey, takeRecord } from "./client-record";
import { browserClock, Connection } from "./connection";
import type { Phase, StopReason } from "./connection-core";
import type { Gesture } from "./gestures";
import { deflectionFor, GrowPacer, growthRate, KEY_RATE } from "./grow-pacer";
import { listenToKeys } from "./keyboard";
import { createSession, sessionExists, socketAddress } from "./library-api";
import { pace } from "./pacing";
import { listenToPointers } from "./pointer-source";
import type { BrushView } from "./ports";
import { mayReload } from "./reload-guard";
import { nearestBase, rowStore } from "./scene-link";
import { type ScreenPlace, screenPlace } from "./screen-place";
import { loadSettings } from "./settings";
import { Toasts } from "./toasts";

export type SheetName = "save" | "library" | "share" | "help";

/** What keeps the workspace from being used, with a way on. */
export type Obstacle = "unknown-session" | "version" | "no-server" | "no-webgl";

/** How long the brush stays visible after its radius changed. */
const RADIUS_SHOWN_FOR = 900;
const RETRY_START = 2000;

/** One open page: the session it shows and the tools at hand. */
export class Studio {
  readonly settings = loadSettings(localStorage);
  readonly toasts = new Toasts();
  readonly session = signal<string | null>(null);
  readonly phase = signal<Phase>("idle");
  readonly attempts = signal(0);
  readonly obstacle = signal<Obstacle | null>(null);
  readonly document = signal<DocumentState | null>(null);
  readonly parameters = signal<Parameters | null>(null);
  readonly rows = signal(0);
  readonly sent = signal(0);
  readonly settled = signal(0);
  readonly sheet = signal<SheetName | null>(null);
  readonly drawing = signal(false);
  /** Deflection of the grow control, −1 to 1. */
  readonly growing = signal(0);

  #table = new TreeTable();
  #canvas: HTMLCanvasElement | null = null;
  #viewport: Viewport | null = null;
  #brush: BrushTool | null = null;
  #connection: Connection<Frame> | null = null;
  #pacer = new GrowPacer();
  #growLoop = 0;
  #stopSending = () => {};
  #radiusTimer = 0;
  #hoverFrame = 0;
  #framed = false;
  /** The view is no longer that of a fresh page. */
  #moved = false;

  /** Takes the canvas into use; returns what gives it back. */
  attach(canvas: HTMLCanvasElement): () => void {
    let viewport: Viewport;
    try {
      viewport = new Viewport(canvas, this.#table);
    } catch (error) {
      console.error(error);
      this.obstacle.value = "no-webgl";
      return () => {};
    }
    this.#canvas = canvas;
    this.#viewport = viewport;
    const view: BrushView = viewport;
    this.#brush = new BrushTool({
      view,
      submit: (command) => this.#submit(command),
      newStroke: () => this.#connection?.next ?? 1,
      // What is durable may still have to grow: a heavy tree must not fall behind the finger.
      unsettledMoves: () =>
        Math.max(this.#connection?.unsettled("stroke_move") ?? 0, this.document.peek()?.pending_steps ?? 0),
      radius: () => this.settings.radius.peek(),
      pressureWidens: () => this.settings.pressureWidens.peek(),
      base: (x, y) => nearestBase(this.#table, view, x, y),
    });
    const keys = listenToKeys({
      undo: () => this.undo(),
      redo: () => this.redo(),
      frame: () => this.frameTree(),
      help: () => {
        this.sheet.value = "help";
      },
      widen: (notches) => this.setRadius(stepRadius(this.settings.radius.peek(), notches)),
      grow: (direction) => (direction === 0 ? this.growRelease() : this.growTo(direction * deflectionFor(KEY_RATE))),
      busy: () => this.sheet.peek() !== null,
    });
    const stopPointers = listenToPointers(canvas, {
      gesture: (gesture) => this.#gesture(gesture),
      hover: (place) => this.#hover(place),
      widen: (factor) => this.setRadius(stepRadius(this.settings.radius.peek(), Math.log(factor) * 8)),
      handHeld: keys.handHeld,
    });
    const stopPublishing = effect(() => this.#publish());
    const stopLife = this.#followPageLife();
    return () => {
      stopLife();
      stopPublishing();
      stopPointers();
      keys.stop();
      this.#leave();
      viewport.dispose();
      this.#viewport = null;
      this.#brush = null;
    };
  }

  /** Opens what the address names, or the session of last time, or a new one. */
  async start(): Promise<void> {
    const named = sessionInPath(location.pathname);
    if (named !== null) {
      this.#open(named);
      return;
    }
    try {
      const last = this.settings.lastSession.peek();
      const session = last !== null && (await sessionExists(last)) ? last : await createSession();
      history.replaceState(null, "", `/s/${session}`);
      this.#open(session);
    } catch {
      this.obstacle.value = "no-server";
      setTimeout(() => {
        if (this.session.peek() === null) {
          void this.start();
        }
      }, RETRY_START);
    }
  }

  /** Leaves this session for a new one, empty or from a saved tree. */
  async newSession(tree?: string): Promise<void> {
    try {
      const session = await createSession(tree === undefined ? {} : { tree });
      history.pushState(null, "", `/s/${session}`);
      this.#open(session);
      this.sheet.value = null;
    } catch (error) {
      this.toasts.show(sentence(error));
    }
  }

  undo(): void {
    this.#submit({ kind: "undo" });
  }

  redo(): void {
    this.#submit({ kind: "redo" });
  }

  frameTree(): void {
    this.#viewport?.frameTree();
  }

  /** Sets the brush's radius and shows it for a moment where it would draw. */
  setRadius(radius: number): void {
    this.settings.radius.value = radius;
    const canvas = this.#canvas;
    if (!this.#viewport || !canvas || this.drawing.peek()) {
      return;
    }
    const { clientWidth: width, clientHeight: height } = canvas;
    const base = nearestBase(this.#table, this.#viewport, width / 2, height / 2);
    const place = this.#viewport.pointOnPlane(width / 2, height / 2, base);
    if (place) {
      this.#viewport.showBrush(place, radius);
      clearTimeout(this.#radiusTimer);
      this.#radiusTimer = window.setTimeout(() => {
        if (!this.drawing.peek()) {
          this.#viewport?.hideBrush();
        }
      }, RADIUS_SHOWN_FOR);
    }
  }

  /** The grow control is at a deflection from −1 to 1. */
  growTo(deflection: number): void {
    const held = this.#growLoop !== 0;
    this.growing.value = deflection;
    if (!held) {
      this.#pacer.press(this.#connection?.next ?? 1);
      this.#growLoop = requestAnimationFrame(this.#grow);
      this.#viewport?.hold(true);
    }
  }

  growRelease(): void {
    if (this.#growLoop !== 0) {
      this.#viewport?.hold(false);
    }
    cancelAnimationFrame(this.#growLoop);
    this.#growLoop = 0;
    this.growing.value = 0;
  }

  /** Where on the canvas the plant nearest to its middle has its base. */
  seedPlace(): ScreenPlace | null {
    const viewport = this.#viewport;
    const canvas = this.#canvas;
    if (!viewport || !canvas) {
      return null;
    }
    const { clientWidth: width, clientHeight: height } = canvas;
    return screenPlace(viewport, nearestBase(this.#table, viewport, width / 2, height / 2), width, height);
  }

  /** A picture of the tree as a data URL, or undefined where none can be made. */
  async thumbnail(size: number): Promise<string | undefined> {
    return await this.#viewport?.thumbnail(size, size);
  }

  #grow = (now: number) => {
    this.#growLoop = requestAnimationFrame(this.#grow);
    const connection = this.#connection;
    if (!connection || this.phase.peek() !== "connected") {
      return;
    }
    const command = this.#pacer.tick(now, this.growing.peek(), {
      unsettled: connection.unsettled("grow") + connection.unsettled("ungrow"),
      pendingSteps: growthRate(this.growing.peek()) > 0 ? (this.document.peek()?.pending_steps ?? 0) : 0,
    });
    if (command) {
      this.#submit(command);
    }
  };

  #submit(command: Command): void {
    this.#connection?.submit(command);
  }

  #gesture(gesture: Gesture): void {
    const viewport = this.#viewport;
    switch (gesture.kind) {
      case "stroke-begin":
        if (this.#connection && this.obstacle.peek() === null) {
          clearTimeout(this.#radiusTimer);
          this.#brush?.begin(gesture.point);
          this.drawing.value = true;
          this.#stopSending();
          this.#stopSending = pace(SEND_EVERY, () => this.#brush?.tick());
          viewport?.hold(true);
        }
        break;
      case "stroke-move":
        this.#brush?.move(gesture.points);
        break;
      case "stroke-end":
        this.#endStroke();
        break;
      case "pan":
        viewport?.pan(gesture.dx, gesture.dy);
        break;
      case "orbit":
        viewport?.orbit(gesture.dx, gesture.dy);
        break;
      case "zoom":
        viewport?.zoom(gesture.factor, gesture.x, gesture.y);
        break;
    }
  }

  #endStroke(): void {
    this.#stopSending();
    if (this.drawing.peek()) {
      this.#viewport?.hold(false);
      this.#brush?.end();
      this.drawing.value = false;
      this.settings.hasDrawn.value = true;
    }
  }

  #abandonStroke(): void {
    this.#stopSending();
    this.#viewport?.hold(false);
    this.#brush?.abandon();
    this.drawing.value = false;
  }

  #hover(place: { readonly x: number; readonly y: number } | null): void {
    cancelAnimationFrame(this.#hoverFrame);
    if (this.drawing.peek()) {
      return;
    }
    // Picking looks at the whole tree, so it is done once a frame and not once an event.
    this.#hoverFrame = requestAnimationFrame(() => {
      if (place && !this.drawing.peek()) {
        this.#brush?.hover(place.x, place.y);
      } else if (!place) {
        this.#viewport?.hideBrush();
      }
    });
  }

  #open(session: string): void {
    this.#leave();
    batch(() => {
      this.session.value = session;
      this.settings.lastSession.value = session;
      // Another session does not make a browser draw that cannot.
      this.obstacle.value = this.#viewport ? null : "no-webgl";
      this.document.value = null;
      this.rows.value = 0;
    });
    this.#moved ||= this.#framed;
    this.#framed = false;
    this.#table.clear();
    this.#viewport?.changed();
    const record = takeRecord(sessionStorage, session);
    this.#connection = new Connection<Frame>({
      openSocket: () => new WebSocket(socketAddress(session, location)),
      clock: browserClock,
      rows: rowStore(this.#table),
      decode: decodeFrame,
      newKey: newClientKey,
      ...(record ? { record } : {}),
      events: {
        phase: (phase, attempts, stopped) => this.#onPhase(phase, attempts, stopped),
        commands: (sent, settled) => {
          batch(() => {
            this.sent.value = sent;
            this.settled.value = settled;
          });
        },
        state: (state) => {
          this.document.value = state;
        },
        parameters: (parameters) => {
          this.parameters.value = parameters;
          this.#viewport?.setLeafSize(parameters.leaf_size);
        },
        problem: (problem) => this.#onProblem(problem),
        rows: () => this.#onRows(),
        rekeyed: () => this.#abandonStroke(),
        reload: () => {
          if (mayReload(sessionStorage, Date.now())) {
            location.reload();
          }
        },
      },
    });
  }

  #onPhase(phase: Phase, attempts: number, stopped: StopReason | null): void {
    batch(() => {
      this.phase.value = phase;
      this.attempts.value = attempts;
      if (stopped !== null) {
        this.obstacle.value = stopped;
      }
    });
    if (stopped === "unknown-session" && this.settings.lastSession.peek() === this.session.peek()) {
      this.settings.lastSession.value = null;
    }
  }

  #onProblem(problem: Problem): void {
    if (problem.code === "not_found" && problem.field === "stroke") {
      // Someone went back in time, which ends every stroke; what was still under way of this one is refused.
      if (this.drawing.peek()) {
        this.toasts.show("The tree went back in time; your stroke ended there.");
      }
      this.#abandonStroke();
      return;
    }
    this.toasts.show(problem.message);
    console.warn("The server refused:", problem);
  }

  #onRows(): void {
    this.rows.value = this.#table.rows;
    this.#viewport?.changed();
    if (!this.#framed && this.#table.rows > 0) {
      this.#framed = true;
      // A page opens with a view that suits a seed; a tree that is there already is shown as a whole.
      if (this.#moved || this.#table.parent.subarray(0, this.#table.rows).some((parent) => parent >= 0)) {
        this.#viewport?.frameTree();
      }
    }
  }

  #leave(): void {
    this.#endStroke();
    this.growRelease();
    this.#connection?.close();
    this.#connection = null;
  }

  /** Ends strokes and keeps what is unsent when the page goes, wakes the connection when it comes back. */
  #followPageLife(): () => void {
    const stop = new AbortController();
    const options = { signal: stop.signal };
    const leaving = () => {
      this.#endStroke();
      this.growRelease();
      const session = this.session.peek();
      if (session !== null && this.#connection) {
        leaveRecord(sessionStorage, session, this.#connection.record());
      }
    };
    const returning = () => {
      // This page still lives and has all of it; the copy was for a page after it.
      takeRecord(sessionStorage, this.session.peek() ?? "");
      this.#connection?.wake();
    };
    addEventListener("pagehide", leaving, options);
    addEventListener("pageshow", returning, options);
    addEventListener("online", () => this.#connection?.wake(), options);
    document.addEventListener("visibilitychange", () => (document.hidden ? leaving : returning)(), options);
    addEventListener(
      "popstate",
      () => {
        const session = sessionInPath(location.pathname);
        if (session !== null && session !== this.session.peek()) {
          this.#open(session);
        }
      },
      options,
    );
    return () => stop.abort();
  }

  /** What automated tests and assistive scripts can read of the page. */
  #publish(): void {
    const { dataset } = document.documentElement;
    dataset.connection = this.phase.value;
    dataset.sent = String(this.sent.value);
    dataset.acknowledged = String(this.settled.value);
    dataset.rows = String(this.rows.value);
    dataset.metamers = String(this.document.value?.metamers ?? 0);
    dataset.step = String(this.document.value?.step ?? 0);
    dataset.pending = String(this.document.value?.pending_steps ?? 0);
  }
}

/** What to tell a person about an error. */
export function sentence(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

function sessionInPath(path: string): string | null {
  const name = /^\/s\/([^/]+)\/?$/.exec(path)?.[1];
  try {
    return name === undefined ? null : decodeURIComponent(name);
  } catch {
    return null;
  }
}
