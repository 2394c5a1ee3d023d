import type { Vec3 } from "../vector";
import type { Chain, Place } from "./chain";

/** A finger on the far end of an internode of the path, and where it is. */
export interface Touch {
  readonly internode: number;
  readonly place: Vec3;
}

/** A node that is pulled somewhere. */
export interface Pull {
  readonly at: Place;
  /** From the centre of the prism below it (0 to 2) and of the next one (3 to 5), at rest. */
  readonly arms: Float64Array;
  readonly target: Vec3;
  readonly weight: number;
}

const WEIGHT = 100;
const GIVE = 0.02;
const MOST_GIVE = 100;
const NO_WOOD = 1e-3;
const ASIDE = 1e-6;

/** What pulls at the branch, no farther than the wood reaches; touches go from the base upwards. */
export function pullsOf(chain: Chain, touches: readonly Touch[]): Pull[] {
  const weight = WEIGHT / (chain.length * chain.length);
  const stiff = 1 - chain.stretch;
  const hold = (stiff * stiff * stiff) / GIVE;
  let from = chain.node(1);
  let along = 0;
  return touches.map(({ internode, place }) => {
    const node = chain.node(internode + 1);
    const way = Math.hypot(place[0] - node[0], place[1] - node[1], place[2] - node[2]);
    const beside = aside(chain, node);
    let target: Vec3 = [
      place[0] + ASIDE * way * beside[0],
      place[1] + ASIDE * way * beside[1],
      place[2] + ASIDE * way * beside[2],
    ];
    const wood = Math.max(chain.along(internode + 1) - along, NO_WOOD * chain.length);
    const away = [target[0] - from[0], target[1] - from[1], target[2] - from[2]] as const;
    const distance = Math.hypot(...away);
    const excess = Math.min(distance / wood - 1, MOST_GIVE);
    if (excess > 0) {
      const share = (wood * (1 + excess / (1 + hold * excess))) / distance;
      target = [from[0] + away[0] * share, from[1] + away[1] * share, from[2] + away[2] * share];
    }
    from = target;
    along = chain.along(internode + 1);
    const at = chain.end(internode);
    return { at, arms: armsOf(chain, at, node), target, weight };
  });
}

function armsOf({ centres }: Chain, { prism, share }: Place, node: Vec3): Float64Array {
  const arms = new Float64Array(6);
  for (let i = 0; i < 3; i += 1) {
    arms[i] = node[i]! - centres[3 * prism + i]!;
    if (share !== 0) arms[3 + i] = node[i]! - centres[3 * prism + 3 + i]!;
  }
  return arms;
}

/** A direction perpendicular to the way from the base to a node. */
function aside(chain: Chain, node: Vec3): Vec3 {
  const base = chain.node(0);
  const [x, y, z] = [node[0] - base[0], node[1] - base[1], node[2] - base[2]];
  const across: Vec3 = Math.abs(x) < Math.abs(z) ? [0, z, -y] : [y, -x, 0];
  const length = Math.hypot(...across);
  return length > 0 ? [across[0] / length, across[1] / length, across[2] / length] : [1, 0, 0];
}
