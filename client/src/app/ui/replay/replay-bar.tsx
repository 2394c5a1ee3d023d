import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { authorColour, authorName, distinctParts } from "../../document/timeline/authors";
import { peopleOf } from "../../document/timeline/timeline-signs";
import { ReplayPlayer } from "../../replay/player";
import type { Studio } from "../../studio";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";
import { FilmIcon, PauseIcon, PlayIcon, sortOf } from "../timeline/timeline-icons";
import { operationAtStep, Track } from "../timeline/timeline-strip";
import { useDismissal } from "../use-dismissal";
import { RecordForm } from "./record-form";

/** Plays the design that the page is in a copy of: what is done now and by whom, the line of time, speed, and a recording. */
export function ReplayBar({ studio }: { studio: Studio }) {
  const player = useMemo(() => new ReplayPlayer(studio.time), [studio]);
  const recorder = useRef<HTMLDivElement>(null);
  const [asks, setAsks] = useState(false);
  useDismissal(recorder, asks, () => setAsks(false));
  const timeline = studio.time.timeline.value;
  useEffect(() => {
    if (timeline !== null) {
      player.stands();
    }
  }, [player, timeline]);
  // Once the tree as it stands is there, it is played without being asked for.
  const isThere = timeline !== null && studio.rows.value > 0;
  useEffect(() => {
    const look = studio.comments.lookBack;
    if (isThere && look) {
      studio.time.to(look.step);
      look.show();
    } else if (isThere && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
      player.play();
    }
    return () => player.pause();
  }, [studio, player, isThere]);
  useEffect(() => () => comeBack(studio), [studio]);
  useKeys(player);
  const playing = player.playing.value;
  const speed = numberText(player.speed.value, player.speed.value < 1 ? 0.1 : 1);
  return (
    <>
      {timeline && <Caption studio={studio} />}
      <section class="panel timeline replay" data-place="replay" aria-label={say("replay.label")}>
        <button
          type="button"
          class="tool"
          aria-label={say(playing ? "replay.pause" : "replay.play")}
          title={say(playing ? "replay.pause.title" : "replay.play.title")}
          onClick={() => player.toggle()}
        >
          {playing ? <PauseIcon /> : <PlayIcon />}
        </button>
        <div class="replay-track" onPointerDownCapture={() => player.pause()}>
          {timeline && <Track studio={studio} timeline={timeline} />}
        </div>
        <button
          type="button"
          class="tool replay-speed"
          aria-label={say("replay.speed.now", { speed })}
          title={say("replay.speed")}
          onClick={() => player.faster()}
        >
          {say("replay.times", { speed })}
        </button>
        <div class="replay-record" ref={recorder}>
          <button
            type="button"
            class="tool"
            aria-label={say("replay.record")}
            title={say("replay.record")}
            aria-expanded={asks}
            onClick={() => {
              player.pause();
              setAsks(!asks);
            }}
          >
            <FilmIcon />
          </button>
          {asks && <RecordForm studio={studio} player={player} onDone={() => setAsks(false)} />}
        </div>
        <button
          type="button"
          class="tool"
          aria-label={say("replay.close")}
          title={say("replay.close.title")}
          onClick={() => studio.link.replay(false)}
        >
          <CloseIcon />
        </button>
      </section>
    </>
  );
}

/** Who looked at a step for the sake of a comment sees that comment again. */
function comeBack({ comments, link }: Studio): void {
  const look = comments.lookBack;
  comments.lookBack = null;
  if (look !== null && look.session === link.session.peek()) {
    comments.open.value = look.thread;
  }
}

/** What is done at the step that is seen, and who did it. */
function Caption({ studio }: { studio: Studio }) {
  const timeline = studio.time.timeline.value;
  const step = studio.time.step;
  const at = timeline && operationAtStep(timeline, step);
  const done = timeline?.operations[at ?? -1];
  if (!timeline || !done) {
    return <p class="replay-caption">{say("replay.beginning")}</p>;
  }
  const sort = sortOf(done.kind);
  const people = peopleOf(timeline);
  return (
    <p class="replay-caption" style={{ "--author": authorColour(done.author, people) }}>
      <sort.Icon />
      {say(sort.name)}
      {distinctParts(done).map(({ author }) => (
        <em key={author} style={{ "--author": authorColour(author, people) }}>
          {authorName(author, studio.together)}
        </em>
      ))}
    </p>
  );
}

/** The space bar plays and pauses. */
function useKeys(player: ReplayPlayer): void {
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      const onButton = event.target instanceof Element && event.target.closest("button, input, select") !== null;
      if (event.key === " " && !onButton) {
        event.preventDefault();
        player.toggle();
      }
    };
    addEventListener("keydown", press, { capture: true });
    return () => removeEventListener("keydown", press, { capture: true });
  }, [player]);
}
