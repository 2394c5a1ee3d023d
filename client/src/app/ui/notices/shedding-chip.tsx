import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type YoungShedding, youngShedding } from "../../document/growth/young-shedding";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";

/** The session in which it was read that a young tree sheds what is drawn. */
const readIn = signal<string | null>(null);

/** Says after a stroke or an outline that the programme's young stage will shed it, once in each session. */
export function SheddingChip({ studio }: { studio: Studio }) {
  const session = studio.link.session.value;
  const shedding = session === null || readIn.value === session ? null : sheddingOfDrawn(studio);
  return shedding && <Sentence studio={studio} shedding={shedding} session={session} />;
}

/** The young stage that will shed what was done last, if that was drawn. */
function sheddingOfDrawn(studio: Studio): YoungShedding | null {
  const { operations = [], done = 0 } = studio.time.timeline.value ?? {};
  const [inForce, now] = [studio.programme.inForce.value, studio.parameters.value];
  const last = operations[done - 1]?.kind;
  return inForce !== null && now !== null && (last === "stroke" || last === "lasso")
    ? youngShedding(inForce, studio.document.value?.age ?? 0, now)
    : null;
}

interface SentenceProps {
  readonly studio: Studio;
  readonly shedding: YoungShedding;
  readonly session: string | null;
}

function Sentence({ studio, shedding: { until, later }, session }: SentenceProps) {
  const read = () => {
    readIn.value = session;
  };
  // Once it no longer holds it has been there to be read.
  useEffect(() => read, [session]);
  return (
    <p class="chip" data-shedding={until}>
      <span>{say("chips.shedding", { age: until })}</span>
      <button
        type="button"
        class="chip-stop"
        title={say("chips.shedding.keep.title")}
        onClick={() => studio.submit({ kind: "set_parameters", parameters: { shedding_threshold: later } })}
      >
        {say("chips.shedding.keep")}
      </button>
      <button type="button" aria-label={say("chips.slow.close")} title={say("chips.slow.close")} onClick={read}>
        <CloseIcon />
      </button>
    </p>
  );
}
