import { FRUIT_NATURES, type FruitKind } from "../../wire/generated";
import type { Outline, Point } from "./lamina";
import { LeafTile, type Paint } from "./leaf-tile";
import type { OrnamentPictures } from "./ornament-levels";

type Random = () => number;

/** All hang. */
export const FRUIT_PICTURES: OrnamentPictures<FruitKind> = { round: ball, cone, nut, winged };

const STALK: Omit<Paint, "height"> = { shade: 0.9, tone: 0, sheer: 0, wood: 1 };

/** A ball on a stalk, flushed on one side. */
function ball(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FRUIT_NATURES.round.reach, side);
  const centre = 0.57;
  const radius = 0.41;
  const [flushX, flushY] = [0.5 * (random() - 0.5), 0.3 * (random() - 0.5)];
  stalk(tile, [0.02 * (random() - 0.5), 0.02], [0, centre - radius * 0.8], 0.045);
  tile.fill(oval([0, centre], radius, radius * 0.97), (x, y) => {
    const [dx, dy] = [x / radius, (y - centre) / radius];
    const out = Math.min(1, dx * dx + dy * dy);
    const dimple = Math.exp(-((dx / 0.34) ** 2) - ((dy + 0.92) / 0.3) ** 2);
    const flush = Math.hypot(dx - flushX, dy - flushY);
    const streaks = 0.5 + 0.5 * Math.sin(26 * Math.atan2(dx, dy + 2.2) + 4 * random());
    return {
      shade: 1 - 0.34 * dimple - 0.06 * streaks * out,
      tone: 0.55 * Math.min(1, Math.max(0, flush - 0.45)) * (0.75 + 0.25 * streaks) + 0.4 * dimple,
      sheer: 0.12,
      wood: 0,
      height: 0.62 * radius * Math.sqrt(1 - out) - 0.08 * dimple,
    };
  });
  stalk(tile, [0, centre - radius * 1.02], [0, centre - radius * 0.82], 0.04);
  return tile;
}

/** Scales in spirals, those nearer to the tip under the others. */
function cone(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FRUIT_NATURES.cone.reach, side);
  stalk(tile, [0, 0.02], [0, 0.1], 0.05);
  const rows = 13;
  const half = (t: number) => 0.22 * Math.sin(Math.PI * Math.min(1, 0.16 + 0.86 * t)) ** 0.62;
  tile.fill(oval([0, 0.52], 0.17, 0.42), () => ({ shade: 0.35, tone: 0, sheer: 0, wood: 0, height: 0 }));
  for (let row = rows - 1; row >= 0; row -= 1) {
    const t = row / (rows - 1);
    const y = 0.08 + 0.82 * t;
    const wide = half(t);
    const across = 5;
    for (const i of [0, 4, 1, 3, 2]) {
      const side = Math.sin(((i + (row % 2 === 0 ? 0.5 : 0) - 2.25) / across) * Math.PI * 0.95);
      const x = wide * side;
      const size = 0.085 * (0.55 + 0.45 * Math.cos(side * 1.3)) * (0.7 + 0.6 * (wide / 0.22));
      const light = 0.78 + 0.24 * random();
      const to: Point = [x + 0.02 * side, y + 0.035];
      tile.stroke({ from: [x * 0.8, y - 0.035], to, width: [size * 0.7, size] }, (along, aside) => ({
        shade: light * (0.62 + 0.5 * along) * (1.08 - 0.3 * aside * aside),
        tone: along > 0.55 ? 0.6 * (along - 0.3) : 0,
        sheer: 0,
        wood: 0,
        height: 0.1 * Math.sqrt(Math.max(0, 1 - side * side)) + 0.05 * along,
      }));
    }
  }
  return tile;
}

