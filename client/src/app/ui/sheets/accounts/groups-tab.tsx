import { useState } from "preact/hooks";
import { type GroupRole, MAX_NAME_CHARACTERS } from "../../../../wire/generated";
import type { Directory } from "../../../access/directory";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { GROUP_ROLES, GroupRow } from "./group-row";
import { WhoMayWhat } from "./people-tab";
import { RoleSelect } from "./role-select";

interface GroupsTabProps {
  readonly studio: Studio;
  readonly directory: Directory;
}

/** Groups with their members, and a way to add one. */
export function GroupsTab({ studio, directory }: GroupsTabProps) {
  const [adds, setAdds] = useState(false);
  const groups = directory.groups.value ?? [];
  return (
    <div class="stack">
      <p class="quiet">{say("accounts.groups.advice")}</p>
      {adds ? (
        <AddForm directory={directory} onDone={() => setAdds(false)} />
      ) : (
        <div class="actions">
          <button type="button" class="primary" onClick={() => setAdds(true)}>
            {say("accounts.groups.add")}
          </button>
        </div>
      )}
      {groups.length === 0 && <p class="quiet">{say("accounts.groups.none")}</p>}
      <ul class="links" aria-label={say("accounts.tab.groups")}>
        {groups.map((group) => (
          <GroupRow key={group.id} studio={studio} directory={directory} group={group} />
        ))}
      </ul>
      <WhoMayWhat />
    </div>
  );
}

function AddForm({ directory, onDone }: { readonly directory: Directory; readonly onDone: () => void }) {
  const [name, setName] = useState("");
  const [role, setRole] = useState<GroupRole>("editor");
  const called = name.trim();
  const add = async () => {
    if (await directory.addGroup({ name: called, role })) {
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
      <RoleSelect label={say("accounts.role")} isLabelled roles={GROUP_ROLES} chosen={role} onChoose={setRole} />
      <div class="actions">
        <button type="button" class="small" onClick={onDone}>
          {say("accounts.cancel")}
        </button>
        <button type="submit" class="primary" disabled={directory.busy.value || called === ""}>
          {say("accounts.groups.add")}
        </button>
      </div>
    </form>
  );
}
