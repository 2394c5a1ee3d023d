import type { Studio } from "../studio";
import { PeopleIcon } from "./icons";

/** How things stand, in as few words as possible. */
export function Status({ studio }: { studio: Studio }) {
  const document = studio.document.value;
  const phase = studio.phase.value;
  const attempts = studio.attempts.value;
  const people = document?.people ?? 1;
  const full = document?.budget_reached === true;
  const away = phase !== "connected" && studio.hindrance.value === null && studio.session.value !== null;
  const unsent = studio.sent.value - studio.settled.value;
  return (
    <div class="status" role="status">
      {away && (
        <p class="note away" key={attempts === 0 ? "first" : "again"}>
          <i class="pulse" />
          {attempts === 0 ? "Connecting…" : `Reconnecting… (try ${attempts})`}
          {attempts > 0 && unsent > 0 && <span class="quiet">your strokes are kept</span>}
        </p>
      )}
      {full && <p class="note full">The tree has all the growth this document holds. Undo or ungrow to draw on.</p>}
      {document && (
        <p class="figures">
          {people > 1 && (
            <span title={`${people} people have this tree open`}>
              <PeopleIcon />
              {people}
            </span>
          )}
          <span title="Living metamers: internodes with their buds and leaves">
            {document.metamers.toLocaleString()} {document.metamers === 1 ? "metamer" : "metamers"}
          </span>
        </p>
      )}
    </div>
  );
}
