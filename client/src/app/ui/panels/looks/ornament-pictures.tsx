import type { ComponentChildren } from "preact";
import type { FlowerKind, FruitKind, Place } from "../../../../wire/generated";
import { type Colour, hexOf } from "../../controls/colour-field";

interface Painted {
  readonly tint: Readonly<Colour>;
}

function Picture({ children }: { children: ComponentChildren }) {
  return (
    <svg viewBox="0 0 40 40" aria-hidden="true">
      {children}
    </svg>
  );
}

const NONE = <path d="M11 11l18 18M29 11 11 29" stroke="currentColor" stroke-width="2" opacity="0.35" />;
const STALK = { fill: "none", stroke: "#7d6a55", "stroke-width": 1.6, "stroke-linecap": "round" } as const;
const EDGE = { stroke: "rgb(40 30 20 / 35%)", "stroke-width": 0.7 } as const;

/** A flower of a kind in a colour. */
export function FlowerPicture({ kind, tint }: Painted & { kind: FlowerKind }) {
  const fill = hexOf(tint);
  switch (kind) {
    case "none":
      return <Picture>{NONE}</Picture>;
    case "rosette":
      return (
        <Picture>
          {[0, 72, 144, 216, 288].map((turn) => (
            <path
              key={turn}
              d="M20 20C14 15 14 7 18.4 5.4L20 7l1.6-1.6C26 7 26 15 20 20Z"
              transform={`rotate(${turn} 20 20)`}
              fill={fill}
              {...EDGE}
            />
          ))}
          <circle cx="20" cy="20" r="3.4" fill="#e0b040" />
        </Picture>
      );
    case "catkin":
      return (
        <Picture>
          <path d="M12 5h16" {...STALK} />
          {[14, 25].map((x, i) => (
            <g key={x}>
              <path d={`M${x} 5v5`} {...STALK} />
              <rect x={x - 3} y="9" width="6" height={i === 0 ? 24 : 18} rx="3" fill={fill} {...EDGE} />
              {[13, 17, 21, 25, 29].slice(0, i === 0 ? 5 : 3).map((y) => (
                <path key={y} d={`M${x - 3} ${y}q3 2.5 6 0`} fill="none" stroke="rgb(40 30 20 / 30%)" />
              ))}
            </g>
          ))}
        </Picture>
      );
    case "panicle":
      return (
        <Picture>
          <path d="M20 37V6" {...STALK} />
          {[8, 12, 16.5, 21, 25.5, 30].map((y, row) => {
            const half = 1.2 + row * 1.9;
            return [-half, 0, half].map((x) => (
              <circle key={`${x} ${y}`} cx={20 + x} cy={y + Math.abs(x) * 0.15} r="3.1" fill={fill} {...EDGE} />
            ));
          })}
        </Picture>
      );
  }
}

/** A fruit of a kind in a colour. */
export function FruitPicture({ kind, tint }: Painted & { kind: FruitKind }) {
  const fill = hexOf(tint);
  switch (kind) {
    case "none":
      return <Picture>{NONE}</Picture>;
    case "round":
      return (
        <Picture>
          <path d="M20 5c-4 5-7 10-7 17M20 5c3 4 6 8 7 14" {...STALK} />
          <circle cx="13" cy="26" r="7.5" fill={fill} {...EDGE} />
          <circle cx="27" cy="24" r="7.5" fill={fill} {...EDGE} />
          <path
            d="M9.5 23.5q1-2.5 3-3M23.5 21.5q1-2.5 3-3"
            fill="none"
            stroke="rgb(255 255 255 / 65%)"
            stroke-width="1.6"
          />
        </Picture>
      );
    case "cone":
      return (
        <Picture>
          <path d="M20 3v6" {...STALK} />
          <path
            d="M20 7c7 3 9.5 9 8.5 16-.8 6-4 10.5-8.5 13-4.5-2.5-7.7-7-8.5-13-1-7 1.5-13 8.5-16Z"
            fill={fill}
            {...EDGE}
          />
          <path
            d="M12 19l8-5 8 5M11.5 25l8.5-5.5 8.5 5.500M13.5 30.500l6.5-5 6.5 5M17 15l-2.5-3.500M23 15l2.5-3.5"
            fill="none"
            stroke="rgb(40 25 10 / 45%)"
            stroke-width="1.3"
          />
        </Picture>
      );
    case "nut":
      return (
        <Picture>
          <path d="M20 4v7" {...STALK} />
          <path d="M11.5 19c0 9 4 14.5 8.5 17 4.5-2.5 8.5-8 8.5-17Z" fill={fill} {...EDGE} />
          <path d="M9.5 20c0-6.5 4.5-10.5 10.5-10.500S30.5 13.5 30.5 20c-6 2-15 2-21 0Z" fill="#8a6b48" {...EDGE} />
          <path d="M13 17.500l4-5M18 19l5-7M23.5 19.500l4-5" stroke="rgb(40 25 10 / 35%)" stroke-width="1.1" />
        </Picture>
      );
    case "winged":
      return (
        <Picture>
          <path d="M20 4v8" {...STALK} />
          {[1, -1].map((side) => (
            <g key={side} transform={`translate(20 0) scale(${side} 1)`}>
              <path d="M1 13c6-1 13 5 14 15 .3 4-3.5 5.5-6 2C6 26 3.5 21 1 19Z" fill={fill} {...EDGE} />
              <path d="M3 16c5 2 8 7 9 12M3 17.500c3 3 5 6 6.5 10" fill="none" stroke="rgb(40 30 20 / 30%)" />
              <circle cx="2.5" cy="16" r="3" fill="#8a6b48" />
            </g>
          ))}
        </Picture>
      );
  }
}

/** Where on a twig something is borne. */
export function PlacePicture({ place, tint }: Painted & { place: Place }) {
  const fill = hexOf(tint);
  const spots = {
    tips: [
      [20, 5],
      [8, 10],
      [32, 10],
    ],
    twigs: [
      [20, 12],
      [14.5, 15],
      [25.5, 15],
      [10.5, 12.5],
      [29.5, 12.5],
      [20, 18],
    ],
    wood: [
      [17.5, 26],
      [22.5, 30],
      [17.5, 34],
    ],
  }[place];
  return (
    <Picture>
      <path d="M20 38V22" fill="none" stroke="#7d6a55" stroke-width="4.5" stroke-linecap="round" />
      <path d="M20 24V6M20 21 8 11M20 21 32 11" {...STALK} />
      {place !== "wood" &&
        [
          [20, 9, 0],
          [12, 9, -50],
          [28, 9, 50],
        ].map(([x, y, turn]) => (
          <ellipse
            key={x}
            cx={x}
            cy={y}
            rx="2"
            ry="4"
            transform={`rotate(${turn} ${x} ${y})`}
            fill="#6fae5c"
            opacity="0.55"
          />
        ))}
      {spots.map(([x, y]) => (
        <circle key={`${x} ${y}`} cx={x} cy={y} r="3.2" fill={fill} stroke="rgb(30 25 20 / 55%)" stroke-width="0.9" />
      ))}
    </Picture>
  );
}
