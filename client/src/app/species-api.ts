import type { Species } from "../wire/generated";
import { askFor, RequestFailed } from "./library-api";

/** The species a server knows; none where it knows of no species. */
export async function listSpecies(): Promise<readonly Species[]> {
  try {
    const response = await askFor("GET", "/api/species");
    return (await response.json()) as Species[];
  } catch (error) {
    if (error instanceof RequestFailed && error.status !== 0) {
      return [];
    }
    throw error;
  }
}

/** Whether the parameters in force are a species' own. */
export function isGrown(species: Species, parameters: object): boolean {
  const now = new Map<string, unknown>(Object.entries(parameters));
  return Object.entries(species.parameters).every(([name, value]) => {
    const other = now.get(name);
    // Numbers travel as 32-bit floats.
    return typeof value === "number" && typeof other === "number"
      ? Math.abs(value - other) <= 1e-5 * Math.max(1, Math.abs(value))
      : value === other;
  });
}
