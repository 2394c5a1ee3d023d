import type { FrameFence } from "./frame-fence";
import type { QualityControl } from "./quality";

/** What the first frame after a pause counts as, in seconds: the pause itself is no part of any movement. */
const FIRST_STEP = 1 / 60;

/** One frame. */
export interface RenderTime {
  /** When it began, in milliseconds. */
  readonly began: number;
  /** How many seconds the movement in progress goes on with it. */
  readonly step: number;
  /** Whether it was asked for, rather than that the one before it goes on by itself. */
  readonly asked: boolean;
}

/** Draws frames only when needed, as well as the device can while something moves, and as well as can be at rest. */
export class RenderLoop {
  private request = 0;
  private asked = false;
  /** When the movement in progress was last drawn. */
  private lastRender: number | null = null;
  /** When the frame in progress was asked for, and when the one before it began; both tell how long that one took. */
  private requested = 0;
  private began: number | null = null;
  private restTimer = 0;
  private held = false;
  /** Whether the next frame only waits for the picture at rest before it, to learn how long that took. */
  private timing = false;
  private still = false;
  private disposed = false;

  /**
   * `draw` says whether more is to move by itself; `lacking` whether the last frame was less than the one at rest;
   * `tell` hears when the picture comes to rest for good, and when it no longer is; no frame is drawn while the card is
   * behind its `fence`.
   */
  constructor(
    private readonly draw: (time: RenderTime) => boolean,
    private readonly lacking: () => boolean,
    private readonly tell: (still: boolean) => void,
    private readonly fence: FrameFence,
    readonly control: QualityControl,
  ) {}

  /** Has a frame drawn. */
  invalidate(): void {
    this.asked = true;
    this.schedule();
  }

  /**
   * The first picture is about to be drawn. It does not wait for the card, which gets its programs ready with the frames
   * before it: those show nothing yet.
   */
  open(): void {
    this.control.open(performance.now());
    this.fence.forget();
    this.invalidate();
  }

  /** The card has come back, without the frames that it was asked for. */
  restored(): void {
    this.fence.restored();
    this.invalidate();
  }

  /** Has one drawn that is part of a movement. */
  stir(): void {
    this.control.moved(performance.now());
    this.invalidate();
  }

  /** While it is held the picture does not come to rest. */
  hold(held: boolean): void {
    this.held = held;
    this.stir();
  }

  dispose(): void {
    this.disposed = true;
    cancelAnimationFrame(this.request);
    clearTimeout(this.restTimer);
  }

  private schedule(): void {
    if (this.request !== 0 || this.disposed) return;
    this.settle(false);
    this.requested = performance.now();
    this.request = requestAnimationFrame(this.frame);
  }

  private readonly frame = (milliseconds: number): void => {
    const began = performance.now();
    if (this.fence.behind(began)) {
      this.request = requestAnimationFrame(this.frame);
      return;
    }
    const { control } = this;
    this.request = 0;
    if (this.began !== null) control.measured(began - Math.max(this.began, this.requested));
    if (this.timing) {
      this.timing = false;
      if (control.rise()) this.asked = true;
      if (!this.asked) {
        this.began = null;
        this.settle(true);
        return;
      }
    }
    const step = this.lastRender === null ? FIRST_STEP : Math.max(0, (milliseconds - this.lastRender) / 1000);
    this.lastRender = null;
    const { asked } = this;
    this.asked = false;
    const goesOn = this.draw({ began, step, asked });
    this.fence.set(began);
    // The whole picture at rest is followed by a pause, which tells nothing.
    this.began = control.resting && !control.rising ? null : began;
    this.awaitRest();
    this.timing = !goesOn && control.rising && this.request === 0;
    if (!goesOn && !this.timing) {
      this.settle(control.resting && this.request === 0);
      return;
    }
    if (goesOn) this.lastRender = milliseconds;
    this.schedule();
    this.requested = began;
  };

  /** Has the picture at rest drawn once nothing has moved for a while. */
  private awaitRest(): void {
    clearTimeout(this.restTimer);
    const wait = this.control.restIn(performance.now());
    if (wait !== null && !this.held) this.restTimer = window.setTimeout(this.rest, wait);
  }

  private readonly rest = (): void => {
    if (this.held) return;
    if (this.request !== 0 || this.control.restIn(performance.now()) !== 0) {
      this.awaitRest();
      return;
    }
    const lacking = this.lacking();
    this.control.rest();
    this.began = null;
    if (lacking) this.invalidate();
    else this.settle(true);
  };

  private settle(still: boolean): void {
    if (still === this.still) return;
    this.still = still;
    this.tell(still);
  }
}
