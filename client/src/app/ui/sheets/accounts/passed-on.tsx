import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { SecretField } from "./secret-field";

/** A password that somebody else was given, which is known here alone. */
export interface PassedOn {
  readonly kind: "added" | "changed";
  readonly name: string;
  readonly password: string;
}

interface PassOnProps {
  readonly studio: Studio;
  readonly passedOn: PassedOn;
  readonly onDone: () => void;
}

/** What somebody needs to log in, until it was passed on. */
export function PassOn({ studio, passedOn: { kind, name, password }, onDone }: PassOnProps) {
  return (
    <div class="fresh-link" role="status">
      <p>{say(`accounts.people.${kind}`, { name })}</p>
      <SecretField studio={studio} label={say("accounts.address")} text={location.origin} />
      <SecretField studio={studio} label={say("accounts.password")} text={password} />
      <button type="button" class="small" onClick={onDone}>
        {say("accounts.people.done")}
      </button>
    </div>
  );
}
