import { useEffect, useRef } from "preact/hooks";
import { barkPalette } from "../../../../scene/painting/bark-palette";
import { type BarkTexels, barkTexels } from "../../../../scene/painting/bark-relief";
import { MOST_SHADE, MOST_SLOPE } from "../../../../scene/painting/measures";
import type { BarkKind } from "../../../../wire/generated";
import { type Colour, hexOf } from "../../controls/colour-field";

/** Texels along each side of a picture. */
const SIDE = 64;
/** How light falls on it, from above on the left: how much a slope around the limb brightens it, and one along it. */
const LIGHT = [-0.5, 0.3] as const;

/** The barks that have been made, which are the same in every colour. */
const made = new Map<BarkKind, BarkTexels>();
/** Barks are made one after the other, so that a panel opens at once. */
let queue: Promise<void> = Promise.resolve();

/** A piece of bark of a kind in a colour, as it stands on a trunk: the very texture in small. */
export function BarkPicture({ kind, tint }: { kind: BarkKind; tint: Readonly<Colour> }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [red, green, blue] = tint;
  useEffect(() => {
    let here = true;
    void textureOf(kind).then((texels) => {
      if (here && canvas.current) {
        paint(canvas.current, kind, [red, green, blue], texels);
      }
    });
    return () => {
      here = false;
    };
  }, [kind, red, green, blue]);
  return (
    <span class="bark-picture" aria-hidden="true">
      <canvas ref={canvas} width={SIDE} height={SIDE} style={{ background: hexOf(tint) }} />
    </span>
  );
}

async function textureOf(kind: BarkKind): Promise<BarkTexels> {
  const known = made.get(kind);
  if (known) {
    return known;
  }
  queue = queue.then(async () => {
    if (!made.has(kind)) {
      await new Promise((resolve) => setTimeout(resolve));
      made.set(kind, barkTexels(kind, SIDE));
    }
  });
  await queue;
  return textureOf(kind);
}

function paint(canvas: HTMLCanvasElement, kind: BarkKind, tint: Readonly<Colour>, { colours, relief }: BarkTexels) {
  const context = canvas.getContext("2d");
  if (!context) {
    return;
  }
  const palette = barkPalette(kind, tint);
  const picture = context.createImageData(SIDE, SIDE);
  for (let at = 0; at < 4 * SIDE * SIDE; at += 4) {
    // Lines of a texture go upwards, those of a picture downwards.
    const to = at + 4 * SIDE * (SIDE - 1 - 2 * Math.floor(at / (4 * SIDE)));
    const slope = (i: 0 | 1) => ((relief[at + i]! / 255) * 2 - 1) * MOST_SLOPE;
    const light = Math.max(0.25, 1 + LIGHT[0] * slope(0) + LIGHT[1] * slope(1)) * (relief[at + 2]! / 255);
    for (const i of [0, 1, 2] as const) {
      const own = palette[0][i] * MOST_SHADE * colours[at]!;
      const albedo = (own + palette[1][i] * colours[at + 1]! + palette[2][i] * colours[at + 2]!) / 255;
      picture.data[to + i] = 255 * Math.min(1, light * albedo) ** (1 / 2.2);
    }
    picture.data[to + 3] = 255;
  }
  context.putImageData(picture, 0, 0);
}
