import { useEffect, useState } from "preact/hooks";
import { type ListedToken, MAX_NAME_CHARACTERS, ROLES } from "../../../../wire/generated";
import type { Programs } from "../../../access/programs";
import { LASTING_TOKENS, LINK_ROLES, tokenOf, type Wish } from "../../../library/links/lasting";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { dateText } from "../../../words/date-text";
import { type Key, say } from "../../../words/say";
import { Segments } from "../../controls/segments";
import { ConfirmRow } from "../confirm-row";
import { RoleSelect } from "./role-select";
import { SecretField } from "./secret-field";

interface ProgramsTabProps {
  readonly studio: Studio;
  readonly programs: Programs;
}

/** Programs that act as whoever looks, a way to let in one more, and for administrators everybody's. */
export function ProgramsTab({ studio, programs }: ProgramsTabProps) {
  useEffect(() => void programs.look(), [programs]);
  const [list, failure, fresh] = [programs.list.value, programs.failure.value, programs.fresh.value];
  return (
    <div class="stack">
      <p class="quiet">{say("accounts.programs.advice")}</p>
      {fresh === null ? (
        studio.rights.mayMakeTokens && <MakeForm studio={studio} programs={programs} />
      ) : (
        <div class="fresh-link" role="status">
          <p>{say("accounts.programs.fresh", { name: fresh.name })}</p>
          <SecretField studio={studio} label={say("accounts.programs.token")} text={fresh.token} />
          <p class="quiet">{say("accounts.programs.usage")}</p>
          <code>{say("accounts.programs.header", { token: fresh.token })}</code>
          <button
            type="button"
            class="small"
            onClick={() => {
              programs.fresh.value = null;
            }}
          >
            {say("accounts.programs.kept")}
          </button>
        </div>
      )}
      {studio.rights.mayChangePeople && (
        <Segments
          legend={say("accounts.programs.whose")}
          name="whose-programs"
          values={["own", "all"]}
          chosen={programs.whose.value}
          text={(whose) => say(`accounts.programs.${whose}` as Key)}
          onChoose={(whose) => void programs.look(whose === "all" ? "all" : "own")}
        />
      )}
      {failure !== null && <p role="alert">{sentence(failure)}</p>}
      {list === null && failure === null && <p class="quiet">{say("accounts.loading")}</p>}
      {list?.length === 0 && <p class="quiet">{say("accounts.programs.none")}</p>}
      <ul class="links" aria-label={say("accounts.tab.programs")}>
        {list?.map((token) => (
          <TokenRow key={token.id} token={token} isOwn={programs.whose.value === "own"} programs={programs} />
        ))}
      </ul>
    </div>
  );
}

function MakeForm({ studio, programs }: ProgramsTabProps) {
  const [wish, setWish] = useState<Wish>({ role: "viewer", lasting: "month", name: "" });
  const own = ROLES.indexOf(studio.rights.me.value?.role ?? "viewer");
  const roles = LINK_ROLES.filter((role) => ROLES.indexOf(role) <= own);
  const make = async () => {
    if (await programs.make(tokenOf(wish))) {
      setWish({ ...wish, name: "" });
    }
  };
  return (
    <form
      class="stack account-form"
      onSubmit={(event) => {
        event.preventDefault();
        void make();
      }}
    >
      <label class="field">
        <span>{say("accounts.programs.name")}</span>
        <input
          type="text"
          required
          autocomplete="off"
          maxLength={MAX_NAME_CHARACTERS}
          value={wish.name}
          onInput={({ currentTarget }) => setWish({ ...wish, name: currentTarget.value })}
        />
      </label>
      <RoleSelect
        label={say("accounts.role")}
        isLabelled
        roles={roles}
        chosen={wish.role}
        onChoose={(role) => setWish({ ...wish, role })}
      />
      <Segments
        legend={say("accounts.programs.lasting")}
        name="token-lasting"
        values={LASTING_TOKENS}
        chosen={wish.lasting}
        text={(lasting) => say(`links.lasting.${lasting}` as Key)}
        onChoose={(lasting) => setWish({ ...wish, lasting: lasting as Wish["lasting"] })}
      />
      <div class="actions">
        <button type="submit" class="primary" disabled={programs.making.value || wish.name.trim() === ""}>
          {say("accounts.programs.make")}
        </button>
      </div>
    </form>
  );
}

interface TokenRowProps {
  readonly token: ListedToken;
  readonly isOwn: boolean;
  readonly programs: Programs;
}

function TokenRow({ token: { id, name, role, of, since, until }, isOwn, programs }: TokenRowProps) {
  const [asks, setAsks] = useState(false);
  return (
    <li class="account-row" data-token={name}>
      <div class="account-head">
        <div>
          <strong>{name}</strong>
          <p class="quiet">
            {!isOwn &&
              `${of === undefined ? say("accounts.programs.shell") : say("accounts.programs.of", { name: of })} `}
            {say("accounts.programs.one", {
              role: say(`accounts.role.${role}`),
              since: dateText(since),
              until: dateText(until),
            })}
          </p>
        </div>
        {!asks && (
          <button
            type="button"
            class="small"
            aria-label={say("accounts.programs.revoke.which", { name })}
            onClick={() => setAsks(true)}
          >
            {say("accounts.programs.revoke")}
          </button>
        )}
      </div>
      {asks && (
        <ConfirmRow
          question={say("accounts.programs.revoke.sure")}
          act={say("accounts.programs.revoke")}
          onAct={() => programs.revoke(id)}
          onKeep={() => setAsks(false)}
        />
      )}
    </li>
  );
}
