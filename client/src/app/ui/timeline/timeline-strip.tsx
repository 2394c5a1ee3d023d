import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Timeline, TimelineOperation } from "../../../wire/generated";
import { authorColour, authorName, distinctParts, partsOf } from "../../document/timeline/authors";
import { ownDeeds } from "../../document/timeline/own-deeds";
import { clusters, peopleOf } from "../../document/timeline/timeline-signs";
import type { Studio } from "../../studio";
import { personHere } from "../../together/person-here";
import type { Together } from "../../together/together";
import { say } from "../../words/say";
import { DEPTH } from "./depth-part";
import { isWorthShowing } from "./has-timeline";
import { stepsOf } from "./step-count";
import { Forks } from "./timeline-forks";
import { BackIcon, FoldIcon, ForthIcon, PlayIcon, sortOf, TimeIcon } from "./timeline-icons";
import { useScrubbing } from "./use-scrubbing";

/** Signs nearer to each other than this, in pixels, become one. */
const ROOM = 32;

/** The line of time along the bottom: what was done, and where in it the tree is now. */
export function TimelineStrip({ studio }: { studio: Studio }) {
  const timeline = studio.time.timeline.value;
  const { timelineOpen } = studio.settings;
  if (!isWorthShowing(timeline)) {
    return null;
  }
  if (!studio.rights.mayChange.value) {
    // Who only looks does not travel, and may see how it came about.
    return <ReplayButton studio={studio} isAlone />;
  }
  if (!timelineOpen.value) {
    return (
      <button
        type="button"
        class="panel tool timeline-tab"
        aria-label={say("timeline.show")}
        title={say("timeline.show.title")}
        aria-expanded={false}
        onClick={() => {
          timelineOpen.value = true;
        }}
      >
        <TimeIcon />
      </button>
    );
  }
  const step = studio.time.step;
  return (
    <section class="panel timeline" data-place="timeline" aria-label={say("timeline.label")}>
      <button
        type="button"
        class="tool"
        aria-label={say("timeline.hide")}
        title={say("timeline.hide")}
        aria-expanded={true}
        onClick={() => {
          timelineOpen.value = false;
        }}
      >
        <FoldIcon />
      </button>
      <button
        type="button"
        class="tool"
        aria-label={say("timeline.back")}
        title={say("timeline.back.title")}
        aria-disabled={step <= 0}
        onClick={() => studio.time.by(-1)}
      >
        <BackIcon />
      </button>
      <Track studio={studio} timeline={timeline} />
      <button
        type="button"
        class="tool"
        aria-label={say("timeline.forth")}
        title={say("timeline.forth.title")}
        aria-disabled={step >= timeline.last_step}
        onClick={() => studio.time.by(1)}
      >
        <ForthIcon />
      </button>
      {studio.grammar.inForce.value !== null && <Depth studio={studio} />}
      <ReplayButton studio={studio} />
    </section>
  );
}

/** The depth of the grammar in force, once what sets it is there. */
function Depth({ studio }: { studio: Studio }) {
  useEffect(() => void DEPTH.open(), []);
  const DepthStepper = DEPTH.content.value;
  return DepthStepper && <DepthStepper studio={studio} />;
}

function ReplayButton({ studio, isAlone = false }: { studio: Studio; isAlone?: boolean }) {
  return (
    <button
      type="button"
      class={isAlone ? "panel tool timeline-tab" : "tool"}
      aria-label={say("replay.open")}
      title={say("replay.open.title")}
      onClick={() => studio.link.replay(true)}
    >
      <PlayIcon />
    </button>
  );
}

export function Track({ studio, timeline }: { studio: Studio; timeline: Timeline }) {
  const track = useRef<HTMLDivElement>(null);
  const width = useWidth(track);
  const scrubbing = useScrubbing(studio, track);
  const scale = studio.time.scale.value;
  const step = studio.time.step;
  // While the user has it the playhead stands under the finger, and not at the step nearest to it.
  const place = scrubbing.place ?? scale.placeOf(step);
  const looked = scrubbing.looked ?? (scrubbing.shown ? operationAtStep(timeline, step) : null);
  return (
    <div class="timeline-track">
      <div
        class="timeline-way"
        ref={track}
        role="slider"
        tabIndex={0}
        aria-label={say("timeline.time")}
        aria-valuemin={0}
        aria-valuemax={timeline.last_step}
        aria-valuenow={step}
        aria-valuetext={speech(timeline, step, studio.together)}
        data-pulled={scrubbing.place !== null}
        data-says-what
        {...scrubbing.handlers}
      >
        <span class="timeline-rail">
          <span class="timeline-lived" style={{ width: `${100 * place}%` }} />
        </span>
        {width > 0 && <Signs studio={studio} timeline={timeline} width={width} />}
        <Marks studio={studio} timeline={timeline} edges={scale.edges} step={step} />
        <span class="timeline-head" style={{ left: `${100 * place}%` }} />
      </div>
      {width > 0 && studio.rights.mayChange.value && <Forks studio={studio} width={width} />}
      {(scrubbing.shown || scrubbing.looked !== null) && (
        <Bubble
          studio={studio}
          timeline={timeline}
          operation={looked}
          place={scrubbing.looked === null ? place : middle(scale.edges, scrubbing.looked)}
          step={scrubbing.looked === null ? step : null}
        />
      )}
    </div>
  );
}

