import { useCallback, useEffect, useState } from "preact/hooks";
import { KEPT_OUT_HOURS, type KeptOut, type Person, ROLES } from "../../../wire/generated";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import * as api from "../../together/governing-api";
import { momentText } from "../../words/date-text";
import { say } from "../../words/say";
import { ConfirmRow } from "./confirm-row";

interface GoverningNow {
  /** Who is kept out. */
  readonly removals: readonly KeptOut[];
  /** To whom the tree was handed over. */
  readonly heir: string | undefined;
  readonly look: () => Promise<void>;
  readonly letBack: (removal: KeptOut) => Promise<void>;
  readonly takeBack: () => Promise<void>;
}

/** Who is kept out of the open tree and to whom it was handed over, for whoever may say so. */
export function useGoverning(studio: Studio): GoverningNow {
  const [removals, setRemovals] = useState<readonly KeptOut[]>([]);
  const [heir, setHeir] = useState<string | undefined>();
  const { link, rights, together } = studio;
  const session = link.session.value ?? "";
  const look = useCallback(async () => {
    if (!rights.mayGovern) {
      return;
    }
    await told(studio, async () => {
      const [removals, owner] = await Promise.all([api.listRemovals(session), api.findOwner(session)]);
      setRemovals(removals);
      setHeir(owner.name);
    });
  }, [studio, rights, session]);
  // Whoever comes or goes may have been removed, or let back, by another owner.
  useEffect(() => together.people.subscribe(() => void look()), [together, look]);
  const letBack = async ({ id }: KeptOut) => {
    await told(studio, () => api.letBack(session, id));
    await look();
  };
  const takeBack = async () => {
    await told(studio, () => api.handOver(session, null));
    await look();
  };
  return { removals, heir, look, letBack, takeBack };
}

/** Who was removed, to let them back; and to whom the tree was handed over. */
export function Governing({ governing }: { readonly governing: GoverningNow }) {
  const { removals, heir } = governing;
  return (
    <>
      {heir !== undefined && (
        <div class="actions" data-heir={heir}>
          <p class="quiet">{say("together.heir", { name: heir })}</p>
          <button type="button" class="small" onClick={() => void governing.takeBack()}>
            {say("together.take-back")}
          </button>
        </div>
      )}
      {removals.length > 0 && (
        <section aria-label={say("together.kept-out")}>
          <h3 class="sheet-head">{say("together.kept-out")}</h3>
          <ul class="people">
            {removals.map((removal) => (
              <li key={removal.id} data-removed={removal.name}>
                <div>
                  <strong>{removal.name}</strong>
                  <p class="person-device">
                    <span class="quiet">
                      {say("together.kept-out.one", { by: removal.by, until: momentText(removal.until) })}
                    </span>
                    <button
                      type="button"
                      class="small"
                      aria-label={say("together.let-back.which", { name: removal.name })}
                      onClick={() => void governing.letBack(removal)}
                    >
                      {say("together.let-back")}
                    </button>
                  </p>
                </div>
              </li>
            ))}
          </ul>
        </section>
      )}
    </>
  );
}

interface PersonActsProps {
  readonly studio: Studio;
  readonly person: Person;
  readonly name: string;
  readonly onDone: () => Promise<void>;
}

/** Hands the tree over to somebody who is here, or removes them; each is asked about once. Owners are left alone. */
export function PersonActs({ studio, person: { person, role }, name, onDone }: PersonActsProps) {
  const [asks, setAsks] = useState<"remove" | "hand-over" | null>(null);
  const session = studio.link.session.value ?? "";
  if (ROLES.indexOf(role) >= ROLES.indexOf("owner")) {
    return null;
  }
  const remove = async () => {
    await told(studio, async () => {
      const { until } = await api.removePerson(session, person);
      const words =
        until === undefined
          ? say("together.removed.guest", { name })
          : say("together.removed", { name, until: momentText(until) });
      studio.toasts.show(words);
    });
  };
  const handOver = async () => {
    await told(studio, async () => {
      await api.handOver(session, person);
      studio.toasts.show(say("together.handed-over", { name }));
    });
    await onDone();
  };
  if (asks !== null) {
    return (
      <ConfirmRow
        question={say(`together.${asks}.sure`, { hours: KEPT_OUT_HOURS })}
        act={say(`together.${asks}`)}
        onAct={asks === "remove" ? remove : handOver}
        onKeep={() => setAsks(null)}
      />
    );
  }
  return (
    <div class="person-acts">
      {(["hand-over", "remove"] as const).map((act) => (
        <button
          key={act}
          type="button"
          class="small"
          aria-label={say(`together.${act}.which`, { name })}
          onClick={() => setAsks(act)}
        >
          {say(`together.${act}`)}
        </button>
      ))}
    </div>
  );
}

/** Does something that may be refused, and says so. */
async function told(studio: Studio, act: () => Promise<unknown>): Promise<void> {
  try {
    await act();
  } catch (error) {
    studio.toasts.show(await explained(error));
  }
}
