/** How much work goes into one frame. */
export interface Quality {
  /** Pixels drawn along each side, as a share of those the canvas shows. */
  readonly scale: number;
  /** Whether edges are antialiased. */
  readonly smooth: boolean;
  /** Milliseconds between two drawings of a shadow map that keeps changing. */
  readonly shadowEvery: number;
  /** Texels along each side of the shadow map, as a share of those it has at rest. */
  readonly shadows: number;
  /** Whether leaves have all their triangles and shadows soft edges. */
  readonly detailed: boolean;
  /** So many times as long as at rest are leaves, on the screen, that give way to sprigs. */
  readonly merging: number;
  /** Leaves drawn at most, each the larger for it; the same of flowers and of fruits. */
  readonly leaves: number;
  /** The same of sprigs. */
  readonly sprigs: number;
  /** Metamers of thin wood drawn at most. */
  readonly twigs: number;
  /** What such a frame is expected to cost, as a share of one at rest: of two neighbours, at most twice as much (`QUICK`, `SLOW`). */
  readonly cost: number;
}

const ALL = { leaves: Number.POSITIVE_INFINITY, sprigs: Number.POSITIVE_INFINITY, twigs: Number.POSITIVE_INFINITY };
/** What a quick picture has of shadows and leaves. */
const HASTY = { detailed: false, merging: 1.6, shadowEvery: 800, shadows: 0.5, ...ALL, leaves: 40_000 };
const COARSE = { ...HASTY, smooth: false, shadowEvery: 2500, shadows: 0.25 };
const LEAST = { ...COARSE, scale: 0.4, shadowEvery: 8000 };

/**
 * From the picture at rest to the quickest one. Given up in this order: shadows that follow at once, round limbs, soft
 * shadows, leaves; then texels of shadows; then pixels of the picture, edges, and last the rest of pixels, leaves and
 * twigs. What the quickest draws is bounded, however large the tree is.
 */
export const QUALITIES: readonly [Quality, Quality, ...Quality[]] = [
  { scale: 1, smooth: true, shadowEvery: 0, shadows: 1, detailed: true, merging: 1, ...ALL, cost: 1 },
  { ...HASTY, scale: 1, smooth: true, shadows: 1, merging: 1, leaves: 60_000, cost: 0.65 },
  { ...HASTY, scale: 1, smooth: true, cost: 0.5 },
  { ...HASTY, scale: 0.7, smooth: true, cost: 0.35 },
  { ...COARSE, scale: 0.5, cost: 0.18 },
  { ...LEAST, leaves: 20_000, sprigs: 20_000, twigs: 150_000, cost: 0.1 },
  { ...LEAST, leaves: 7_000, sprigs: 7_000, twigs: 50_000, cost: 0.06 },
];

/** Samples of each pixel of a picture that is kept: of thumbnails and downloads. */
export const PICTURE_SAMPLES = 4;
const OPENING_LEVEL = 4;
const COARSEST = QUALITIES.length - 1;
/** What a page opens with, on a device that is known to be slow or another: something is to be seen soon, and the rest of it comes over that. */
export const openingOf = (weak: boolean): Quality => QUALITIES[weak ? COARSEST : OPENING_LEVEL]!;
/** How long nothing moves before the whole quality comes back, in milliseconds. */
export const REST_AFTER = 250;
/** Frames that take longer than this are slow; a display that shows only 30 a second is not. */
const SLOW = 45;
/** A better picture is tried while frames are quicker than this. */
const QUICK = 22;
/** So much slower than this that no third frame is waited for. */
const VERY_SLOW = 120;
/** Quick frames in a row before a better picture is tried. */
const TRUSTED = 45;
const JUDGED = 3;
/** On a slow device the first picture at rest takes about so long, in milliseconds, and a finer one that comes over it so long. */
const SOON = 1200;
const PATIENCE = 4000;

/** Chooses the quality of frames while something moves, from how long they take. */
export class QualityControl {
  private level = 0;
  /** Where the next movement begins: a slow device need not find out again. */
  private first: number;
  private moving = false;
  private lastMoved = Number.NEGATIVE_INFINITY;
  private recent: number[] = [];
  private quickInRow = 0;
  /** Nothing has been learnt from frames in which everything is used for the first time. */
  private opening = false;
  /** Whether the next duration is that of a frame like others. */
  private telling = true;
  /** The best level this movement may use; a failed try is not repeated before the next rest. */
  private best = 0;
  /** The level of the picture at rest: on a slow device one that it draws in time. */
  private shown = 0;
  /** How long a picture at rest of the whole quality should take; null while nothing tells. */
  private whole: number | null = null;
  /** Whether the picture at rest is the whole one however long that takes. */
  thorough = false;

