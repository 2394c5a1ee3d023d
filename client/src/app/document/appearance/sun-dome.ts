import type { DomePlace } from "./sun-orbit";

/** The dome's radius, as a share of the workspace's smaller side, and how far the sun stays from the edges, in pixels. */
const RADIUS = 0.4;
const EDGE = 34;
const TOP_EDGE = 84;
/** How far its middle stays from a bar, so that neither the sun nor its pin lies on it. */
const BESIDE_BAR = 28;
const PIN = 60;

/** A part of the page, in its pixels. */
export interface Rectangle {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** The dome on the screen: around the middle of the workspace. */
export interface Dome {
  /** Where in the workspace the sun is drawn. */
  pixels(place: DomePlace): readonly [x: number, y: number];
  /** What a finger on the page points at. */
  place(clientX: number, clientY: number): readonly [right: number, up: number];
}

/** The dome of a workspace; the sun stays clear of the bar at its side, under which it could not be dragged. */
export function domeOf({ left, top, width, height }: Rectangle, bar: Rectangle | null): Dome {
  const radius = RADIUS * Math.min(width, height);
  const [middleX, middleY] = [width / 2, height / 2 + 0.06 * height];
  const atLeft = bar !== null && bar.left + bar.width / 2 < left + width / 2;
  const least = bar && atLeft ? Math.max(EDGE, bar.left + bar.width - left + BESIDE_BAR) : EDGE;
  const most = bar && !atLeft ? Math.min(width - EDGE, bar.left - left - PIN) : width - EDGE;
  return {
    pixels: ({ right, up }) => [
      within(middleX + radius * right, least, most),
      within(middleY - radius * up, TOP_EDGE, height - EDGE),
    ],
    place: (x, y) => [(x - left - middleX) / radius, (middleY - (y - top)) / radius],
  };
}

function within(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
