import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { Directory } from "../../../access/directory";
import * as peopleApi from "../../../access/people-api";
import { askEntrance } from "../../../entry/account";
import * as api from "../../../library/gifts/gift-api";
import { Gifts } from "../../../library/gifts/gifts";
import type { Given } from "../../../page/layout";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { BackBar } from "../library/back-bar";
import { GiftRow } from "./gift-row";
import { GiveForm } from "./give-form";

/** Gives a tree or a collection to people and groups who log in. */
export function GiftsSheet({ studio }: { readonly studio: Studio }) {
  const { given } = studio.layout;
  const what = given.value;
  useEffect(
    () => () => {
      given.value = null;
    },
    [given],
  );
  return what && <Gift key={what.id} studio={studio} what={what} />;
}

interface GiftProps {
  readonly studio: Studio;
  readonly what: Given;
}

function Gift({ studio, what }: GiftProps) {
  const { mayChangePeople } = studio.rights;
  /** Whether anybody has a name and a password here; null until the server has said it. */
  const [open, setOpen] = useState<boolean | null>(null);
  /** Why the server has not. */
  const [unsaid, setUnsaid] = useState<unknown>(null);
  const { gifts, directory } = useMemo(() => {
    const failed = (error: unknown) => studio.toasts.show(sentence(error));
    return { gifts: new Gifts({ gift: what, api, failed }), directory: new Directory({ api: peopleApi, failed }) };
  }, [studio, what]);
  const look = () => {
    setUnsaid(null);
    void gifts.look();
    askEntrance().then(({ passwords }) => setOpen(passwords), setUnsaid);
  };
  useEffect(() => {
    look();
    if (mayChangePeople) {
      void directory.look();
    }
  }, [gifts, directory, mayChangePeople]);
  const members = gifts.members.value;
  return (
    <div class="stack">
      <BackBar studio={studio} title={what.name} to={what.from} />
      {members === null || open === null ? (
        <Unknown failure={gifts.failure.value ?? unsaid} onAgain={look} />
      ) : (
        <>
          {open && <p class="quiet">{say(`gifts.advice.${what.kind}`)}</p>}
          {open && studio.rights.me.value?.way === "machine" && <p class="warning">{say("accounts.people.machine")}</p>}
          {!open && <Closed studio={studio} what={what} />}
          <div class="gift-columns">
            {open && <GiveForm studio={studio} gifts={gifts} directory={directory} />}
            {(open || members.length > 0) && <SharedWith studio={studio} gifts={gifts} within={what.within} />}
          </div>
        </>
      )}
    </div>
  );
}

interface SharedWithProps {
  readonly studio: Studio;
  readonly gifts: Gifts;
  /** The collection that it lies in. */
  readonly within: string | undefined;
}

/** To whom it is given. */
function SharedWith({ studio, gifts, within }: SharedWithProps) {
  const members = gifts.members.value ?? [];
  const head = useRef<HTMLHeadingElement>(null);
  /** A row that is gone leaves the focus to nobody. */
  const taken = () => {
    if (document.activeElement === document.body) {
      head.current?.focus({ preventScroll: true });
    }
  };
  return (
    <section class="stack" aria-labelledby="gifts-head">
      <h3 class="sheet-head" id="gifts-head" ref={head} tabIndex={-1}>
        {say("gifts.head")}
      </h3>
      {within !== undefined && <p class="quiet">{say("gifts.within", { collection: within })}</p>}
      {members.length === 0 && <p class="quiet">{say("gifts.none")}</p>}
      <ul class="links" aria-labelledby="gifts-head">
        {members.map((member) => (
          <GiftRow key={member.id} studio={studio} gifts={gifts} member={member} onTaken={taken} />
        ))}
      </ul>
    </section>
  );
}

/** Why it is not known, or not yet, to whom it is given. */
function Unknown({ failure, onAgain }: { readonly failure: unknown; readonly onAgain: () => void }) {
  return failure === null ? (
    <p class="quiet" role="status">
      {say("gifts.asking")}
    </p>
  ) : (
    <div class="actions">
      <p role="alert">{sentence(failure)}</p>
      <button type="button" class="small" onClick={onAgain}>
        {say("sheets.library.again")}
      </button>
    </div>
  );
}

/** Why it can be given to nobody, and what can be done instead. */
function Closed({ studio, what }: GiftProps) {
  const { layout, rights } = studio;
  return (
    <>
      <p>{say("gifts.closed")}</p>
      <p class="quiet">{say(rights.mayChangePeople ? "gifts.closed.admin" : "gifts.closed.other")}</p>
      {what.kind === "collection" && <p class="quiet">{say("gifts.closed.collection")}</p>}
      <div class="actions">
        {rights.mayChangePeople && (
          <button
            type="button"
            class="small"
            onClick={() => {
              layout.sheet.value = "accounts";
            }}
          >
            {say("gifts.closed.people")}
          </button>
        )}
        {what.kind === "tree" && (
          <button
            type="button"
            class="primary"
            onClick={() => {
              layout.shared.value = what.from === "library" ? what : null;
              layout.sheet.value = "share";
            }}
          >
            {say("gifts.closed.link")}
          </button>
        )}
      </div>
    </>
  );
}
