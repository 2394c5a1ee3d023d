import type { AddressInfo } from "node:net";
import { connect, createServer, type Server as NetServer, type Socket } from "node:net";

/** How slow a link is: how long a byte is on its way, in milliseconds, and how many go through in a second. */
export interface Slowness {
  readonly delay: number;
  readonly bytesPerSecond: number;
}

/** 1 Mbit/s, 150 ms there and back. */
export const MOBILE: Slowness = { delay: 75, bytesPerSecond: 125_000 };

/** A way to a server that is as slow as it is told to be; as fast as the machine until then. */
export class SlowLink {
  #server: NetServer;
  #sockets = new Set<Socket>();
  /** Those of a network that the device is in no longer. */
  #left = new Set<Socket>();
  #slowness: Slowness | null = null;
  #isCut = false;
  #isStalled = false;

  private constructor(to: number) {
    this.#server = createServer((near) => {
      if (this.#isCut) {
        near.destroy();
        return;
      }
      const far = connect(to, "127.0.0.1");
      for (const [from, into] of [
        [near, far],
        [far, near],
      ] as const) {
        this.#sockets.add(from);
        from.setNoDelay(true);
        this.#carry(from, into);
        if (this.#isStalled) from.pause();
        from.on("error", () => into.destroy());
        from.on("close", () => {
          this.#sockets.delete(from);
          into.destroy();
        });
      }
    });
  }

  /** A link to the server at an address; it has an address of its own. */
  static async to(address: string): Promise<SlowLink> {
    const link = new SlowLink(Number(new URL(address).port));
    await new Promise<void>((listens) => link.#server.listen(0, "127.0.0.1", listens));
    return link;
  }

  /** The same page by way of this link. */
  address(of: string): string {
    const url = new URL(of);
    url.port = String((this.#server.address() as AddressInfo).port);
    return url.href;
  }

  slow(slowness: Slowness | null): void {
    this.#slowness = slowness;
  }

  /** Whatever is said waits until it is let go, as on a link that stalls; whoever comes anew waits as well. */
  stall(): void {
    this.#isStalled = true;
    for (const socket of this.#sockets) socket.pause();
  }

  flow(): void {
    this.#isStalled = false;
    for (const socket of this.#sockets) socket.resume();
  }

  /**
   * As when a device comes into another network: neither end hears any more of what was connected, not even that it has
   * ended, and what connects anew goes through.
   */
  move(): void {
    this.stall();
    for (const socket of this.#sockets) this.#left.add(socket);
    this.#sockets.clear();
    this.#isStalled = false;
  }

  /** Nothing goes through, as without a network, until it is mended. */
  cut(): void {
    this.#isCut = true;
    for (const socket of [...this.#sockets, ...this.#left]) socket.destroy();
    this.#left.clear();
  }

  mend(): void {
    this.#isCut = false;
  }

  async close(): Promise<void> {
    this.cut();
    await new Promise((closed) => this.#server.close(closed));
  }

  /** Passes on what comes, each piece when its turn has come and its way is over. */
  #carry(from: Socket, into: Socket): void {
    let free = 0;
    from.on("data", (bytes) => {
      const now = performance.now();
      const { delay, bytesPerSecond } = this.#slowness ?? { delay: 0, bytesPerSecond: Number.POSITIVE_INFINITY };
      free = Math.max(free, now) + (1000 * bytes.length) / bytesPerSecond;
      const wait = free - now + delay;
      if (wait < 1) into.write(bytes);
      else setTimeout(() => into.writable && into.write(bytes), wait);
    });
  }
}
