import { type AirSettings, blows } from "./air-settings";
import type { Answers } from "./answers";
import { FADE, fadedIn, followedBy, leftAt, Sway } from "./sway";

/** Winds set in at whole multiples of so many seconds of the time that all share; of several that are set between, the last does. */
export const BEAT = 0.25;
/** Seconds by which a wind may be told to be ahead of the time: clocks are never alike. */
const AHEAD = 1;
/** Winds that are still to come at most: what a page has missed that was hidden has blown by. */
const MOST = 2;

/** What was set since the last frame is remembered up to so many. */
const MOST_SET = 8;
/** What was set so many seconds ago and is heard of only now comes as a surprise: it is not shown as if it had come in time. */
export const LATE = 0.4;

interface Onset {
  readonly settings: AirSettings;
  /** When it sets in, in seconds of the time that all share. */
  since: number;
}

/** How much of what is seen is that of a wind, from 0 to 1; those of all winds together are 1. */
export interface WindShare {
  readonly settings: AirSettings;
  readonly share: number;
}

/** Which wind sets in when: the same on all pages, however late they hear of it. */
export class Winds {
  /** What blows, last, and before it what still fades. */
  private blown: readonly Onset[] = [];
  private coming: Onset[] = [];
  private news: { readonly settings: AirSettings; readonly told: number | null }[] = [];
  private sheltered = false;

  /** Whether some are still to come. */
  get waiting(): boolean {
    return this.coming.length > 0;
  }

  /** How many seconds ago it was at a time that the wind was set that is new since the last frame; 0 where that is not known. */
  lateness(time: number): number {
    const late = time - (this.news.at(-1)?.told ?? time);
    return late > 0 && late < LATE ? late : 0;
  }

  /** A wind was set; `told` is when, as the server says, or null where that has yet to be heard. */
  set(settings: AirSettings, told: number | null): void {
    this.news = [...this.news, { settings, told }].slice(-MOST_SET);
  }

  /** This wind has always blown. */
  begin(settings: AirSettings): void {
    this.blown = [{ settings, since: Number.NEGATIVE_INFINITY }];
    [this.coming, this.news, this.sheltered] = [[], [], false];
  }

  /** How other joints stand in these winds: one that fades goes on fading, and those to come are still to come. */
  stand(settings: AirSettings, answers: (settings: AirSettings) => Answers): Sway {
    if (this.blown.length === 0) this.begin(settings);
    this.sheltered = false;
    const [first, ...others] = this.blown;
    const sway = new Sway(answers(first!.settings));
    for (const { settings, since } of others) sway.change(answers(settings), since);
    return sway;
  }

  /** How much there is of each wind at a time, the newest last. */
  shares(time: number): readonly WindShare[] {
    let shares: WindShare[] = [];
    for (const [at, { settings, since }] of this.blown.entries()) {
      const share = at === 0 ? 1 : fadedIn(time - since);
      shares = [...shares.map((each) => ({ ...each, share: each.share * (1 - share) })), { settings, share }];
    }
    return shares.filter(({ share }) => share > 0);
  }

  /** Joints have come to stand in other shelter: a moment after the wind has turned, to which that belongs. */
  shelter(): void {
    this.sheltered = true;
  }

  /** Has winds that set in by a time take over in a tree. `late` is called before one does that would come as a surprise. */
  pass(sway: Sway, time: number, answers: (settings: AirSettings) => Answers, late: () => void): void {
    for (const { settings, told } of this.news.splice(0)) this.want(settings, told, time, sway);
    const due = this.coming.filter(({ since }) => since <= time);
    this.coming = this.coming.filter(({ since }) => since > time);
    for (const onset of due) {
      this.blown = followedBy(this.blown, onset);
      if (time - onset.since > LATE) late();
      sway.change(answers(onset.settings), onset.since);
    }
    this.blown = leftAt(this.blown, time);
    const present = this.blown.at(-1);
    if (!this.sheltered || !present) return;
    this.sheltered = false;
    sway.change(answers(present.settings), time < present.since + FADE ? present.since : time);
  }

  /** The wind that was set last, at once, where time stands still; null where it blows already. */
  latest(time: number): AirSettings | null {
    for (const { settings, told } of this.news.splice(0)) this.want(settings, told, time, null);
    const last = this.coming.at(-1);
    if (last) this.begin(last.settings);
    return last?.settings ?? null;
  }

  private want(settings: AirSettings, told: number | null, now: number, sway: Sway | null): void {
    // In a calm what blew last dies away.
    if (!blows(settings)) return;
    const isTold = told !== null && told <= now + AHEAD;
    const since = Math.ceil((isTold ? told : now) / BEAT) * BEAT;
    const present = this.blown.at(-1);
    const last = this.coming.at(-1) ?? present;
    if (last && tuningOf(last.settings) === tuningOf(settings)) {
      // One that has blown for long stays: the server may have begun anew, and its time with it.
      if (!isTold || Math.abs(since - last.since) > AHEAD || since === last.since) return;
      last.since = since;
      if (last === present) sway?.retime(since);
      return;
    }
    if (this.coming.at(-1)?.since === since) this.coming.pop();
    this.coming.push({ settings, since });
    if (this.coming.length > MOST) this.coming.shift();
  }
}

/** All of a wind that another takes over. */
function tuningOf({ speed, direction, rise, turbulence, flutter, sag, damping, snow, rain }: AirSettings): string {
  return [speed, direction, rise, turbulence, flutter, sag, damping, snow, rain].join(" ");
}
