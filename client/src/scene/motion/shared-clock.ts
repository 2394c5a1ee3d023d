/** The clock gains or loses at most so many seconds in a second. */
const SLEW = 0.005;
/** What is further off than this, in seconds, is jumped to. */
const JUMP = 1;

/** Seconds that all who look at a session share, and that never go backwards unless they jump. */
export class SharedClock {
  private offset: number;
  private last: number;

  /** `own` is a clock that nobody sets, `shared` one that all have; both in seconds. */
  constructor(
    private readonly own: () => number,
    private readonly shared: () => number,
  ) {
    this.last = own();
    this.offset = shared() - this.last;
  }

  /** The time now, and whether it has jumped since it was asked for last. */
  read(): { readonly time: number; readonly jumped: boolean } {
    const own = this.own();
    const gap = this.shared() - own - this.offset;
    const jumped = !(Math.abs(gap) <= JUMP);
    const most = SLEW * Math.max(0, own - this.last);
    this.last = own;
    if (Number.isFinite(gap)) this.offset += jumped ? gap : Math.min(Math.max(gap, -most), most);
    return { time: own + this.offset, jumped: jumped && Number.isFinite(gap) };
  }
}
