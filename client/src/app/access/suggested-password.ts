/** Without those that are taken for one another when they are read out. */
const LETTERS = "abcdefghijkmnpqrstuvwxyz23456789";
const PARTS = 4;
const LETTERS_A_PART = 4;

/** A password that can be read out and that nobody guesses: 16 letters and digits, 80 bits. */
export function suggestedPassword(random = crypto.getRandomValues(new Uint8Array(PARTS * LETTERS_A_PART))): string {
  const letters = [...random].map((byte) => LETTERS[byte % LETTERS.length]).join("");
  return letters.match(/.{4}/g)?.join("-") ?? letters;
}
