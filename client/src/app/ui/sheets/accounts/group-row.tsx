import { useState } from "preact/hooks";
import { type GroupMember, type GroupRole, type ListedGroup, MAX_NAME_CHARACTERS } from "../../../../wire/generated";
import type { Directory } from "../../../access/directory";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { CloseIcon } from "../../icons";
import { ConfirmRow } from "../confirm-row";
import { Pick } from "../library/pick";
import { RoleSelect } from "./role-select";

/** What a group may have, the least first. */
export const GROUP_ROLES = ["none", "viewer", "commenter", "editor", "owner"] as const satisfies readonly GroupRole[];

interface GroupRowProps {
  readonly studio: Studio;
  readonly directory: Directory;
  readonly group: ListedGroup;
}

/** A group: what its members may, who is in it, and ways to change all of that. */
export function GroupRow({ studio, directory, group }: GroupRowProps) {
  const [asks, setAsks] = useState<"rename" | "remove" | null>(null);
  const { id, name, role } = group;
  const busy = directory.busy.value;
  const undo = (act: () => Promise<boolean>) => ({ label: say("accounts.undo"), act: () => void act() });
  const allow = async (next: GroupRole) => {
    if (await directory.changeGroup(id, { role: next })) {
      const text = say("accounts.groups.may", { name, role: say(`accounts.role.${next}`) });
      studio.toasts.show(
        text,
        undo(() => directory.changeGroup(id, { role })),
      );
    }
  };
  const leave = async (member: GroupMember) => {
    if (await directory.setMember(id, member.id, false)) {
      studio.toasts.show(
        say("accounts.groups.left", { user: member.name, name }),
        undo(() => directory.setMember(id, member.id, true)),
      );
    }
  };
  const remove = async () => {
    if (await directory.removeGroup(id)) {
      studio.toasts.show(say("accounts.groups.removed", { name }));
    }
  };
  return (
    <li class="account-row" data-group={name}>
      <div class="account-head">
        <strong>{name}</strong>
        <RoleSelect
          label={say("accounts.role.of", { name })}
          roles={GROUP_ROLES}
          chosen={role}
          disabled={busy}
          onChoose={(next) => void allow(next)}
        />
      </div>
      <Members directory={directory} group={group} onLeave={(member) => void leave(member)} />
      {asks === "rename" && <RenameForm directory={directory} group={group} onDone={() => setAsks(null)} />}
      {asks === "remove" && (
        <ConfirmRow
          question={say("accounts.groups.remove.sure")}
          act={say("accounts.remove")}
          onAct={remove}
          onKeep={() => setAsks(null)}
        />
      )}
      {asks === null && (
        <div class="link-acts">
          <button
            type="button"
            class="small"
            aria-label={say("accounts.groups.rename.which", { name })}
            onClick={() => setAsks("rename")}
          >
            {say("accounts.groups.rename")}
          </button>
          <button
            type="button"
            class="small"
            aria-label={say("accounts.remove.which", { name })}
            onClick={() => setAsks("remove")}
          >
            {say("accounts.remove")}
          </button>
        </div>
      )}
    </li>
  );
}

interface MembersProps {
  readonly directory: Directory;
  readonly group: ListedGroup;
  readonly onLeave: (member: GroupMember) => void;
}

/** Who is in a group, each with a way out, and who could be. */
function Members({ directory, group: { id, name, members }, onLeave }: MembersProps) {
  const join = say("accounts.groups.join", { name });
  const others = (directory.users.value ?? []).filter((user) => !members.some((member) => member.id === user.id));
  return (
    <div class="group-members">
      {members.length === 0 ? (
        <p class="quiet">{say("accounts.groups.empty")}</p>
      ) : (
        <ul aria-label={say("accounts.groups.members", { name })}>
          {members.map((member) => (
            <li key={member.id}>
              {member.name}
              <button
                type="button"
                aria-label={say("accounts.groups.leave", { user: member.name, name })}
                disabled={directory.busy.value}
                onClick={() => onLeave(member)}
              >
                <CloseIcon />
              </button>
            </li>
          ))}
        </ul>
      )}
      {others.length > 0 && (
        <Pick
          label={join}
          value=""
          options={[["", join], ...others.map((user) => [user.id, user.name] as const)]}
          disabled={directory.busy.value}
          onPick={(user) => user !== "" && void directory.setMember(id, user, true)}
        />
      )}
    </div>
  );
}

interface RenameFormProps {
  readonly directory: Directory;
  readonly group: ListedGroup;
  readonly onDone: () => void;
}

function RenameForm({ directory, group, onDone }: RenameFormProps) {
  const [name, setName] = useState(group.name);
  const called = name.trim();
  const save = async () => {
    if (called === group.name || (await directory.changeGroup(group.id, { name: called }))) {
      onDone();
    }
  };
  return (
    <form
      class="stack"
      onSubmit={(event) => {
        event.preventDefault();
        void save();
      }}
    >
      <label class="field">
        <span>{say("accounts.name")}</span>
        <input
          type="text"
          required
          autocomplete="off"
          maxLength={MAX_NAME_CHARACTERS}
          value={name}
          onInput={({ currentTarget }) => setName(currentTarget.value)}
        />
      </label>
      <div class="actions">
        <button type="button" class="small" onClick={onDone}>
          {say("accounts.cancel")}
        </button>
        <button type="submit" class="primary" disabled={directory.busy.value || called === ""}>
          {say("accounts.save")}
        </button>
      </div>
    </form>
  );
}
