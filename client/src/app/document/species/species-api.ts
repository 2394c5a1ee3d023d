import type { Species } from "../../../wire/generated";
import { askFor, RequestFailed } from "../../requests/request";

/** The species a server knows; none where it knows of no species. */
export async function listSpecies(): Promise<readonly Species[]> {
  try {
    const response = await askFor("GET", "/api/v1/species");
    return (await response.json()) as Species[];
  } catch (error) {
    if (error instanceof RequestFailed && error.status === 404) {
      return [];
    }
    throw error;
  }
}

/** Where a picture of a grown tree of a species is. */
export function pictureOf(slug: string): string {
  return `/api/v1/species/${encodeURIComponent(slug)}/picture`;
}
