/** An attribute of the canvas: a test or a script that works the page sets it while it takes no picture. */
const UNSEEN = "data-unseen";

/** Whether drawing on a canvas pauses because its picture is not used; calls back when the pause ends. */
export class RenderPause {
  private readonly watcher: MutationObserver;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    ended: () => void,
  ) {
    this.watcher = new MutationObserver(() => {
      if (!this.on) ended();
    });
    this.watcher.observe(canvas, { attributeFilter: [UNSEEN] });
  }

  get on(): boolean {
    return this.canvas.hasAttribute(UNSEEN);
  }

  dispose(): void {
    this.watcher.disconnect();
  }
}
