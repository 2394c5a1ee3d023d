import { useState } from "preact/hooks";
import { logOut } from "../../entry/account";
import { ENTRY_PATH } from "../../entry/ask-to-enter";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** As whom this browser is let in, what they can say of themselves and others, and the way out. */
export function AccountSection({ studio }: { studio: Studio }) {
  const [trouble, setTrouble] = useState("");
  const me = studio.rights.me.value;
  const { mayChangePeople, mayOwnTokens } = studio.rights;
  // Nobody has to be let in at the machine itself.
  const isLetIn = me !== null && me.way !== "machine";
  if (me === null || !(isLetIn || mayChangePeople)) {
    return null;
  }
  const leave = async () => {
    try {
      await logOut();
      location.assign(ENTRY_PATH);
    } catch (error) {
      setTrouble(await explained(error));
    }
  };
  const [name, role] = [me.name ?? "", say(`settings.role.${me.role}`)];
  return (
    <section class="account" aria-label={say("settings.account")}>
      <h3>{say("settings.account")}</h3>
      {isLetIn && (
        <p>{say(me.way === "login" ? "settings.account.login" : "settings.account.device", { name, role })}</p>
      )}
      {me.way === "device" && <p class="quiet">{say("settings.account.again")}</p>}
      <div class="account-acts">
        {(mayChangePeople || mayOwnTokens) && (
          <button
            type="button"
            class="small"
            onClick={() => {
              studio.layout.sheet.value = "accounts";
            }}
          >
            {say(mayChangePeople ? "accounts.open" : "accounts.open.own")}
          </button>
        )}
        {isLetIn && (
          <button type="button" class="small" onClick={leave}>
            {say("settings.account.leave")}
          </button>
        )}
      </div>
      {trouble !== "" && <p role="alert">{trouble}</p>}
    </section>
  );
}
