/** A frame may take so long, in milliseconds, while others are already asked for: cards draw one while the next is made. */
const BEHIND = 40;

/**
 * Whether the graphics card has done what it was asked for. WebGL takes commands long before they are carried out; where
 * a frame takes seconds, those asked for meanwhile would queue up, and the picture would follow the finger by minutes.
 */
export class FrameFence {
  /** Frames that may not be done yet, the first one first. */
  private readonly asked: { readonly sync: WebGLSync; readonly began: number }[] = [];
  /** Whether the last that was done took so long that it is waited for alone. */
  private slow = false;

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** A frame that began at a time, in milliseconds, has been asked for. */
  set(began: number): void {
    const { gl } = this;
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (sync) this.asked.push({ sync, began });
    gl.flush();
  }

  /** What was asked for so far is not waited for. */
  forget(): void {
    for (const { sync } of this.asked.splice(0)) this.gl.deleteSync(sync);
    this.slow = false;
  }

  /** The card has come back, and knows nothing of what it was asked for before. */
  restored(): void {
    this.asked.length = 0;
    this.slow = false;
  }

  /** Whether another frame would have to wait for one of those, and nobody knows for how long. */
  behind(now: number): boolean {
    const { gl, asked } = this;
    const lost = gl.isContextLost();
    while (asked.length > 0) {
      const { sync, began } = asked[0]!;
      if (!lost && gl.getSyncParameter(sync, gl.SYNC_STATUS) === gl.UNSIGNALED) {
        return this.slow || now - began >= BEHIND;
      }
      this.slow = now - began >= BEHIND;
      gl.deleteSync(sync);
      asked.shift();
    }
    return false;
  }
}
