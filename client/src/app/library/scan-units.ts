/** Units in which trees are measured, in metres. */
export const SCAN_UNITS = { m: 1, dm: 0.1, cm: 0.01, mm: 0.001, "mm/10": 0.0001, ft: 0.3048, in: 0.0254 } as const;
export type ScanUnit = keyof typeof SCAN_UNITS;

/** Of a file's lengths, and of its diameters where that is another: files seldom say either. */
export interface ScanUnits {
  readonly length: ScanUnit;
  readonly diameter: ScanUnit | "same";
}

export const METRES: ScanUnits = { length: "m", diameter: "same" };

/** How the names of files end whose units can be said. */
const SCANS: readonly string[] = ["csv", "mtg"];

/** Whether a file does not know its own units. */
export function isScan(ending: string): boolean {
  return SCANS.includes(ending);
}

/** What an address says of them; what is as usual is not said. */
export function fieldsOf({ length, diameter }: ScanUnits): Readonly<Record<string, string>> {
  return {
    ...(length === "m" ? {} : { unit: `${SCAN_UNITS[length]}` }),
    ...(diameter === "same" || diameter === length ? {} : { diameter_unit: `${SCAN_UNITS[diameter]}` }),
  };
}
