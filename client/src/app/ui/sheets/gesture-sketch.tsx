import type { ComponentChildren } from "preact";
import type { SketchName } from "../../help/help-topics";

/** A small drawing of a gesture and its effect, moving where the system allows. */
export function GestureSketch({ name }: { name: SketchName }) {
  return (
    <svg class={`gesture gesture-${name}`} viewBox="0 0 120 90" aria-hidden="true">
      <path class="g-ground" d="M14 80h92" />
      {SKETCHES[name]}
    </svg>
  );
}

const Finger = ({ x, y, name = "" }: { x: number; y: number; name?: string }) => (
  <g class={`g-finger ${name}`}>
    <circle cx={x} cy={y} r="9" />
    <circle class="g-dot" cx={x} cy={y} r="3.500" />
  </g>
);

/** A leaf at a place, turned by degrees. */
const Leaf = ({ x, y, turn }: { x: number; y: number; turn: number }) => (
  <path class="g-leaf" d="M0 0C-6-4-6-11 0-15 6-11 6-4 0 0Z" transform={`translate(${x} ${y}) rotate(${turn})`} />
);

const Tree = ({ name = "" }: { name?: string }) => (
  <g class={`g-tree ${name}`}>
    <path class="g-wood" d="M60 80V46M60 62l-13-12M60 56l12-12" />
    <Leaf x={60} y={46} turn={0} />
    <Leaf x={47} y={50} turn={-50} />
    <Leaf x={72} y={44} turn={45} />
    <Leaf x={53} y={56} turn={-85} />
    <Leaf x={66} y={50} turn={85} />
  </g>
);

const SKETCHES: Record<SketchName, ComponentChildren> = {
  draw: (
    <>
      <path class="g-wood g-grown" pathLength={1} d="M60 80C58 64 50 56 56 42S70 26 64 14" />
      <g class="g-sprouting">
        <Leaf x={55} y={60} turn={-70} />
        <Leaf x={55} y={46} turn={65} />
        <Leaf x={62} y={32} turn={-60} />
        <Leaf x={65} y={22} turn={60} />
      </g>
      <g class="g-along">
        <Finger x={64} y={14} />
      </g>
    </>
  ),
  turn: (
    <>
      <g class="g-turned">
        <Tree />
      </g>
      <path class="g-way" d="M26 84h68" />
      <Finger x={74} y={84} name="g-sideways" />
    </>
  ),
  grow: (
    <>
      <g class="g-swelling">
        <Tree />
      </g>
      <rect class="g-slot" x="92" y="30" width="16" height="44" rx="8" />
      <Finger x={100} y={40} name="g-upward" />
    </>
  ),
  move: (
    <>
      <g class="g-zoomed">
        <Tree />
      </g>
      <Finger x={34} y={66} name="g-apart-low" />
      <Finger x={88} y={28} name="g-apart-high" />
    </>
  ),
  hold: (
    <>
      <Tree />
      <path class="g-chosen" d="M60 56l12-12" />
      <circle class="g-ring" cx="70" cy="46" r="15" pathLength={1} />
      <Finger x={70} y={46} />
    </>
  ),
  cut: (
    <>
      <Tree name="g-pruned" />
      <g class="g-falling">
        <path class="g-wood" d="M60 62l-13-12" />
        <Leaf x={47} y={50} turn={-50} />
      </g>
      <Finger x={50} y={53} name="g-tapping" />
    </>
  ),
};