  /** Whether even the quickest frames of a movement were slow. */
  overtaxed = false;

  /** `weak` says that the device is known to be slow. */
  constructor(private readonly weak = false) {
    this.first = weak ? COARSEST : 0;
  }

  /** What the next frame is worth. */
  get quality(): Quality {
    return QUALITIES[this.moving ? this.level : this.shown] ?? QUALITIES[0];
  }

  get resting(): boolean {
    return !this.moving;
  }

  /** The first picture is about to be drawn. */
  open(now: number): void {
    this.moved(now);
    this.level = QUALITIES.indexOf(openingOf(this.weak));
    this.opening = true;
  }

  /** Something moves, grows or is touched. */
  moved(now: number): void {
    this.lastMoved = now;
    if (this.moving) return;
    this.moving = true;
    this.level = this.first;
    this.best = 0;
    this.recent = [];
    this.quickInRow = 0;
  }

  /** Whether a finer picture at rest may come, as soon as it is known how long this one took. */
  get rising(): boolean {
    return !this.moving && this.shown > 0;
  }

  /** The frame that is being drawn has things in it that are used for the first time: how long it takes tells nothing. */
  forget(): void {
    this.telling = false;
  }

  /** A frame of the movement, or one at rest, took this many milliseconds. */
  measured(duration: number): void {
    if (!this.telling) {
      this.telling = true;
      return;
    }
    if (this.rising) this.whole ??= duration / QUALITIES[this.shown]!.cost;
    if (!this.moving || this.opening) return;
    this.recent.push(duration);
    if (this.recent.length > JUDGED) this.recent.shift();
    this.quickInRow = duration <= QUICK ? this.quickInRow + 1 : 0;
    const cost = this.judged();
    this.overtaxed ||= cost > SLOW && this.level === COARSEST;
    if (cost > SLOW && this.level < COARSEST) {
      this.best = Math.max(this.best, this.level + 1);
      this.go(this.quickEnough(cost));
    } else if (this.quickInRow >= TRUSTED && this.level > this.best) {
      this.go(this.level - 1);
    }
  }

  /** Milliseconds until the picture at rest is due; null if it is shown already. */
  restIn(now: number): number | null {
    return this.moving ? Math.max(0, this.lastMoved + REST_AFTER - now) : null;
  }

  /** Nothing moves any more. */
  rest(): void {
    if (!this.moving) return;
    this.moving = false;
    const learnt = !this.opening && this.recent.length > 0;
    this.whole = learnt ? Math.min(...this.recent) / QUALITIES[this.level]!.cost : null;
    this.shown = 0;
    if (this.weak && !this.thorough) this.show(Math.min(this.level, this.finest(SOON)));
    if (this.opening) {
      this.opening = false;
      return;
    }
    // Where frames were quick throughout, the next movement may begin one better.
    this.first = Math.max(0, this.level - (this.quickInRow >= JUDGED ? 1 : 0));
  }

  /** Says whether a finer picture at rest is to be drawn than the one that is shown: one that does not take too long. */
  rise(): boolean {
    const finest = this.finest(PATIENCE);
    if (!this.rising || finest >= this.shown) return false;
    this.show(finest);
    return true;
  }

  private show(level: number): void {
    this.shown = level;
    this.whole = null;
  }

  /** The finest level whose picture at rest should take no longer than this. */
  private finest(milliseconds: number): number {
    const { whole } = this;
    const level = QUALITIES.findIndex(({ cost }) => whole !== null && whole * cost <= milliseconds);
    return level < 0 ? COARSEST : level;
  }

  /** The middle of the last few durations: one frame that stumbles means nothing. */
  private judged(): number {
    const sorted = [...this.recent].sort((a, b) => a - b);
    if (sorted.length === JUDGED) return sorted[1]!;
    return sorted.length === 2 && sorted[0]! > VERY_SLOW ? sorted[0]! : 0;
  }

  /** The first level below that should be quick enough if frames cost what is expected of them. */
  private quickEnough(cost: number): number {
    const share = (level: number) => QUALITIES[level]!.cost / QUALITIES[this.level]!.cost;
    let level = this.level + 1;
    while (level < COARSEST && cost * share(level) > SLOW) level += 1;
    return level;
  }

  private go(level: number): void {
    this.level = level;
    this.recent = [];
    this.quickInRow = 0;
  }
}
