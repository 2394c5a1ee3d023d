import { useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS, type Role } from "../../../../wire/generated";
import type { Directory } from "../../../access/directory";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { type PassedOn, PassOn } from "./passed-on";
import { PASSWORD_CHARACTERS, PasswordField } from "./password-field";
import { RoleSelect, USER_ROLES } from "./role-select";
import { UserRow } from "./user-row";

interface PeopleTabProps {
  readonly studio: Studio;
  readonly directory: Directory;
}

/** Who can log in, and a way to add somebody. */
export function PeopleTab({ studio, directory }: PeopleTabProps) {
  const [adds, setAdds] = useState(false);
  const [passedOn, setPassedOn] = useState<PassedOn | null>(null);
  const users = directory.users.value ?? [];
  return (
    <div class="stack">
      <p class="quiet">{say("accounts.people.advice")}</p>
      {studio.rights.me.value?.way === "machine" && <p class="warning">{say("accounts.people.machine")}</p>}
      {passedOn && <PassOn studio={studio} passedOn={passedOn} onDone={() => setPassedOn(null)} />}
      {adds ? (
        <AddForm directory={directory} onAdded={setPassedOn} onDone={() => setAdds(false)} />
      ) : (
        <div class="actions">
          <button type="button" class="primary" onClick={() => setAdds(true)}>
            {say("accounts.people.add")}
          </button>
        </div>
      )}
      {users.length === 0 && <p class="quiet">{say("accounts.people.none")}</p>}
      <ul class="links" aria-label={say("accounts.tab.people")}>
        {users.map((user) => (
          <UserRow key={user.id} studio={studio} directory={directory} user={user} onPassOn={setPassedOn} />
        ))}
      </ul>
      <WhoMayWhat />
    </div>
  );
}

interface AddFormProps {
  readonly directory: Directory;
  readonly onAdded: (passedOn: PassedOn) => void;
  readonly onDone: () => void;
}

function AddForm({ directory, onAdded, onDone }: AddFormProps) {
  const [name, setName] = useState("");
  const [role, setRole] = useState<Role>("editor");
  const [password, setPassword] = useState("");
  const called = name.trim();
  const add = async () => {
    if (await directory.addUser({ name: called, role, password })) {
      onAdded({ kind: "added", name: called, password });
      onDone();
    }
  };
  return (
    <form
      class="stack account-form"
      onSubmit={(event) => {
        event.preventDefault();
        void add();
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
      <RoleSelect label={say("accounts.role")} isLabelled roles={USER_ROLES} chosen={role} onChoose={setRole} />
      <PasswordField label={say("accounts.password")} password={password} onChange={setPassword} />
      <div class="actions">
        <button type="button" class="small" onClick={onDone}>
          {say("accounts.cancel")}
        </button>
        <button
          type="submit"
          class="primary"
          disabled={directory.busy.value || called === "" || password.length < PASSWORD_CHARACTERS.least}
        >
          {say("accounts.people.add")}
        </button>
      </div>
    </form>
  );
}

/** What each role may do, in sentences. */
export function WhoMayWhat() {
  return (
    <details class="who-may">
      <summary>{say("accounts.roles")}</summary>
      <dl>
        {USER_ROLES.map((role) => (
          <div key={role}>
            <dt>{say(`accounts.role.${role}`)}</dt>
            <dd>{say(`accounts.roles.${role}`)}</dd>
          </div>
        ))}
      </dl>
      <p class="quiet">{say("accounts.roles.groups")}</p>
    </details>
  );
}
