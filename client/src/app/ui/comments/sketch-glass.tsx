import { useEffect, useRef } from "preact/hooks";
import { MAX_COMMENT_LINES, MAX_LINE_PLACES } from "../../../wire/generated";
import type { Conversation } from "../../comments/conversation";
import type { Line } from "../../comments/view-picture";
import type { Studio } from "../../studio";

/** Lies over the picture while somebody draws on it, so that view and tree stand still below what is drawn. */
export function SketchGlass({
  studio,
  conversation,
}: {
  readonly studio: Studio;
  readonly conversation: Conversation;
}) {
  useEffect(() => studio.stage.still(), [studio]);
  const glass = useRef<SVGSVGElement>(null);
  const pointer = useRef<number | null>(null);
  const lines = conversation.lines.value;
  const at = (event: PointerEvent): readonly [number, number] => {
    const box = glass.current?.getBoundingClientRect();
    const share = (value: number, from: number, size: number) =>
      Math.round(Math.min(Math.max((value - from) / Math.max(size, 1), 0), 1) * 1000) / 1000;
    return box ? [share(event.clientX, box.left, box.width), share(event.clientY, box.top, box.height)] : [0, 0];
  };
  return (
    <svg
      ref={glass}
      class="comment-glass"
      aria-hidden="true"
      data-drawing={conversation.sketching.value}
      viewBox="0 0 1 1"
      preserveAspectRatio="none"
      onPointerDown={(event) => {
        if (conversation.sketching.peek() && lines.length < MAX_COMMENT_LINES && pointer.current === null) {
          pointer.current = event.pointerId;
          glass.current?.setPointerCapture(event.pointerId);
          conversation.lines.value = [...lines, [at(event)]];
        }
      }}
      onPointerMove={(event) => {
        if (pointer.current === event.pointerId) {
          conversation.lines.value = longer(conversation.lines.peek(), at(event));
        }
      }}
      onPointerUp={() => {
        pointer.current = null;
      }}
      onPointerCancel={() => {
        pointer.current = null;
      }}
    >
      {lines.map((line, i) => (
        // Lines are only added at the end, so their numbers are theirs.
        <g key={i}>
          <polyline class="sketch-ground" points={pointsOf(line)} />
          <polyline class="sketch-line" points={pointsOf(line)} />
        </g>
      ))}
    </svg>
  );
}

function pointsOf(line: Line): string {
  // A touch that does not move is a dot.
  const places = line.length === 1 ? [line[0]!, line[0]!] : line;
  return places.map(([x, y]) => `${x},${y}`).join(" ");
}

/** The last line goes on; one that is full is thinned to half its places. */
function longer(lines: readonly Line[], place: readonly [number, number]): readonly Line[] {
  const last = lines.at(-1) ?? [];
  const kept = last.length >= MAX_LINE_PLACES ? last.filter((_, i) => i % 2 === 0) : last;
  return [...lines.slice(0, -1), [...kept, place]];
}
