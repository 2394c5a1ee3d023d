import { useEffect, useMemo, useState } from "preact/hooks";
import { KEPT_OUT_HOURS, type LinkRole, type Person, ROLES } from "../../../wire/generated";
import { belongingOf } from "../../library/belonging";
import { LINK_ROLES } from "../../library/links/lasting";
import { changeLink } from "../../library/links/link-api";
import { sentence } from "../../problems/plain-words";
import type { Studio } from "../../studio";
import { Governing } from "../../together/governing";
import * as api from "../../together/governing-api";
import { momentText } from "../../words/date-text";
import { say } from "../../words/say";
import { RoleSelect } from "./accounts/role-select";
import { ConfirmRow } from "./confirm-row";

/** Who comes to the open tree, asked for as long as the list of who is here is open. */
export function useGoverning(studio: Studio): Governing {
  const { link, rights, together, toasts } = studio;
  const session = link.session.value ?? "";
  const governing = useMemo(() => {
    const failed = (error: unknown) => toasts.show(sentence(error));
    return new Governing({ session, api: { ...api, changeLink }, failed });
  }, [toasts, session]);
  const { mayGovern } = rights;
  useEffect(() => (mayGovern ? governing.follow(together.people) : undefined), [governing, mayGovern, together]);
  return governing;
}

/** Who was removed, to let them back; and to whom the tree was handed over. */
export function KeptOutAndHeir({ governing }: { readonly governing: Governing }) {
  const [removals, heir] = [governing.removals.value, governing.heir.value];
  return (
    <>
      {heir !== undefined && (
        <div class="actions" data-heir={heir}>
          <p class="quiet">{say("together.heir", { name: heir })}</p>
          <button type="button" class="small" onClick={() => void governing.handOver(null)}>
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
  readonly governing: Governing;
}

/**
 * Lets somebody who is here do more or less, which holds at once; hands the tree over to them, or removes them, each of
 * which is asked about once. Owners are left alone.
 */
export function PersonActs({ studio, person: { person, role }, name, governing }: PersonActsProps) {
  const [asks, setAsks] = useState<"remove" | "hand-over" | null>(null);
  if (ROLES.indexOf(role) >= ROLES.indexOf("owner")) {
    return null;
  }
  const { toasts } = studio;
  const remove = async () => {
    const removed = await governing.remove(person);
    if (removed !== null) {
      const { until } = removed;
      const guest = until === undefined;
      toasts.show(
        guest ? say("together.removed.guest", { name }) : say("together.removed", { name, until: momentText(until) }),
      );
    }
  };
  const handOver = async () => {
    if (await governing.handOver(person)) {
      toasts.show(say("together.handed-over", { name }));
    }
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
  const guests = governing.guests.value;
  const guest = guests?.find((guest) => guest.person === person);
  const isElsewhere = guests !== null && !guest;
  return (
    <>
      {isElsewhere && <p class="quiet">{say("together.role.elsewhere")}</p>}
      <div class="person-acts">
        {guest && (
          <RoleSelect
            label={say("accounts.role.of", { name })}
            roles={LINK_ROLES}
            chosen={guest.link.role as LinkRole}
            onChoose={(role) => void governing.letDo(guest, role)}
          />
        )}
        {isElsewhere && <ShareWithPeople studio={studio} />}
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

/** The way to what people were given who log in; a tree that is not saved has to be before. */
function ShareWithPeople({ studio }: { readonly studio: Studio }) {
  const { layout, link, toasts } = studio;
  const open = async () => {
    try {
      const of = await belongingOf(link.session.peek() ?? "");
      if (of === null) {
        layout.sheet.value = "share";
        return;
      }
      const { id, name } = of.tree;
      layout.given.value = { kind: "tree", id, name, from: "people" };
      layout.sheet.value = "gifts";
    } catch (error) {
      toasts.show(sentence(error));
    }
  };
  return (
    <button type="button" class="small" onClick={() => void open()}>
      {say("gifts.open")}
    </button>
  );
}
