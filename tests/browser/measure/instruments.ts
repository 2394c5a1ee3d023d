/** What one frame asked of the graphics card in one of its passes. */
export interface Work {
  calls: number;
  triangles: number;
}

/** One frame of the page. */
export interface FrameRecord {
  /** Milliseconds of the page's own script in it. */
  script: number;
  camera: Work;
  shadow: Work;
  /** When it ended, in milliseconds since the navigation. */
  at: number;
}

declare global {
  interface Window {
    /** Frames in which something was drawn. */
    measured: FrameRecord[];
    /** When the first frame that drew a tree ended, in milliseconds since the navigation. */
    firstTree: Promise<number>;
    /** When the first frame ended that showed one, be it by lines, and when that was drawn if that is waited for. */
    firstSight: Promise<number>;
    /** What is drawn is counted but not passed on, so that script never waits for the graphics card. */
    blind: boolean;
    /** When rows that sway were drawn, in milliseconds since the navigation. */
    swayed: number[];
    /** How long joints took to be made beside the page, from the question to the answer, in milliseconds. */
    joints: number[];
    /** When the first rows came, in milliseconds since the navigation. */
    rowsAt: number;
  }
}

/** A tree is seen once so many triangles of it are drawn. */
export const A_TREE = 50_000;

/** What is counted as a tree, and whether the page waits until the first sight of one is drawn. */
export interface Watching {
  readonly aTree: number;
  readonly waits: boolean;
}

/** Counts what a page draws and times its script; runs in the page before anything else. */
export function instrument({ aTree, waits }: Watching): void {
  const shadowMap = 2048;
  const CHUNK_ROWS = 256;
  let seen: (at: number) => void = () => {};
  let sighted: ((at: number) => void) | null = null;
  window.firstSight = new Promise((resolve) => {
    sighted = resolve;
  });
  window.firstTree = new Promise((resolve) => {
    seen = resolve;
  });
  window.measured = [];
  window.blind = false;
  window.rowsAt = Number.NaN;
  window.swayed = [];
  window.joints = [];
  window.Worker = class extends Worker {
    private asked = 0;

    constructor(address: URL | string, options?: WorkerOptions) {
      super(address, options);
      if (!String(address).includes("joint-worker")) return;
      this.addEventListener("message", () => window.joints.push(performance.now() - this.asked));
    }

    override postMessage(...task: [message: unknown]): void {
      this.asked = performance.now();
      super.postMessage(...task);
    }
  };
  window.WebSocket = class extends WebSocket {
    constructor(...address: ConstructorParameters<typeof WebSocket>) {
      super(...address);
      this.addEventListener("message", ({ data }) => {
        if (typeof data !== "string" && Number.isNaN(window.rowsAt)) window.rowsAt = performance.now();
      });
    }
  };
  let frame: FrameRecord | null = null;
  let stamp = -1;
  let width = 0;

  const { prototype } = WebGL2RenderingContext;
  const { viewport } = prototype;
  prototype.viewport = function (x, y, w, h) {
    width = w === h ? w : 0;
    // How rows move is drawn into a texture with as many texels a line as a chunk has rows.
    if (w === CHUNK_ROWS && w !== h) window.swayed.push(performance.now());
    return viewport.call(this, x, y, w, h);
  };
  const count = (mode: number, vertices: number, instances: number) => {
    if (!frame) return;
    const work = width === shadowMap ? frame.shadow : frame.camera;
    work.calls += 1;
    if (mode === 4) work.triangles += (vertices / 3) * instances;
    if (mode === 5) work.triangles += (vertices - 2) * instances;
  };
  const { drawArrays, drawElements, drawArraysInstanced, drawElementsInstanced } = prototype;
  prototype.drawArrays = function (mode, first, n) {
    count(mode, n, 1);
    if (!window.blind) drawArrays.call(this, mode, first, n);
  };
  prototype.drawElements = function (mode, n, type, offset) {
    count(mode, n, 1);
    if (!window.blind) drawElements.call(this, mode, n, type, offset);
  };
  prototype.drawArraysInstanced = function (mode, first, n, instances) {
    count(mode, n, instances);
    if (!window.blind) drawArraysInstanced.call(this, mode, first, n, instances);
  };
  prototype.drawElementsInstanced = function (mode, n, type, offset, instances) {
    count(mode, n, instances);
    if (!window.blind) drawElementsInstanced.call(this, mode, n, type, offset, instances);
  };

  const { clear, blitFramebuffer } = prototype;
  prototype.clear = function (mask) {
    if (!window.blind) clear.call(this, mask);
  };
  prototype.blitFramebuffer = function (...blit) {
    if (!window.blind) blitFramebuffer.apply(this, blit);
  };

  /** Until all that was asked of WebGL is drawn, which it says only by giving pixels back. */
  const wait = () => {
    const gl = document.querySelector<HTMLCanvasElement>("#workspace")!.getContext("webgl2")!;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  };

  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    request((time) => {
      // All callbacks of one frame get the same time.
      if (time !== stamp) {
        stamp = time;
        if (frame && frame.camera.calls > 0) window.measured.push(frame);
        frame = { script: 0, camera: { calls: 0, triangles: 0 }, shadow: { calls: 0, triangles: 0 }, at: 0 };
      }
      const began = performance.now();
      callback(time);
      const ended = performance.now();
      if (frame) {
        frame.script += ended - began;
        frame.at = ended;
        const { camera } = frame;
        if (camera.triangles > aTree && sighted) {
          if (waits) wait();
          sighted(performance.now());
          sighted = null;
        }
        // Lines are one call, straight onto the canvas.
        if (camera.triangles > aTree && camera.calls > 1) seen(ended);
      }
    });
}
