import { useRef, useState } from "preact/hooks";
import { authorColour, authorName } from "../../document/timeline/authors";
import { type Branching, forks, peopleOf } from "../../document/timeline/timeline-signs";
import type { Studio } from "../../studio";
import type { Together } from "../../together/together";
import { language, say } from "../../words/say";
import { useDismissal } from "../use-dismissal";
import { stepsOf } from "./step-count";
import { ForkIcon, sortOf } from "./timeline-icons";

/** Forks nearer to each other than a finger is wide become one. */
const ROOM = 44;
/** So many of a future's operations are shown as signs. */
const MOST_SIGNS = 6;

/** Where other futures branch off the line of time; a tap shows them. */
export function Forks({ studio, width }: { studio: Studio; width: number }) {
  const [open, setOpen] = useState<number | null>(null);
  const host = useRef<HTMLDivElement>(null);
  const timeline = studio.time.timeline.value;
  const found = forks(timeline?.futures ?? [], studio.time.scale.value, width, ROOM);
  const shown = found.find(({ futures }) => futures[0]?.future.future === open);
  const people = timeline ? peopleOf(timeline) : 0;
  useDismissal(host, open !== null, () => setOpen(null));
  return (
    <div class="timeline-forks" ref={host}>
      {found.map(({ x, futures }) => {
        const first = futures[0];
        const number = first?.future.future;
        return (
          first && (
            <button
              type="button"
              class="timeline-fork"
              key={number}
              style={{ left: `${x}px` }}
              aria-label={say(futures.length === 1 ? "timeline.future" : "timeline.futures.count", {
                count: futures.length,
              })}
              title={say("timeline.from-step", { step: first.leaves })}
              aria-expanded={open === number}
              onClick={() => setOpen(open === number ? null : (number ?? null))}
            >
              <ForkIcon />
              {futures.length > 1 && <b>{futures.length}</b>}
            </button>
          )
        );
      })}
      {shown && (
        <ul class="panel timeline-futures" style={{ "--place": shown.x / width }} aria-label={say("timeline.futures")}>
          {shown.futures.map((branching) => (
            <li key={branching.future.future} style={{ "--depth": branching.depth }}>
              <FutureButton
                branching={branching}
                people={people}
                together={studio.together}
                take={() => {
                  setOpen(null);
                  studio.time.take(branching.future.future);
                }}
              />
            </li>
          ))}
        </ul>
      )}
    </div>
  );
}

interface FutureProps {
  readonly branching: Branching;
  readonly people: number;
  readonly together: Together;
  readonly take: () => void;
}

function FutureButton({ branching: { future }, people, together, take }: FutureProps) {
  const { operations } = future;
  const authors = [...new Set(operations.map(({ author }) => author))];
  const left = operations.length - MOST_SIGNS;
  return (
    <button type="button" class="timeline-future" onClick={take}>
      <span class="timeline-signs">
        {operations.slice(0, MOST_SIGNS).map(({ kind, author }, i) => {
          const { Icon } = sortOf(kind);
          // Operations of a future stay in their order, so that a number names one.
          const key = `${future.future}-${i}`;
          return (
            <span class="timeline-sign" key={key} style={{ "--author": authorColour(author, people) }}>
              <Icon />
            </span>
          );
        })}
        {left > 0 && <b>+{left}</b>}
      </span>
      <span class="timeline-summary">
        {say(operations.length === 1 ? "timeline.summary.one" : "timeline.summary.many", {
          count: operations.length,
          steps: stepsOf(future.steps),
        })}
        <em>
          {people > 1 && authors.length > 0
            ? say("timeline.summary.by", {
                step: future.from,
                people: new Intl.ListFormat(language.value).format(
                  authors.map((author) => authorName(author, together)),
                ),
              })
            : say("timeline.summary.from", { step: future.from })}
        </em>
      </span>
    </button>
  );
}
