/** What devices make of `-->` and `--` while they are typed, and arrows that can be typed at once. */
const MEANT: readonly (readonly [RegExp, string])[] = [
  [/[—–]+>|-[—–]>|[→⟶]/g, "-->"],
  [/—/g, "--"],
];
/** Lines in which words stand, where a dash is a dash. */
const WORDS = /^[ \t]*(?:title|about|author|lsystem)[ \t]*:|^[ \t]*(?:\/\/|\/\*|#)/i;

/** A text as it was typed, with the signs that were meant, and where the caret then stands. */
export function asMeant(text: string, caret: number): { text: string; caret: number } {
  let [at, moved] = [0, 0];
  const lines = text.split("\n").map((line) => {
    let meant = line;
    for (const [found, sign] of WORDS.test(line) ? [] : MEANT) {
      meant = meant.replace(found, (typed, place: number) => {
        moved += at + place < caret ? sign.length - typed.length : 0;
        return sign;
      });
    }
    at += line.length + 1;
    return meant;
  });
  const meant = lines.join("\n");
  return { text: meant, caret: meant === text ? caret : caret + moved };
}

/** Whether a text says how deep it is to be derived. */
export function saysDepth(text: string): boolean {
  return /^[ \t]*(?:derivation[ \t]+length|depth)[ \t]*:/im.test(text);
}

/** Whether a text leaves anything to chance. */
export function hasChance(text: string): boolean {
  const bare = text.replace(/\/\*[\s\S]*?\*\/|\/\/.*$/gm, "");
  return /\bn?ran\s*\(|-->\s*\(\s*[\d.]+\s*\)/m.test(bare) || hasProbability(bare);
}

/** Whether a rule ends in a colon and what stands for its probability; colons within brackets choose between numbers. */
function hasProbability(text: string): boolean {
  const inner = /\([^()\n]*\)/g;
  let outer = text;
  for (let before = ""; outer !== before; ) {
    before = outer;
    outer = outer.replace(inner, " x ");
  }
  return /-->.*:[ \t]*\S/m.test(outer);
}

/** What a text calls itself; files of other programs number their L-systems, which is no name. */
export function titleOf(text: string): string | null {
  const names = [...text.matchAll(/^[ \t]*(title|lsystem)[ \t]*:[ \t]*(\S.*)$/gim)].map(
    ([, header, name]) => [header?.toLowerCase(), name?.trim() ?? ""] as const,
  );
  const titled = names.find(([header]) => header === "title") ?? names.find(([, name]) => isName(name));
  return titled?.[1] ?? null;
}

/** Whether what a grammar is called says anything: a number alone does not. */
export function isName(name: string): boolean {
  return !/^[\d.]*$/.test(name.trim());
}

/** What to call a text in a list: its title, or else its first line. */
export function nameIn(text: string): string {
  return titleOf(text) ?? text.trim().split("\n", 1)[0] ?? "";
}

/** Whether a text asks for a space that was drawn by hand. */
export function asksSpace(text: string): boolean {
  return /\b(?:inside|exists)\s*\(\s*0\s*\)/.test(text);
}
