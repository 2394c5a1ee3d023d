import type { Vec3 } from "../vector";

/** From where and how finely the tree is seen; what level of detail is chosen by. */
export interface Fineness {
  readonly eye: Vec3;
  /** Pixels that an internode covers at distance one, of those that are drawn. */
  readonly pixels: number;
  /** 0 while the user moves on a slow device, to 1 for the picture at rest. */
  readonly ease: number;
}
