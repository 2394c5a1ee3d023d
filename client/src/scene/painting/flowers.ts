import { FLOWER_NATURES, type FlowerKind } from "../../wire/generated";
import type { Outline, Point } from "./lamina";
import { round } from "./leaf-painter";
import { LeafTile } from "./leaf-tile";
import type { OrnamentPictures } from "./ornament-levels";

type Random = () => number;

export const FLOWER_PICTURES: OrnamentPictures<FlowerKind> = { rosette, catkin, panicle };

/** Five notched petals around stamens, hollow like a bowl. */
function rosette(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FLOWER_NATURES.rosette.reach, side);
  const turn = 2 * Math.PI * random();
  for (let petal = 0; petal < 5; petal += 1) {
    const angle = turn + (2 * Math.PI * (petal + 0.12 * (random() - 0.5))) / 5;
    const light = 0.96 + 0.1 * random();
    tile.fill(petalOutline(angle, 0.44 * (0.94 + 0.06 * random())), (x, y) => {
      const [dx, dy] = [x, y - 0.5];
      const out = Math.hypot(dx, dy) / 0.46;
      const aside = Math.sin(angle) * dy - Math.cos(angle) * dx;
      const veins = 0.5 + 0.5 * Math.cos(aside * 120);
      return {
        shade: light * (0.8 + 0.24 * out) - 0.05 * veins * (1 - out),
        tone: 0.3 * Math.max(0, 0.35 - out),
        sheer: 0.6,
        wood: 0,
        height: 0.16 * out * out - 0.5 * aside * aside,
      };
    });
  }
  for (let i = 0; i < 15; i += 1) {
    const angle = turn + (2 * Math.PI * (i + random())) / 15;
    const far = 0.09 + 0.08 * random();
    const tip: Point = [Math.sin(angle) * far, 0.5 + Math.cos(angle) * far];
    tile.stroke({ from: [0, 0.5], to: tip, width: [0.012, 0.008] }, () => paint(1.25, 0.15, 0.02));
    tile.stroke({ from: tip, to: tip, width: [0.036, 0.036] }, () => paint(1.02, 1, 0.03));
  }
  tile.stroke({ from: [0, 0.5], to: [0, 0.5], width: [0.07, 0.07] }, () => paint(0.75, 0.7, 0.03));
  return tile;
}

function petalOutline(angle: number, length: number): Outline {
  const points: Point[] = [];
  const [along, across] = [
    [Math.sin(angle), Math.cos(angle)],
    [Math.cos(angle), -Math.sin(angle)],
  ] as const;
  const at = (t: number, half: number): Point => [
    (along[0] * t + across[0] * half) * length,
    0.5 + (along[1] * t + across[1] * half) * length,
  ];
  const steps = 14;
  for (let i = 0; i <= 2 * steps; i += 1) {
    const s = i / steps - 1;
    // From the base round by the right to the notch at the tip, and back by the left.
    const t = 1 - Math.abs(s) ** 1.4;
    const half = Math.sign(s) * 0.46 * Math.sin(Math.PI * Math.min(1, Math.abs(s)) ** 0.62);
    points.push(at(0.06 + 0.94 * t * (1 - 0.09 * Math.exp(-((s / 0.14) ** 2))), half));
  }
  return points;
}

/** Small flowers close together along a thread. */
function catkin(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FLOWER_NATURES.catkin.reach, side);
  const rows = 30;
  for (let row = rows - 1; row >= 0; row -= 1) {
    const y = 0.05 + (0.92 * row) / rows;
    const half = 0.075 * Math.min(1, 3.5 * (1 - row / rows) + 0.25) * (0.9 + 0.2 * random());
    for (let i = 0; i < 4; i += 1) {
      const place = (i + random()) / 4;
      const x = half * (2 * place - 1);
      const light = 0.78 + 0.4 * random();
      const second = random() < 0.4 ? 0.8 : 0.1;
      tile.stroke({ from: [x * 0.6, y], to: [x, y + 0.03], width: [0.036, 0.03] }, (_, aside) =>
        paint(light * (1.1 - 0.3 * Math.abs(aside)), second, 0.02 * (1 - place) + 0.02),
      );
    }
  }
  tile.stroke({ from: [0, 0], to: [0, 0.06], width: [0.02, 0.02] }, () => ({ ...paint(0.9, 0, 0.01), wood: 1 }));
  return tile;
}

/** An upright candle of many small flowers, broad below. */
function panicle(random: Random, side?: number): LeafTile {
  const tile = new LeafTile(FLOWER_NATURES.panicle.reach, side);
  tile.stroke({ from: [0, 0], to: [0, 0.9], width: [0.03, 0.01] }, () => ({ ...paint(0.9, 0, 0.01), wood: 1 }));
  for (let i = 0; i < 170; i += 1) {
    const layer = i / 170;
    const t = random();
    const half = 0.215 * (1 - t) ** 0.72 * (1.05 - 0.45 * layer);
    const side = 2 * random() - 1;
    const [x, y] = [half * side, 0.1 + 0.83 * t + 0.02 * (random() - 0.5)];
    const size = 0.062 * (1.05 - 0.5 * t);
    const light = 0.66 + 0.36 * layer + 0.14 * (random() - 0.5);
    const height = 0.12 * Math.sqrt(Math.max(0, 1 - side * side * 0.8)) * (0.4 + 0.6 * layer);
    for (let petal = 0; petal < 4; petal += 1) {
      const angle = (Math.PI * (petal + 0.5 * random())) / 2;
      const to: Point = [x + Math.sin(angle) * size * 0.36, y + Math.cos(angle) * size * 0.36];
      tile.stroke({ from: to, to, width: [size * 0.62, size * 0.62] }, (_, aside) =>
        paint(
          light * (1.08 - 0.18 * Math.abs(aside)),
          0,
          height + round({ from: to, to, width: [size, size] }, 0, aside) * 0.4,
        ),
      );
    }
    tile.stroke({ from: [x, y], to: [x, y], width: [size * 0.3, size * 0.3] }, () => paint(light, 0.9, height));
  }
  return tile;
}

function paint(shade: number, tone: number, height: number) {
  return { shade, tone, sheer: 0.4, wood: 0, height };
}
