import { useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS, type MemberRole } from "../../../../wire/generated";
import type { Directory } from "../../../access/directory";
import type { Gifts } from "../../../library/gifts/gifts";
import { offeredNames } from "../../../library/gifts/offered-names";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { Segments } from "../../controls/segments";
import { RoleSelect } from "../accounts/role-select";
import { mayText, rolesToGive } from "./gift-row";

const KINDS = ["user", "group"] as const;
type Kind = (typeof KINDS)[number];

interface GiveFormProps {
  readonly studio: Studio;
  readonly gifts: Gifts;
  /** Who there is, as far as whoever asks may know. */
  readonly directory: Directory;
}

/** To whom it is to be given: names are typed, and offered to who may know them. */
export function GiveForm({ studio, gifts, directory }: GiveFormProps) {
  const [kind, setKind] = useState<Kind>("user");
  const [name, setName] = useState("");
  const [role, setRole] = useState<MemberRole>("viewer");
  /** The name that nobody has. */
  const [unknown, setUnknown] = useState<string | null>(null);
  const called = name.trim();
  const known = (kind === "user" ? directory.users.value : directory.groups.value)?.map((one) => one.name);
  const offered = offeredNames(known ?? [], name, kind, gifts.members.value ?? []);
  const type = (text: string) => {
    setName(text);
    setUnknown(null);
  };
  const give = async () => {
    const member = { name: called, group: kind === "group", role };
    const giving = await gifts.give(member);
    if (giving === "given") {
      type("");
      studio.toasts.show(mayText(member, role));
    } else if (giving === "nobody") {
      setUnknown(called);
    }
  };
  return (
    <form
      class="stack account-form"
      onSubmit={(event) => {
        event.preventDefault();
        void give();
      }}
    >
      <Segments
        legend={say("gifts.kind")}
        name="gift-kind"
        values={KINDS}
        chosen={kind}
        text={(one) => say(`gifts.kind.${one as Kind}`)}
        onChoose={(one) => {
          setKind(one as Kind);
          setUnknown(null);
        }}
      />
      <label class="field">
        <span>{say(`gifts.name.${kind}`)}</span>
        <input
          type="text"
          autocomplete="off"
          autocapitalize="words"
          spellcheck={false}
          enterkeyhint="done"
          maxLength={MAX_NAME_CHARACTERS}
          value={name}
          onInput={({ currentTarget }) => type(currentTarget.value)}
        />
      </label>
      {unknown !== null && <p role="alert">{say(`gifts.nobody.${kind}`, { name: unknown })}</p>}
      {known?.length === 0 && (
        <p class="quiet">{say(kind === "user" ? "accounts.people.none" : "accounts.groups.none")}</p>
      )}
      {offered.length > 0 && offered.join() !== called && (
        <fieldset class="tags gift-names" aria-label={say("gifts.names")}>
          {offered.map((one) => (
            <button key={one} type="button" class="small tag" onClick={() => type(one)}>
              {one}
            </button>
          ))}
        </fieldset>
      )}
      <RoleSelect label={say("links.role")} isLabelled roles={rolesToGive(studio)} chosen={role} onChoose={setRole} />
      <p class="quiet">{say(`gifts.role.${role}`)}</p>
      <div class="actions">
        <button type="submit" class="primary" disabled={gifts.busy.value || called === ""}>
          {say("gifts.give")}
        </button>
      </div>
    </form>
  );
}