/** A nut in its cup, as of oaks. */
function nut(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FRUIT_NATURES.nut.reach, side);
  stalk(tile, [0, 0.02], [0, 0.16], 0.04);
  const tip = 0.97;
  const body: Point[] = oval([0, 0.58], 0.25, 0.33).filter(([, y]) => y < 0.89);
  tile.fill([...body, [0.02, tip] as const, [-0.02, tip] as const].sort(around([0, 0.58])), (x, y) => {
    const side = x / 0.25;
    const streak = 0.5 + 0.5 * Math.sin(70 * Math.asin(Math.max(-1, Math.min(1, side * 0.95))) + 3);
    return {
      shade: 1.02 - 0.1 * streak,
      tone: 0.35 * Math.max(0, 1 - (y - 0.3) / 0.5),
      sheer: 0,
      wood: 0,
      height: 0.2 * Math.sqrt(Math.max(0, 1 - side * side - ((y - 0.58) / 0.42) ** 2)),
    };
  });
  const cup = oval([0, 0.34], 0.29, 0.24).filter(([, y]) => y < 0.44);
  tile.fill(cup, (x, y) => {
    const side = x / 0.29;
    const bumps = Math.sin(x * 95 + (Math.floor(y * 26) % 2) * 1.6) * Math.sin(y * 82);
    return {
      shade: 0.86 + 0.22 * bumps + 0.06 * random(),
      tone: 1,
      sheer: 0,
      wood: 0.35,
      height: 0.24 * Math.sqrt(Math.max(0, 1 - side * side)) + 0.008 * bumps,
    };
  });
  return tile;
}

/** Two nutlets side by side, each with a wing. */
function winged(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FRUIT_NATURES.winged.reach, side);
  stalk(tile, [0, 0.02], [0, 0.3], 0.024);
  for (const sign of [-1, 1]) {
    const spread = 0.95 + 0.16 * (random() - 0.5);
    const place = (t: number, out: number): Point => [
      sign * (0.05 + (0.4 * t + 0.55 * out) * spread * 0.98),
      0.32 + 0.6 * t ** 1.2 - 0.42 * out,
    ];
    const wing: Point[] = [];
    for (let i = 0; i <= 24; i += 1) wing.push(place(i / 24, 0.035 * (1 - i / 24)));
    for (let i = 24; i >= 0; i -= 1) wing.push(place(i / 24, -0.24 * Math.sin(Math.PI * (i / 24) ** 1.3) ** 0.8));
    tile.fill(wing, (x, y) => {
      const fan = Math.abs(Math.sin(46 * Math.atan2(y - 0.2, Math.abs(x) + 0.12)));
      return { shade: 0.92 + 0.14 * fan, tone: 0.55 - 0.25 * fan, sheer: 0.7, wood: 0, height: 0.004 * fan };
    });
    tile.stroke({ from: place(0, 0.02), to: place(0.9, 0.0), width: [0.045, 0.012] }, (_, aside) => ({
      shade: 0.85,
      tone: 0,
      sheer: 0.2,
      wood: 0.2,
      height: 0.02 * (1 - Math.abs(aside)),
    }));
    tile.fill(oval([sign * 0.09, 0.35], 0.085, 0.075), (x, y) => {
      const out = ((x - sign * 0.09) / 0.085) ** 2 + ((y - 0.35) / 0.075) ** 2;
      return { shade: 0.9, tone: 0.1, sheer: 0.1, wood: 0.15, height: 0.07 * Math.sqrt(Math.max(0, 1 - out)) };
    });
  }
  return tile;
}

function stalk(tile: LeafTile, from: Point, to: Point, width: number): void {
  tile.stroke({ from, to, width: [width, width * 0.8] }, (_, aside) => ({
    ...STALK,
    height: 0.5 * width * Math.sqrt(1 - aside * aside),
  }));
}

function oval([x, y]: Point, rx: number, ry: number): Outline {
  return Array.from({ length: 64 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 64;
    return [x + rx * Math.sin(angle), y - ry * Math.cos(angle)] as const;
  });
}

/** Orders points by where they stand around a centre. */
function around([x, y]: Point): (a: Point, b: Point) => number {
  return (a, b) => Math.atan2(a[0] - x, a[1] - y) - Math.atan2(b[0] - x, b[1] - y);
}
