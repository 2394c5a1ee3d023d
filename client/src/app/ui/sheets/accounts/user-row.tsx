import { useState } from "preact/hooks";
import { type ListedUser, MAX_NAME_CHARACTERS, type Role } from "../../../../wire/generated";
import type { Directory } from "../../../access/directory";
import type { Studio } from "../../../studio";
import { language, say } from "../../../words/say";
import { ConfirmRow } from "../confirm-row";
import type { PassedOn } from "./passed-on";
import { PasswordField } from "./password-field";
import { RoleSelect, USER_ROLES } from "./role-select";

interface UserRowProps {
  readonly studio: Studio;
  readonly directory: Directory;
  readonly user: ListedUser;
  /** A password is to be passed on. */
  readonly onPassOn: (passedOn: PassedOn) => void;
}

/** Somebody who can log in: what they may, and ways to change that, their name and password, and to remove them. */
export function UserRow({ studio, directory, user, onPassOn }: UserRowProps) {
  const [asks, setAsks] = useState<"change" | "remove" | null>(null);
  const { id, name, own_role: own } = user;
  const me = studio.rights.me.value;
  const isYou = me?.way === "login" && me.name === name;
  const allow = async (role: Role) => {
    if (await directory.changeUser(id, { role })) {
      studio.toasts.show(say("accounts.people.may", { name, role: say(`accounts.role.${role}`) }), {
        label: say("accounts.undo"),
        act: () => void directory.changeUser(id, { role: own }),
      });
    }
  };
  const remove = async () => {
    if (await directory.removeUser(id)) {
      studio.toasts.show(say("accounts.people.removed", { name }));
    }
  };
  const groups = groupsText(user);
  return (
    <li class="account-row" data-user={name}>
      <div class="account-head">
        <div>
          <strong>{isYou ? say("accounts.people.you", { name }) : name}</strong>
          {groups !== "" && <p class="quiet">{groups}</p>}
        </div>
        <RoleSelect
          label={say("accounts.role.of", { name })}
          roles={USER_ROLES}
          chosen={own}
          disabled={directory.busy.value}
          onChoose={(role) => void allow(role)}
        />
      </div>
      {asks === "change" && (
        <ChangeForm
          studio={studio}
          directory={directory}
          user={user}
          onPassOn={onPassOn}
          onDone={() => setAsks(null)}
        />
      )}
      {asks === "remove" && (
        <ConfirmRow
          question={say("accounts.people.remove.sure")}
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
            aria-label={say("accounts.change.which", { name })}
            onClick={() => setAsks("change")}
          >
            {say("accounts.change")}
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

/** In which groups somebody is, and what they may only through them. */
function groupsText({ role, own_role, groups }: ListedUser): string {
  if (groups.length === 0) {
    return "";
  }
  const names = new Intl.ListFormat(language.value).format(groups);
  return role === own_role
    ? say("accounts.people.in", { groups: names })
    : say("accounts.people.by-group", { role: say(`accounts.role.${role}`), groups: names });
}

interface ChangeFormProps extends UserRowProps {
  readonly onDone: () => void;
}

/** Another name, or another password. */
function ChangeForm({ studio, directory, user, onPassOn, onDone }: ChangeFormProps) {
  const [name, setName] = useState(user.name);
  const [password, setPassword] = useState("");
  const called = name.trim();
  const save = async () => {
    const change = {
      ...(called === user.name ? {} : { name: called }),
      ...(password === "" ? {} : { password }),
    };
    if (Object.keys(change).length > 0 && !(await directory.changeUser(user.id, change))) {
      return;
    }
    if (password !== "") {
      onPassOn({ kind: "changed", name: called, password });
    } else if (called !== user.name) {
      studio.toasts.show(say("accounts.people.renamed", { before: user.name, name: called }), {
        label: say("accounts.undo"),
        act: () => void directory.changeUser(user.id, { name: user.name }),
      });
    }
    onDone();
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
      <PasswordField label={say("accounts.password.new")} password={password} onChange={setPassword} />
      <p class="quiet">{say("accounts.password.new.advice")}</p>
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
