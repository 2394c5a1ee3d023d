import { useEffect } from "preact/hooks";
import type { SavedTree } from "../../../../wire/generated";
import { isOnlyHere } from "../../../library/links/only-here";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { BackBar } from "../library/back-bar";
import { Looking, useBelonging } from "../save-sheet";
import { Invitations } from "./invitations";
import { LinkField } from "./link-field";

/** Shares the tree on the page, or one of the library: by a link for those who are let in, and by letting others in. */
export function ShareSheet({ studio }: { studio: Studio }) {
  const { shared } = studio.layout;
  const tree = shared.value;
  useEffect(
    () => () => {
      shared.value = null;
    },
    [shared],
  );
  return tree === null ? (
    <div class="stack">
      <Session studio={studio} />
      {studio.rights.mayGovern && <OnPage studio={studio} />}
    </div>
  ) : (
    <div class="stack">
      <BackBar studio={studio} title={tree.name} />
      <Invitations studio={studio} tree={tree} />
    </div>
  );
}

/** The link under which those who are let in see and draw the same tree. */
function Session({ studio }: { studio: Studio }) {
  const link = `${location.origin}/s/${encodeURIComponent(studio.link.session.value ?? "")}`;
  return (
    <>
      <p>{say("sheets.share.advice")}</p>
      <LinkField studio={studio} label={say("sheets.share.link")} link={link} />
      {isOnlyHere(link) && <p class="quiet">{say("sheets.share.only-here")}</p>}
    </>
  );
}

/** Lets others in for the tree on the page, once it is saved. */
function OnPage({ studio }: { studio: Studio }) {
  const belonging = useBelonging(studio);
  if (belonging.of === undefined) {
    return <Looking belonging={belonging} />;
  }
  if (belonging.of !== null) {
    const { tree } = belonging.of;
    return (
      <>
        <WithPeople studio={studio} tree={tree} />
        <Invitations studio={studio} tree={tree} />
      </>
    );
  }
  return (
    <section class="stack" aria-label={say("links.head")}>
      <h3 class="sheet-head">{say("links.head")}</h3>
      <p class="quiet">{say("links.save-first")}</p>
      <div class="actions">
        <button
          type="button"
          class="small"
          onClick={() => {
            studio.layout.sheet.value = "save";
          }}
        >
          {say("sheets.save.act")}
        </button>
      </div>
    </section>
  );
}

interface WithPeopleProps {
  readonly studio: Studio;
  readonly tree: SavedTree;
}

/** The way to give the tree to those who log in. */
function WithPeople({ studio: { layout }, tree: { id, name } }: WithPeopleProps) {
  return (
    <div class="actions">
      <button
        type="button"
        class="small"
        onClick={() => {
          layout.given.value = { kind: "tree", id, name, from: "share" };
          layout.sheet.value = "gifts";
        }}
      >
        {say("gifts.open")}
      </button>
    </div>
  );
}
