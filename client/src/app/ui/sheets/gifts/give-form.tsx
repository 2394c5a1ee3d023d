import { useMemo, useRef, useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS, type MemberRole } from "../../../../wire/generated";
import type { Directory } from "../../../access/directory";
import type { Gifts } from "../../../library/gifts/gifts";
import { offeredNames } from "../../../library/gifts/offered-names";
import { RECEIVERS, type Receiver, TypedName } from "../../../library/gifts/typed-name";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { Segments } from "../../controls/segments";
import { RoleSelect } from "../accounts/role-select";
import { mayText, rolesToGive } from "./gift-row";

interface GiveFormProps {
  readonly studio: Studio;
  readonly gifts: Gifts;
  /** Who there is, as far as whoever asks may know. */
  readonly directory: Directory;
}

/** To whom it is to be given: names are typed, and offered to who may know them. */
export function GiveForm({ studio, gifts, directory }: GiveFormProps) {
  const typed = useMemo(() => new TypedName(), [gifts]);
  const [role, setRole] = useState<MemberRole>("viewer");
  const field = useRef<HTMLInputElement>(null);
  const { kind, name } = typed.called;
  const nobody = typed.nobody.value;
  const known = (kind === "user" ? directory.users.value : directory.groups.value)?.map((one) => one.name);
  const offered = offeredNames(known ?? [], typed.text.value, kind, gifts.members.value ?? []);
  const give = async () => {
    if (name === "") {
      typed.answered(typed.called, "nobody");
      field.current?.focus();
      return;
    }
    const member = { name, group: kind === "group", role };
    const giving = await gifts.give(member);
    typed.answered({ kind, name }, giving);
    if (giving === "given") {
      studio.toasts.show(mayText(member, role));
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
        values={RECEIVERS}
        chosen={kind}
        text={(one) => say(`gifts.kind.${one as Receiver}`)}
        onChoose={(one) => typed.choose(one as Receiver)}
      />
      <label class="field">
        <span>{say(`gifts.name.${kind}`)}</span>
        <input
          ref={field}
          type="text"
          autocomplete="off"
          autocapitalize="words"
          spellcheck={false}
          enterkeyhint="done"
          maxLength={MAX_NAME_CHARACTERS}
          aria-invalid={nobody !== null}
          aria-describedby={nobody === null ? undefined : "gift-nobody"}
          value={typed.text.value}
          onInput={({ currentTarget }) => typed.type(currentTarget.value)}
        />
      </label>
      {nobody !== null && (
        <p role="alert" id="gift-nobody">
          {nobody.name === ""
            ? say(`gifts.unnamed.${nobody.kind}`)
            : say(`gifts.nobody.${nobody.kind}`, { name: nobody.name })}
        </p>
      )}
      {known?.length === 0 && (
        <p class="quiet">{say(kind === "user" ? "accounts.people.none" : "accounts.groups.none")}</p>
      )}
      {offered.length > 0 && offered.join() !== name && (
        <fieldset class="tags gift-names" aria-label={say("gifts.names")}>
          {offered.map((one) => (
            <button key={one} type="button" class="small tag" onClick={() => typed.type(one)}>
              {one}
            </button>
          ))}
        </fieldset>
      )}
      <RoleSelect label={say("links.role")} isLabelled roles={rolesToGive(studio)} chosen={role} onChoose={setRole} />
      <p class="quiet">{say(`gifts.role.${role}`)}</p>
      <div class="actions">
        <button type="submit" class="primary">
          {say("gifts.give")}
        </button>
      </div>
    </form>
  );
}
