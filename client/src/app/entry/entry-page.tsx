import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import { followChoices } from "../page/language-and-theme";
import { loadSettings } from "../page/settings";
import { laterWords } from "../words/later-words";
import { say } from "../words/say";
import { entrance, logIn } from "./account";
import { redeem, secretIn } from "./invitation";
import { LogIn } from "./log-in";
import { useEntering } from "./use-entering";
import "./entry-page.css";

/**
 * Shows the page where one comes in: at once where the address has an invitation, else when its code is given, or a name
 * and a password where anybody has one here.
 */
export async function showEntry(root: HTMLElement): Promise<void> {
  followChoices(loadSettings(localStorage), () => {});
  const [{ passwords }] = await Promise.all([entrance(), laterWords()]);
  const secret = secretIn(location.hash.slice(1));
  // Whoever looks at the address or goes back does not find it.
  history.replaceState(null, "", location.pathname + location.search);
  render(<EntryPage invited={secret} passwords={passwords} />, root);
}

function EntryPage({ invited, passwords }: { invited: string; passwords: boolean }) {
  const [code, setCode] = useState("");
  const [account, setAccount] = useState({ name: "", password: "" });
  const [byPassword, setByPassword] = useState(passwords && invited === "");
  const { entering, trouble, enter, forgive } = useEntering(invited !== "");
  const comeIn = (secret: string) => enter(() => redeem(secret, location.search));
  useEffect(() => {
    if (invited !== "") {
      void comeIn(invited);
    }
  }, [invited]);
  /** An invitation that came with the address is being used: there is nothing to type. */
  const isInvited = entering && code === "";
  const turn = () => {
    setByPassword(!byPassword);
    forgive();
  };
  return (
    <main class="entry">
      <form
        class="panel entry-card"
        aria-busy={entering}
        onSubmit={(event) => {
          event.preventDefault();
          void (byPassword ? enter(() => logIn(account, location.search)) : comeIn(secretIn(code)));
        }}
      >
        <p class="entry-sign">
          <img src="/icon.svg" alt="" width="72" height="72" />
          {say("entry.name")}
        </p>
        {byPassword ? (
          <LogIn account={account} setAccount={setAccount} trouble={trouble} entering={entering} />
        ) : isInvited ? (
          <h1>{say("entry.entering")}</h1>
        ) : (
          <Knocking code={code} setCode={setCode} trouble={trouble} entering={entering} />
        )}
        {passwords && (
          <button type="button" class="small" disabled={entering} onClick={turn}>
            {say(byPassword ? "entry.by-code" : "entry.by-password")}
          </button>
        )}
        {!byPassword && !isInvited && (
          <p class="entry-host">
            {say("entry.host")} <code>{say("entry.invite")}</code>
          </p>
        )}
      </form>
    </main>
  );
}

interface KnockingProps {
  readonly code: string;
  readonly setCode: (code: string) => void;
  readonly trouble: string;
  readonly entering: boolean;
}

/** What to do without an invitation, or with one that is no good. */
function Knocking({ code, setCode, trouble, entering }: KnockingProps) {
  return (
    <>
      <h1>{say("entry.title")}</h1>
      {trouble !== "" && (
        <p class="entry-trouble" role="alert">
          {trouble}
        </p>
      )}
      <p>{say("entry.text")}</p>
      <label class="field">
        {say("entry.code")}
        <input
          type="text"
          autocomplete="off"
          autocapitalize="none"
          enterkeyhint="go"
          spellcheck={false}
          value={code}
          onInput={(event) => setCode(event.currentTarget.value)}
        />
      </label>
      <button type="submit" class="primary" disabled={entering || secretIn(code) === ""}>
        {say(entering ? "entry.entering" : "entry.enter")}
      </button>
    </>
  );
}
