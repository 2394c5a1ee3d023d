import { useEffect, useMemo, useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS, type SavedTree } from "../../../../wire/generated";
import { FIRST_WISH, LASTING, LINK_ROLES, linkOf, type Wish } from "../../../library/links/lasting";
import * as api from "../../../library/links/link-api";
import { isOnlyHere } from "../../../library/links/only-here";
import { type FreshLink, TreeLinks } from "../../../library/links/tree-links";
import { browserClock } from "../../../page/clock";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { type Key, say } from "../../../words/say";
import { Segments } from "../../controls/segments";
import { LinkField } from "./link-field";
import { LinkRow } from "./link-row";
import { LockRow } from "./lock-row";
import { QrCode } from "./qr-code";

interface InvitationsProps {
  readonly studio: Studio;
  readonly tree: Pick<SavedTree, "id">;
}

/** Lets others in for one tree: makes links, shows the one just made, and lists all of them. */
export function Invitations({ studio, tree }: InvitationsProps) {
  const links = useMemo(
    () =>
      new TreeLinks({
        tree: tree.id,
        api,
        clock: browserClock,
        failed: (error) => studio.toasts.show(sentence(error)),
      }),
    [studio, tree.id],
  );
  useEffect(() => links.follow(), [links]);
  const fresh = links.fresh.value;
  return (
    <section class="stack" aria-label={say("links.head")}>
      <h3 class="sheet-head">{say("links.head")}</h3>
      {fresh === null ? (
        <LinkForm links={links} />
      ) : (
        <Fresh key={fresh.id} studio={studio} links={links} fresh={fresh} />
      )}
      <LinkList links={links} />
      <LockRow studio={studio} tree={tree.id} />
    </section>
  );
}

/** What a new link is for. */
function LinkForm({ links }: { readonly links: TreeLinks }) {
  const [wish, setWish] = useState<Wish>(FIRST_WISH);
  const making = links.making.value;
  return (
    <form
      class="stack"
      onSubmit={(event) => {
        event.preventDefault();
        void links.make(linkOf(wish, say("links.unnamed")));
      }}
    >
      <p class="quiet">{say("links.advice")}</p>
      <Segments
        legend={say("links.role")}
        name="link-role"
        values={LINK_ROLES}
        chosen={wish.role}
        text={(role) => say(`links.role.${role}` as Key)}
        onChoose={(role) => setWish({ ...wish, role: role as Wish["role"] })}
      />
      <Segments
        legend={say("links.lasting")}
        name="link-lasting"
        values={LASTING}
        chosen={wish.lasting}
        text={(lasting) => say(`links.lasting.${lasting}` as Key)}
        onChoose={(lasting) => setWish({ ...wish, lasting: lasting as Wish["lasting"] })}
      />
      <label class="field">
        <span>{say("links.name")}</span>
        <input
          type="text"
          value={wish.name}
          maxLength={MAX_NAME_CHARACTERS}
          autocomplete="off"
          enterkeyhint="done"
          onInput={(event) => setWish({ ...wish, name: event.currentTarget.value })}
        />
      </label>
      <div class="actions">
        <button type="submit" class="primary" disabled={making}>
          {say(making ? "links.making" : "links.make")}
        </button>
      </div>
    </form>
  );
}

interface FreshProps {
  readonly studio: Studio;
  readonly links: TreeLinks;
  readonly fresh: FreshLink;
}

/** The link that was just made, until somebody has come by it. */
function Fresh({ studio, links, fresh: { url, asked } }: FreshProps) {
  const { name = "" } = asked;
  const came = links.came.value;
  return (
    <div class="fresh-link" role="status">
      {came ? (
        <p class="standing">{say("links.came", { name })}</p>
      ) : (
        <>
          <p>{say(`links.fresh.${asked.role}`, { name })}</p>
          {isOnlyHere(url) && <p class="warning">{say("links.only-here")}</p>}
          <QrCode text={url} label={say("links.code")} />
          <LinkField studio={studio} label={say("links.link")} link={url} />
        </>
      )}
      <button
        type="button"
        class="small"
        onClick={() => {
          links.fresh.value = null;
        }}
      >
        {say("links.another")}
      </button>
    </div>
  );
}

/** All links of the tree, or why they are not known. */
function LinkList({ links }: { readonly links: TreeLinks }) {
  const [list, failure] = [links.list.value, links.failure.value];
  if (failure !== null) {
    return (
      <div class="actions">
        <p role="alert">{sentence(failure)}</p>
        <button type="button" class="small" onClick={() => void links.look()}>
          {say("sheets.library.again")}
        </button>
      </div>
    );
  }
  if (list === null) {
    return <p class="quiet">{say("notices.looking")}</p>;
  }
  return list.length === 0 ? (
    <p class="quiet">{say("links.none")}</p>
  ) : (
    <ul class="links" aria-label={say("links.list")}>
      {list.map((link) => (
        <LinkRow
          key={link.id}
          link={link}
          onChange={(role) => links.change(link.id, role)}
          onRevoke={() => links.revoke(link.id)}
        />
      ))}
    </ul>
  );
}
