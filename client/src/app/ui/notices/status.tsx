import { useMemo } from "preact/hooks";
import { measuresOf } from "../../../scene/table/measures";
import type { Studio } from "../../studio";
import { countHere } from "../../together/count-here";
import { countText, metresText, yearsText } from "../../words/measure-text";
import { say } from "../../words/say";
import { PeopleIcon } from "../icons";

/** How things stand, in as few words as possible. */
export function Status({ studio }: { studio: Studio }) {
  const document = studio.document.value;
  const phase = studio.link.phase.value;
  const attempts = studio.link.attempts.value;
  const people = countHere(studio.together.people.value, document?.people ?? 1);
  const full = document?.budget_reached === true;
  const away = phase !== "connected" && studio.hindrance.value === null && studio.link.session.value !== null;
  const loading = studio.link.loading.value;
  const garbled = studio.link.garbled.value > 1;
  const unsent = studio.link.sent.value - studio.link.settled.value;
  return (
    <div class="status" role="status">
      {away && (
        <p class="note away" key={attempts === 0 ? "first" : "again"}>
          <i class="pulse" />
          {loading !== null
            ? say("notices.loading", { percent: `${Math.round(100 * loading)}` })
            : attempts === 0
              ? say("notices.connecting")
              : garbled
                ? say("notices.garbled")
                : say("notices.reconnecting", { attempt: attempts })}
          {loading !== null && <progress max={1} value={loading} />}
          {attempts > 0 && unsent > 0 && <span class="quiet">{say("notices.kept")}</span>}
        </p>
      )}
      {!studio.rights.mayChange.value && studio.link.session.value !== null && !studio.link.replaying.value && (
        <p class="note">{say(studio.rights.mayComment ? "notices.comment-only" : "notices.looking-only")}</p>
      )}
      {studio.link.heldUp.value && <p class="note">{say("notices.held-up")}</p>}
      {full && <p class="note full">{say("notices.full")}</p>}
      {document && (
        <p class="figures">
          {people > 1 && (
            <span title={say("notices.people", { count: people })}>
              <PeopleIcon />
              {people}
            </span>
          )}
          <span title={say("notices.metamers.title")}>
            {say(document.metamers === 1 ? "notices.metamer" : "notices.metamers", {
              count: countText(document.metamers),
            })}
          </span>
          <Size studio={studio} />
        </p>
      )}
    </div>
  );
}

/** How high, wide and old the trees are, as trees are measured. */
function Size({ studio }: { studio: Studio }) {
  const revision = studio.revision.value;
  const measures = useMemo(() => measuresOf(studio.table), [studio, revision]);
  const internode = studio.parameters.value?.internode_length;
  if (measures === null || internode === undefined) {
    return null;
  }
  const metres = (internodes: number) => metresText(internodes * internode);
  return (
    <span class="size" data-place="size" title={say("notices.size.title")}>
      {/* A design has not grown. */}
      {say(measures.age > 0 ? "notices.size" : "notices.size.ageless", {
        height: metres(measures.height),
        spread: metres(measures.spread),
        age: yearsText(measures.age),
      })}
    </span>
  );
}
