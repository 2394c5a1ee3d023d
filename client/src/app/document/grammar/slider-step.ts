/** So many steps a slider has at least. */
const STEPS = 200;
/** No step shows more digits than this. */
const DIGITS = 4;

/** The step of a slider: a round number, small enough for a smooth way and for the value that the text has. */
export function stepFor(from: number, to: number, value: number): number {
  const wanted = 10 ** Math.floor(Math.log10((to - from) / STEPS));
  const said = Math.max(...[from, to, value].map(digitsIn));
  const finest = 10 ** -Math.min(DIGITS, said);
  return Number(Math.max(10 ** -DIGITS, Math.min(wanted, said === 0 ? wanted : finest)).toPrecision(1));
}

/** How many digits a number has behind its point. */
function digitsIn(value: number): number {
  const [, part = ""] = value.toString().split(".");
  return part.length;
}
