/** A number that sets how trees sway. */
export interface AirNumber {
  readonly least: number;
  readonly most: number;
  readonly step: number;
  readonly unit: string;
  readonly standard: number;
}

/** Everything that sets how trees sway: a row for each, from which come its control, its check and where it begins. */
export const AIR_NUMBERS = {
  /** Mean wind 10 m above the ground. */
  speed: { least: 0, most: 25, step: 0.5, unit: "m/s", standard: 0 },
  /** Where the wind blows to, around the vertical from the world's x axis towards its z axis. */
  direction: { least: 0, most: 360, step: 5, unit: "°", standard: 0 },
  /** From an even wind to one that comes in gusts alone. */
  turbulence: { least: 0, most: 1, step: 0.05, unit: "", standard: 0.6 },
  /** How much leaves flutter beside what is usual. */
  flutter: { least: 0, most: 2, step: 0.1, unit: "", standard: 1 },
  /** How much more wood weighs than it grew under: 1 is its own weight once more. */
  sag: { least: 0, most: 1, step: 0.05, unit: "", standard: 0 },
  /** How much softer wood is than it swings in nature. */
  suppleness: { least: 0.2, most: 5, step: 0.1, unit: "", standard: 1 },
  /** How much sooner wood comes to rest than in nature. */
  damping: { least: 0.2, most: 5, step: 0.1, unit: "", standard: 1 },
} as const satisfies Record<string, AirNumber>;

export type AirName = keyof typeof AIR_NUMBERS;

/** How trees sway. */
export type AirSettings = Readonly<Record<AirName, number>>;

export const AIR_NAMES = Object.keys(AIR_NUMBERS) as readonly AirName[];

/** No wind, and trees as they grew. */
export const CALM: AirSettings = Object.fromEntries(
  AIR_NAMES.map((name) => [name, AIR_NUMBERS[name].standard]),
) as AirSettings;

/** Whether anything moves. */
export function blows({ speed, sag }: AirSettings): boolean {
  return speed > 0 || sag > 0;
}

/** Of anything, the numbers that may be set; all else is as it is before anybody has set it. */
export function airSettings(from: Readonly<Record<string, unknown>>): AirSettings {
  const within = (name: AirName): number => {
    const value = from[name];
    const { least, most, standard } = AIR_NUMBERS[name];
    return typeof value === "number" && value >= least && value <= most ? value : standard;
  };
  return Object.fromEntries(AIR_NAMES.map((name) => [name, within(name)])) as AirSettings;
}
