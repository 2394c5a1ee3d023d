import { useEffect, useState } from "preact/hooks";

/** What is done sooner is not worth a word. */
const WORTH_A_WORD = 200;
/** A word stays so long after its cause, which may be about to come back: strokes grow in many short spurts. */
const STAYS = 300;

/** Whether something has been so for a while, or was until just now. */
export function useLasting(now: boolean): boolean {
  const [lasting, setLasting] = useState(false);
  useEffect(() => {
    const timer = setTimeout(() => setLasting(now), now ? WORTH_A_WORD : STAYS);
    return () => clearTimeout(timer);
  }, [now]);
  return lasting;
}
