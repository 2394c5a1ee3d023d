import { useState } from "preact/hooks";
import { logOut } from "../../entry/account";
import { ENTRY_PATH } from "../../entry/ask-to-enter";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** As whom this browser is let in, and the way out. Nobody has to be let in at the machine itself. */
export function AccountSection({ studio }: { studio: Studio }) {
  const [trouble, setTrouble] = useState("");
  const me = studio.rights.me.value;
  if (me === null || me.way === "machine") {
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
      <p>{say(me.way === "login" ? "settings.account.login" : "settings.account.device", { name, role })}</p>
      {me.way === "device" && <p class="quiet">{say("settings.account.again")}</p>}
      <button type="button" class="small" onClick={leave}>
        {say("settings.account.leave")}
      </button>
      {trouble !== "" && <p role="alert">{trouble}</p>}
    </section>
  );
}
