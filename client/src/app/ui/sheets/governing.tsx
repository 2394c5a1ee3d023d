import { useCallback, useEffect, useState } from "preact/hooks";
import {
  type GuestHere,
  KEPT_OUT_HOURS,
  type KeptOut,
  type LinkRole,
  type Person,
  ROLES,
} from "../../../wire/generated";
import { changeLink } from "../../library/links/link-api";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import * as api from "../../together/governing-api";
import { momentText } from "../../words/date-text";
import { say } from "../../words/say";
import { ConfirmRow } from "./confirm-row";
import { LinkRoles } from "./share/link-roles";

export interface GoverningNow {
  /** Who is kept out. */
  readonly removals: readonly KeptOut[];
  /** To whom the tree was handed over. */
  readonly heir: string | undefined;
  /** Who of those here came by a link; null while nobody knows. */
  readonly guests: readonly GuestHere[] | null;
  readonly look: () => Promise<void>;
  readonly letDo: (guest: GuestHere, role: LinkRole) => Promise<void>;
  readonly letBack: (removal: KeptOut) => Promise<void>;
  readonly takeBack: () => Promise<void>;
}

/** Who is kept out of the open tree and to whom it was handed over, for whoever may say so. */
export function useGoverning(studio: Studio): GoverningNow {
  const [removals, setRemovals] = useState<readonly KeptOut[]>([]);
  const [heir, setHeir] = useState<string | undefined>();
  const [guests, setGuests] = useState<readonly GuestHere[] | null>(null);
  const { link, rights, together } = studio;
  const session = link.session.value ?? "";
  const look = useCallback(async () => {
    if (!rights.mayGovern) {
      return;
    }
    await told(studio, async () => {
      const asked = [api.listRemovals(session), api.findOwner(session), api.listGuests(session)] as const;
      const [removals, owner, guests] = await Promise.all(asked);
      setRemovals(removals);
      setHeir(owner.name);
      setGuests(guests);
    });
  }, [studio, rights, session]);
  // Whoever comes or goes may have been removed, or let back, by another owner.
  useEffect(() => together.people.subscribe(() => void look()), [together, look]);
  const letDo = async ({ tree, link }: GuestHere, role: LinkRole) => {
    await told(studio, () => changeLink(tree, link.id, role));
    await look();
  };
  const letBack = async ({ id }: KeptOut) => {
    await told(studio, () => api.letBack(session, id));
    await look();
  };
  const takeBack = async () => {
    await told(studio, () => api.handOver(session, null));
    await look();
  };
  return { removals, heir, guests, look, letDo, letBack, takeBack };
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
  readonly governing: GoverningNow;
}

/**
 * Lets somebody who is here do more or less, which holds at once; hands the tree over to them, or removes them, each of
 * which is asked about once. Owners are left alone.
 */
export function PersonActs({ studio, person: { person, role }, name, governing }: PersonActsProps) {
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
    await governing.look();
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
  const guest = governing.guests?.find((guest) => guest.person === person);
  return (
    <>
      {governing.guests !== null && !guest && <p class="quiet">{say("together.role.elsewhere")}</p>}
      <div class="person-acts">
        {guest && <LinkRoles link={{ ...guest.link, name }} onChange={(role) => governing.letDo(guest, role)} />}
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
    </>
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
