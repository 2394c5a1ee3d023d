import { laterWords } from "../words/later-words";

/** The sentence that a user reads about an error; in the server's own words where the page cannot load better ones. */
export async function explained(error: unknown): Promise<string> {
  try {
    return (await plainWords()).sentence(error);
  } catch {
    return error instanceof Error ? error.message : String(error);
  }
}

/** The module with the words for what a server says, and the texts it needs. */
export async function plainWords() {
  const [words] = await Promise.all([import("./plain-words"), laterWords()]);
  return words;
}
