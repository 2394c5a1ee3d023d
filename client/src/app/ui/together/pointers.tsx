import { useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import type { Companion } from "../../together/people";
import type { Room } from "../../together/room";
import { useAnimationFrames } from "../use-animation-frames";

/** A name goes when its pointer has been still for so many milliseconds. */
const NAMED_FOR = 3000;

interface PointersProps {
  readonly studio: Studio;
  readonly room: Room;
  readonly all: readonly Companion[];
}

/** The pointers of others, each in their colour: its place, the ball of a brush, and a line that is being drawn. */
export function Pointers({ studio, room, all }: PointersProps) {
  const layer = useRef<HTMLDivElement>(null);
  useAnimationFrames(all.length > 0, () => {
    const width = layer.current?.clientWidth ?? 0;
    const project = studio.stage.projector();
    const now = performance.now();
    const drawn = new Map([...(layer.current?.children ?? [])].map((child) => [Number(child.id.slice(8)), child]));
    for (const { device } of all) {
      const mark = drawn.get(device.device);
      if (!(mark instanceof HTMLElement)) {
        continue;
      }
      const pointer = device.state === "here" ? room.others.pointer(device.device, now) : null;
      const at = pointer && project?.(pointer.at);
      set(mark, "data-shown", String(Boolean(at)));
      if (!pointer || !at) {
        continue;
      }
      const [name, ball, line] = parts(mark);
      if (!name || !ball || !line) {
        continue;
      }
      const [x, y] = [at[0].toFixed(1), at[1].toFixed(1)];
      set(name, "style", `translate: ${x}px ${y}px; --room: ${(width - at[0]).toFixed(1)}px`);
      set(name, "data-named", String(room.others.still(device.device, now) < NAMED_FOR));
      set(ball, "cx", at[0].toFixed(1));
      set(ball, "cy", at[1].toFixed(1));
      set(ball, "r", (pointer.radius * studio.stage.scaleAt(pointer.at)).toFixed(1));
      const path = room.others.sketch(device.device).flatMap((place) => {
        const point = project?.(place);
        return point ? [`${point[0].toFixed(1)} ${point[1].toFixed(1)}`] : [];
      });
      set(line, "d", path.length > 1 ? `M${path.join("L")}Z` : "");
    }
  });
  return (
    <div ref={layer}>
      {all.map(({ device, name, colour }) => (
        <div
          class="companion"
          id={`pointer-${device.device}`}
          key={device.device}
          data-device={device.device}
          style={{ "--person": colour }}
        >
          <svg class="overlay" aria-hidden="true">
            <circle class="companion-ball" r="0" />
            <path class="companion-line" />
          </svg>
          <p class="companion-mark">
            <svg viewBox="0 0 16 20" aria-hidden="true">
              <path d="M1.5 1.5v15l4.2-3.6 2.7 5.6 2.6-1.2-2.7-5.5 5.6-.5z" />
            </svg>
            <span>{name}</span>
          </p>
        </div>
      ))}
    </div>
  );
}

/** Changes nothing where nothing is new. */
function set(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) {
    element.setAttribute(name, value);
  }
}

function parts(mark: HTMLElement): [HTMLElement | null, SVGElement | null, SVGElement | null] {
  return [
    mark.querySelector(".companion-mark"),
    mark.querySelector(".companion-ball"),
    mark.querySelector(".companion-line"),
  ];
}
