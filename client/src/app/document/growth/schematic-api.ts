import type { Parameters, Schematic } from "../../../wire/generated";
import { askFor } from "../../requests/request";

/** A server that is slower than this has lost the question, in milliseconds; by itself it gives up sooner. */
const PATIENCE = 5000;

/** A small flat tree that the server grows with some parameters (`SC1`). */
export async function growSchematic(parameters: Parameters): Promise<Schematic> {
  const body = JSON.stringify(parameters);
  const asking = new AbortController();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => {
      asking.abort();
      reject(new DOMException("late", "TimeoutError"));
    }, PATIENCE);
  });
  const sent = { type: "application/json", body };
  const grown = askFor("POST", "/api/v1/schematic", sent, { signal: asking.signal }).then((answer) => answer.json());
  try {
    return (await Promise.race([grown, late])) as Schematic;
  } finally {
    clearTimeout(timer);
  }
}
