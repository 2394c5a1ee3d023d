import type { Vec3 } from "../vector";
import type { Quality } from "./quality";

/** From where and how finely the tree is seen; what level of detail is chosen by. */
export interface Fineness extends Pick<Quality, "detailed" | "merging" | "leaves" | "sprigs" | "twigs"> {
  readonly eye: Vec3;
  /** Pixels that an internode covers at distance one, of those that are drawn. */
  readonly pixels: number;
}
