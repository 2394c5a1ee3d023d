import { useState } from "preact/hooks";
import { changeOwnPassword } from "../../../access/people-api";
import { explained } from "../../../problems/explained";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { PASSWORD_CHARACTERS } from "./password-field";
import { WhoMayWhat } from "./people-tab";

/** As whom this page is let in, what that allows, and another password. */
export function OwnTab({ studio }: { readonly studio: Studio }) {
  const me = studio.rights.me.value;
  if (me === null) {
    return <p class="quiet">{say("accounts.loading")}</p>;
  }
  const [name, role] = [me.name ?? "", say(`accounts.role.${me.role}`)];
  const way = me.way === "login" || me.way === "machine" ? me.way : "other";
  return (
    <div class="stack">
      <p>{say(`accounts.own.${way}`, { name, role })}</p>
      <WhoMayWhat />
      {me.way === "login" ? (
        <PasswordForm studio={studio} name={name} />
      ) : (
        <p class="quiet">{say("accounts.own.none")}</p>
      )}
    </div>
  );
}

function PasswordForm({ studio, name }: { readonly studio: Studio; readonly name: string }) {
  const [before, setBefore] = useState("");
  const [next, setNext] = useState("");
  const [shows, setShows] = useState(false);
  const [saving, setSaving] = useState(false);
  const [trouble, setTrouble] = useState("");
  const save = async () => {
    setSaving(true);
    setTrouble("");
    try {
      await changeOwnPassword({ old: before, new: next });
      setBefore("");
      setNext("");
      studio.toasts.show(say("accounts.own.changed"));
    } catch (error) {
      setTrouble(await explained(error));
    }
    setSaving(false);
  };
  const type = shows ? ({ type: "text" } as const) : ({ type: "password" } as const);
  return (
    <form
      class="stack account-form"
      aria-label={say("accounts.own.password")}
      onSubmit={(event) => {
        event.preventDefault();
        void save();
      }}
    >
      <h3 class="sheet-head">{say("accounts.own.password")}</h3>
      {/* Password keepers ask for whom it is. */}
      <input type="text" hidden readOnly autocomplete="username" value={name} />
      <label class="field">
        <span>{say("accounts.own.old")}</span>
        <input
          {...type}
          required
          autocomplete="current-password"
          maxLength={PASSWORD_CHARACTERS.most}
          value={before}
          onInput={({ currentTarget }) => setBefore(currentTarget.value)}
        />
      </label>
      <label class="field">
        <span>{say("accounts.own.new")}</span>
        <input
          {...type}
          required
          autocomplete="new-password"
          minLength={PASSWORD_CHARACTERS.least}
          maxLength={PASSWORD_CHARACTERS.most}
          placeholder={say("accounts.password.length", PASSWORD_CHARACTERS)}
          value={next}
          onInput={({ currentTarget }) => setNext(currentTarget.value)}
        />
      </label>
      <label class="switch">
        <input type="checkbox" checked={shows} onChange={({ currentTarget }) => setShows(currentTarget.checked)} />
        <span>{say("accounts.own.show")}</span>
      </label>
      <p class="quiet">{say("accounts.own.advice")}</p>
      {trouble !== "" && <p role="alert">{trouble}</p>}
      <div class="actions">
        <button
          type="submit"
          class="primary"
          disabled={saving || before === "" || next.length < PASSWORD_CHARACTERS.least}
        >
          {say("accounts.own.act")}
        </button>
      </div>
    </form>
  );
}
