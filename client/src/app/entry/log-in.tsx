import { say } from "../words/say";
import type { Account } from "./account";

interface LogInProps {
  readonly account: Account;
  readonly setAccount: (account: Account) => void;
  readonly trouble: string;
  readonly entering: boolean;
}

/** Asks for name and password. */
export function LogIn({ account, setAccount, trouble, entering }: LogInProps) {
  const { name, password } = account;
  return (
    <>
      <h1>{say("entry.login.title")}</h1>
      {trouble !== "" && (
        <p class="entry-trouble" role="alert">
          {trouble}
        </p>
      )}
      <label class="field">
        {say("entry.login.name")}
        <input
          type="text"
          name="username"
          autocomplete="username"
          autocapitalize="none"
          enterkeyhint="next"
          spellcheck={false}
          value={name}
          onInput={(event) => setAccount({ name: event.currentTarget.value, password })}
        />
      </label>
      <label class="field">
        {say("entry.login.password")}
        <input
          type="password"
          name="password"
          autocomplete="current-password"
          enterkeyhint="go"
          value={password}
          onInput={(event) => setAccount({ name, password: event.currentTarget.value })}
        />
      </label>
      <button type="submit" class="primary" disabled={entering || name.trim() === "" || password === ""}>
        {say(entering ? "entry.entering" : "entry.login.enter")}
      </button>
    </>
  );
}
