import { laterWords } from "../words/later-words";

/** The sentence that a user reads about an error; in the server's own words where the page cannot load better ones. */
export async function explained(error: unknown): Promise<string> {
  try {
    const [{ sentence }] = await Promise.all([import("./plain-words"), laterWords()]);
    return sentence(error);
  } catch {
    return error instanceof Error ? error.message : String(error);
  }
}
