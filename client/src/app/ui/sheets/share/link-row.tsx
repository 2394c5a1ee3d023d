import { useState } from "preact/hooks";
import type { LinkRole, TreeLink } from "../../../../wire/generated";
import { momentText } from "../../../words/date-text";
import { type Key, say } from "../../../words/say";
import { ConfirmRow } from "../confirm-row";
import { LinkRoles } from "./link-roles";

interface LinkRowProps {
  readonly link: TreeLink;
  /** They may do that from now on. */
  readonly onChange: (role: LinkRole) => Promise<void>;
  readonly onRevoke: () => Promise<void>;
}

/**
 * Who was invited, since when and until when; ways to let them do more or less, which holds at once, and to take it all
 * back, which is asked about once.
 */
export function LinkRow({ link, onChange, onRevoke }: LinkRowProps) {
  const { name, role, since, until, used } = link;
  const [asks, setAsks] = useState(false);
  return (
    <li class="link-row" data-used={used}>
      <div>
        <strong>{name}</strong> <span class="quiet">{say(`links.may.${role}` as Key)}</span>
        <br />
        <span class="quiet">
          {say(used ? "links.used" : "links.unused", { since: momentText(since), until: momentText(until) })}
        </span>
      </div>
      {asks ? (
        <ConfirmRow
          question={say(used ? "links.revoke.used" : "links.revoke.unused")}
          act={say("links.revoke")}
          onAct={onRevoke}
          onKeep={() => setAsks(false)}
        />
      ) : (
        <div class="link-acts">
          <LinkRoles link={link} onChange={onChange} />
          <button
            type="button"
            class="small"
            aria-label={say("links.revoke.which", { name })}
            onClick={() => setAsks(true)}
          >
            {say("links.revoke")}
          </button>
        </div>
      )}
    </li>
  );
}
