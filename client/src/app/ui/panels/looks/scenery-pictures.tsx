import { useId } from "preact/hooks";
import type { Ground, Sky } from "../../../../wire/generated";
import { type Colour, hexOf } from "../../controls/colour-field";

/** Colours of a sky from above down to the horizon. */
const SKIES: Record<Exclude<Sky, "studio">, readonly [string, string, string]> = {
  meadow: ["#9fc2dc", "#cfe0e6", "#f1ecd9"],
  clear: ["#2f6fb8", "#6fa8dc", "#cfe6f4"],
  overcast: ["#a8b0b6", "#c2c8cb", "#dcdfe0"],
};

/** A kind of sky; that of the studio in the backdrop's own colour. */
export function SkyPicture({ sky, backdrop }: { sky: Sky; backdrop: Readonly<Colour> }) {
  const id = useId();
  const plain = hexOf(backdrop);
  const [zenith, middle, horizon] = sky === "studio" ? [plain, plain, plain] : SKIES[sky];
  return (
    <svg viewBox="0 0 40 40" aria-hidden="true">
      <linearGradient id={id} x1="0" y1="0" x2="0" y2="1">
        <stop offset="0" stop-color={zenith} />
        <stop offset="0.6" stop-color={middle} />
        <stop offset="1" stop-color={horizon} />
      </linearGradient>
      <rect width="40" height="40" rx="9" fill={`url(#${id})`} stroke="rgb(60 60 60 / 20%)" />
      {sky === "meadow" && <path d="M0 33q20-6 40 0v7H0Z" fill="rgb(255 255 255 / 55%)" />}
      {sky === "clear" && <circle cx="28" cy="12" r="4.5" fill="#fff6d8" />}
      {sky === "overcast" && (
        <path d="M7 20a6 6 0 0 1 9-6 8 8 0 0 1 15 3 5 5 0 0 1-1 10H12a6 6 0 0 1-5-7Z" fill="rgb(255 255 255 / 60%)" />
      )}
      {sky === "studio" && <path d="M0 29q20 5 40 0v4a7 7 0 0 1-7 7H7a7 7 0 0 1-7-7Z" fill="rgb(0 0 0 / 10%)" />}
    </svg>
  );
}

const GROUNDS: Record<Ground, string> = {
  grass: "#7f9f58",
  earth: "#8a6a4c",
  sand: "#dcc596",
  snow: "#eef3f7",
  plain: "transparent",
};

/** What a tree stands on. */
export function GroundPicture({ ground }: { ground: Ground }) {
  return (
    <svg viewBox="0 0 40 40" aria-hidden="true">
      <ellipse cx="20" cy="26" rx="18" ry="9" fill={GROUNDS[ground]} stroke="rgb(60 60 60 / 22%)" />
      {ground === "grass" && (
        <path
          d="M8 26l-1-6M11 29l0-7M15 26l2-6M20 30v-7M24 26l-1-6M28 29l2-7M32 26l0-6"
          stroke="#55783a"
          stroke-width="1.8"
          stroke-linecap="round"
        />
      )}
      {ground === "earth" && (
        <path
          d="M10 24h3M17 29h4M24 23h3M29 28h3M14 31h2"
          stroke="rgb(50 32 18 / 60%)"
          stroke-width="2"
          stroke-linecap="round"
        />
      )}
      {ground === "sand" && (
        <path
          d="M5 24q7-3 13 0t13 0M9 29q6-3 11 0t11-1"
          fill="none"
          stroke="rgb(150 115 60 / 55%)"
          stroke-width="1.4"
        />
      )}
      {ground === "snow" && <path d="M7 24q6-5 12-1 7-4 13 1" fill="none" stroke="#c3d3e0" stroke-width="1.6" />}
      {ground === "plain" && <ellipse cx="20" cy="26" rx="9" ry="4" fill="rgb(40 40 40 / 26%)" />}
      <path d="M20 26V12" stroke="#7d6a55" stroke-width="3" stroke-linecap="round" />
      <circle cx="20" cy="10" r="6.5" fill="#6fae5c" />
    </svg>
  );
}
