import { type Key, say } from "../../../words/say";

const SEASONS = ["spring", "summer", "autumn", "winter"] as const;
type Season = (typeof SEASONS)[number];

/** Colours of the crown's puffs, those behind first; in winter there is none. */
const CROWNS: Record<Season, readonly string[]> = {
  spring: ["#a9cf72", "#c4df8d", "#f2cfd9"],
  summer: ["#3f7a39", "#57954a", "#6fae5c"],
  autumn: ["#b4562a", "#d98a2b", "#e8b23f"],
  winter: [],
};

const PUFFS = [
  [13, 17, 7.5],
  [24, 16, 8],
  [18, 10.5, 7.5],
] as const;

/** The name of the season a number is nearest to: 0 spring, 1 summer, 2 autumn, 3 winter. */
export function seasonName(season: number): string {
  const name = SEASONS[Math.min(3, Math.max(0, Math.round(season)))] ?? "summer";
  return say(`leaves.season.${name}` as Key);
}

interface SeasonButtonsProps {
  readonly season: number;
  readonly pick: (season: number) => void;
}

/** Four little trees under the slider, one a season; each goes there. */
export function SeasonButtons({ season, pick }: SeasonButtonsProps) {
  return (
    <div class="seasons">
      {SEASONS.map((name, place) => (
        <button
          type="button"
          key={name}
          title={seasonName(place)}
          aria-label={seasonName(place)}
          aria-pressed={Math.abs(season - place) < 0.01}
          onClick={() => pick(place)}
        >
          <Tree season={name} />
        </button>
      ))}
    </div>
  );
}

function Tree({ season }: { season: Season }) {
  return (
    <svg viewBox="0 0 36 36" aria-hidden="true">
      <path
        d="M18 34V15M18 25l-6-7M18 22l6.5-8M18 17l-3-7M18 17l3.5-8M12 18l-4-2M24.5 14l4 0"
        fill="none"
        stroke="#7d6a55"
        stroke-width="2"
        stroke-linecap="round"
      />
      {PUFFS.map(([x, y, radius], i) => {
        const fill = CROWNS[season][i];
        return fill && <circle key={fill} cx={x} cy={y} r={season === "spring" ? radius - 2.2 : radius} fill={fill} />;
      })}
      {season === "winter" && <path d="M6 34h24" stroke="#c9d6de" stroke-width="2.5" stroke-linecap="round" />}
    </svg>
  );
}