/** Each operation as a sign in its author's colour; where there are too many, one sign for several. */
function Signs({ studio, timeline, width }: { studio: Studio; timeline: Timeline; width: number }) {
  const scale = studio.time.scale.value;
  const people = peopleOf(timeline);
  return (
    <>
      {clusters(scale, width, ROOM).map(({ from, to, x }) => {
        const all = timeline.operations.slice(from, to + 1);
        const isOneKind = all.every(({ kind }) => kind === all[0]?.kind);
        const authors = new Set(all.flatMap(partsOf).map(({ author }) => author));
        const first = timeline.operations[from];
        if (!first) {
          return null;
        }
        const { Icon } = sortOf(first.kind);
        const count = to - from + 1;
        return (
          <span
            class="timeline-sign"
            key={from}
            data-undone={from >= timeline.done}
            data-away={all.every(({ away }) => away)}
            style={{
              left: `${x}px`,
              "--author": authors.size === 1 ? authorColour(first.author, people) : "var(--quiet)",
            }}
          >
            {isOneKind && <Icon />}
            {count > 1 && <b data-alone={!isOneKind}>{count}</b>}
          </span>
        );
      })}
    </>
  );
}

interface MarksProps {
  readonly studio: Studio;
  readonly timeline: Timeline;
  readonly edges: readonly number[];
  readonly step: number;
}

/** Where undo would go, and where redo; on a line of several people, what of one's own they would take back or bring back. */
function Marks({ studio, timeline, edges, step }: MarksProps) {
  const { done, operations } = timeline;
  const { isAlone, back, forth } = ownDeeds(timeline, personHere(studio.together.people.value));
  const current = operations[done - 1];
  const redone = current && step < current.last ? done : done + 1;
  const places = isAlone
    ? { undo: done > 0 ? edges[done - 1] : undefined, redo: edges[redone] }
    : {
        undo: back === null ? undefined : middle(edges, back),
        redo: forth === null ? undefined : middle(edges, forth),
      };
  return (
    <>
      {(["undo", "redo"] as const).map(
        (to) =>
          places[to] !== undefined && (
            <i key={to} class="timeline-mark" data-to={to} style={{ left: `${100 * places[to]}%` }} />
          ),
      )}
    </>
  );
}

interface BubbleProps {
  readonly studio: Studio;
  readonly timeline: Timeline;
  readonly operation: number | null;
  readonly place: number;
  /** The step the playhead is at; null if an operation is only looked at. */
  readonly step: number | null;
}

/** What was done here, by whom, and which step this is. */
function Bubble({ studio, timeline, operation, place, step }: BubbleProps) {
  const done = operation === null ? undefined : timeline.operations[operation];
  const people = peopleOf(timeline);
  const sort = done && sortOf(done.kind);
  const bubble = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => keepOver(bubble.current, place));
  return (
    <div class="timeline-bubble" ref={bubble} aria-hidden="true">
      {done && sort && (
        <span class="timeline-what">
          <sort.Icon />
          {say(sort.name)}
          {people > 1 &&
            distinctParts(done).map(({ author, away }) => (
              <em key={author} data-away={away} style={{ "--author": authorColour(author, people) }}>
                {authorName(author, studio.together)}
              </em>
            ))}
        </span>
      )}
      <span class="timeline-when">
        {step === null && done
          ? stepsOf(done.last - done.first)
          : say("timeline.step", { step: step ?? timeline.step })}
      </span>
    </div>
  );
}

/** What is left between a bubble and the edge of the workspace, in pixels. */
const EDGE = 8;

/** Puts a bubble over its place on the strip, as far as the workspace reaches. */
function keepOver(bubble: HTMLElement | null, place: number): void {
  const [track, workspace] = [bubble?.parentElement, bubble?.closest(".workspace")];
  if (!bubble || !track || !workspace) {
    return;
  }
  const [strip, all] = [track.getBoundingClientRect(), workspace.getBoundingClientRect()];
  const over = strip.left + place * strip.width - bubble.offsetWidth / 2;
  const left = Math.max(all.left + EDGE, Math.min(over, all.right - EDGE - bubble.offsetWidth));
  bubble.style.left = `${left - strip.left}px`;
}

function useWidth(element: { readonly current: HTMLElement | null }): number {
  const [width, setWidth] = useState(0);
  useEffect(() => {
    if (!element.current) {
      return undefined;
    }
    const observer = new ResizeObserver(([entry]) => setWidth(entry?.contentRect.width ?? 0));
    observer.observe(element.current);
    return () => observer.disconnect();
  }, [element]);
  return width;
}

function speech(timeline: Timeline, step: number, together: Together): string {
  const at = operationAtStep(timeline, step);
  const operation = at === null ? undefined : timeline.operations[at];
  const where = { step, last: timeline.last_step };
  if (!operation) {
    return say("timeline.step-of", where);
  }
  const what = say(sortOf(operation.kind).name);
  return peopleOf(timeline) > 1
    ? say("timeline.step-of.who", { ...where, what, who: namesOf(operation, together) })
    : say("timeline.step-of.what", { ...where, what });
}

function namesOf(operation: TimelineOperation, together: Together): string {
  return distinctParts(operation)
    .map(({ author }) => authorName(author, together))
    .join(", ");
}

/** The operation that led to a step. */
export function operationAtStep({ operations, done }: Timeline, step: number): number | null {
  for (let i = operations.length - 1; i >= 0; i -= 1) {
    const { first, last } = operations[i] ?? { first: 0, last: 0 };
    if (first < last ? first < step : first < step || (first === step && i < done)) {
      return i;
    }
  }
  return null;
}

function middle(edges: readonly number[], operation: number): number {
  return ((edges[operation] ?? 0) + (edges[operation + 1] ?? 1)) / 2;
}
