import type { ComponentType } from "preact";
import { useEffect } from "preact/hooks";
import { reload } from "../page/replaced";
import type { Studio } from "../studio";
import { say } from "../words/say";
import type { Part } from "./part";

/** What a part that is shown gets. */
export type StudioView = ComponentType<{ readonly studio: Studio }>;

interface PartViewProps {
  readonly studio: Studio;
  readonly part: Part<StudioView>;
  /** About how high it will be, as CSS has it, so that little moves when it comes. */
  readonly height?: string;
}

/** A part of the page; until it is there, its place; where it does not come, the reason and a way on. */
export function PartView({ studio, part, height }: PartViewProps) {
  useEffect(() => void part.open(), [part]);
  const Content = part.content.value;
  const failure = part.failure.value;
  if (Content !== null) {
    return <Content studio={studio} />;
  }
  return (
    <div class="part" style={{ minBlockSize: height }} aria-busy={failure === null}>
      {failure === null ? (
        <i class="spinner" role="status" aria-label={say("notices.part-loading")} />
      ) : (
        <>
          <p role="alert">{say(`notices.part-${failure}`)}</p>
          {failure === "lost" ? (
            <button type="button" class="primary" onClick={() => part.again()}>
              {say("notices.part-again")}
            </button>
          ) : (
            <button type="button" class="primary" onClick={reload}>
              {say("notices.reload")}
            </button>
          )}
        </>
      )}
    </div>
  );
}
