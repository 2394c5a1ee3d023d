import { useState } from "preact/hooks";
import type { LinkRole, TreeLink } from "../../../../wire/generated";
import { LINK_ROLES } from "../../../library/links/lasting";
import { momentText } from "../../../words/date-text";
import { say } from "../../../words/say";
import { RoleSelect } from "../accounts/role-select";
import { ConfirmRow } from "../confirm-row";

interface LinkRowProps {
  readonly link: TreeLink;
  /** They may do that from now on. */
  readonly onChange: (role: LinkRole) => Promise<void>;
  readonly onRevoke: () => Promise<void>;
}

/**
 * Who was invited, since when and until when; what they may do, which holds at once when it is changed, and a way to take
 * it all back, which is asked about once.
 */
export function LinkRow({ link, onChange, onRevoke }: LinkRowProps) {
  const { name, role, since, until, used } = link;
  const [asks, setAsks] = useState(false);
  return (
    <li class="link-row" data-used={used}>
      <div>
        <strong>{name}</strong>
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
          <RoleSelect
            label={say("accounts.role.of", { name })}
            roles={LINK_ROLES}
            chosen={role as LinkRole}
            onChoose={(next) => void onChange(next)}
          />
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
