/** A piece of a text, and whether it is one of the words that were searched. */
export interface Piece {
  readonly text: string;
  readonly found: boolean;
}

/** A text in pieces, in which large and small letters and accents are alike, as they are to the server (`LB7`). */
export function pieces(text: string, words: string): readonly Piece[] {
  const letters = [...text];
  // Where each letter of the folded text comes from.
  const origins = letters.flatMap((letter, at) => [...folded(letter)].map(() => at));
  const plain = letters.map(folded).join("");
  const found = new Set<number>();
  for (const word of words.split(/\s+/).map(folded).filter(Boolean)) {
    for (let at = plain.indexOf(word); at >= 0; at = plain.indexOf(word, at + 1)) {
      // Positions in texts count units, of which some letters have two.
      const first = [...plain.slice(0, at)].length;
      for (const origin of origins.slice(first, first + [...word].length)) {
        found.add(origin);
      }
    }
  }
  const joined: { text: string; found: boolean }[] = [];
  for (const [at, letter] of letters.entries()) {
    const last = joined.at(-1);
    if (last?.found === found.has(at)) {
      last.text += letter;
    } else {
      joined.push({ text: letter, found: found.has(at) });
    }
  }
  return joined;
}

/** A text without the difference of large and small letters, and without accents. */
export function folded(text: string): string {
  return plain(plain(text).toLowerCase());
}

function plain(text: string): string {
  return text.normalize("NFKD").replace(/\p{M}/gu, "");
}
