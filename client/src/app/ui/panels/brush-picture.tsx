import { DEFAULTS } from "../../document/growth/growth-parameters";
import type { Studio } from "../../studio";
import { placeOf, radiusAt, radiusLabel } from "../../tools/brush/brush-radius";
import { say } from "../../words/say";
import { Grip } from "./architecture/grip";
import { short } from "./architecture/place";

const [WIDTH, HEIGHT] = [288, 168];
const MIDDLE = { x: 164, y: 84 };
/** How wide the narrowest and the widest brush are drawn, in pixels. */
const [NARROW, WIDE] = [14, 72];
/** The grip stands outside the rim. */
const OUTSIDE = 16;
const MOST_MARKERS = 240;
/** The shoot beside the brush, in internodes, and where it stands. */
const SHOOT = 7;
const FOOT = { x: 40, y: HEIGHT - 14 };

/** The brush with the markers it sows, beside a shoot as large as it is to the brush; its rim can be pulled. */
export function BrushPicture({ studio }: { studio: Studio }) {
  const { radius } = studio.stage;
  const widest = studio.stage.widest.value;
  const { marker_density: density, tropism_from_stroke: led } = studio.parameters.value ?? DEFAULTS;
  const drawn = radius === 0 ? 0 : pixelsOf(radius, widest);
  const narrow = radiusAt(0.1, widest);
  const internode = radius === 0 ? pixelsOf(narrow, widest) / narrow : drawn / radius;
  // What lies in the ball's middle slice, as thick as an internode.
  const count = Math.min(MOST_MARKERS, Math.round(density * Math.PI * radius * radius + (radius > 0 ? 3 : 0)));
  return (
    <div class="brush-picture">
      <div class="brush-scene" style={{ width: `${WIDTH}px`, height: `${HEIGHT}px` }}>
        <svg width={WIDTH} height={HEIGHT} role="img" aria-label={say("brush.picture")}>
          <path class="brush-ground" d={`M12 ${FOOT.y}H${WIDTH - 12}`} />
          <path class="brush-shoot" d={shootOf(internode)} stroke-width={Math.min(5, Math.max(1.2, internode / 5))} />
          {radius === 0 ? (
            <path
              class="brush-pencil"
              d={`M${FOOT.x + 28} ${HEIGHT - 30}C110 128 120 70 ${MIDDLE.x} ${MIDDLE.y - 22}`}
            />
          ) : (
            <>
              <circle class="brush-ball" cx={MIDDLE.x} cy={MIDDLE.y} r={drawn} />
              <path class="brush-markers" d={markersIn(drawn, count)} />
              {led && <path class="brush-led" d={arrowUp(drawn)} />}
            </>
          )}
        </svg>
        <Grip
          label={say("brush.rim")}
          text={radius === 0 ? say("bars.radius.sketch") : say("bars.radius.value", { radius: radiusLabel(radius) })}
          value={Math.round(radius * 10) / 10}
          least={0}
          most={widest}
          step={0.5}
          way="level"
          at={{ x: MIDDLE.x + pixelsOf(radius, widest) + OUTSIDE, y: MIDDLE.y }}
          onPull={({ x }) => studio.stage.setRadius(radiusOf(x - MIDDLE.x - OUTSIDE, widest))}
          onValue={(value) => studio.stage.setRadius(value)}
          onRelease={() => {}}
        />
      </div>
    </div>
  );
}

/** Pixels grow with the slider's way, so that a wide brush fits and a narrow one is seen. */
function pixelsOf(radius: number, widest: number): number {
  return NARROW + (WIDE - NARROW) * placeOf(radius, widest);
}

function radiusOf(pixels: number, widest: number): number {
  return radiusAt((pixels - NARROW) / (WIDE - NARROW), widest);
}

/** A shoot with a bud at each node, in turn to the left and to the right. */
function shootOf(internode: number): string {
  let path = `M${FOOT.x} ${FOOT.y}V${short(FOOT.y - SHOOT * internode)}`;
  for (let i = 1; i < SHOOT; i++) {
    const y = FOOT.y - i * internode;
    const aside = (i % 2 === 0 ? -0.6 : 0.6) * internode;
    path += `M${FOOT.x} ${short(y)}l${short(aside)} ${short(-0.55 * internode)}`;
  }
  return path;
}

/** Points strewn over the disc, as a sunflower's seeds, each a little off its place. */
function markersIn(radius: number, count: number): string {
  let path = "";
  for (let i = 0; i < count; i++) {
    const distance = radius * 0.94 * Math.sqrt((i + 0.5) / count);
    const angle = i * 2.399963 + 0.7 * Math.sin(i * 7.1);
    path += `M${short(MIDDLE.x + distance * Math.cos(angle))} ${short(MIDDLE.y + distance * Math.sin(angle))}h0`;
  }
  return path;
}

function arrowUp(radius: number): string {
  const [top, foot] = [MIDDLE.y - Math.max(12, radius * 0.6), MIDDLE.y + Math.max(12, radius * 0.6)];
  return `M${MIDDLE.x} ${short(foot)}V${short(top)}m-6 8l6 -8l6 8`;
}
