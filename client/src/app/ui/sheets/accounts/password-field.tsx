import { suggestedPassword } from "../../../access/suggested-password";
import { say } from "../../../words/say";

/** So many characters a password has. */
export const PASSWORD_CHARACTERS = { least: 8, most: 200 } as const;

interface PasswordFieldProps {
  readonly label: string;
  readonly password: string;
  readonly onChange: (password: string) => void;
}

/** A password for somebody else: it is seen, for it is passed on. */
export function PasswordField({ label, password, onChange }: PasswordFieldProps) {
  return (
    <div class="secret">
      <label class="field">
        <span>{label}</span>
        <input
          type="text"
          autocomplete="off"
          autocapitalize="none"
          spellcheck={false}
          minLength={PASSWORD_CHARACTERS.least}
          maxLength={PASSWORD_CHARACTERS.most}
          placeholder={say("accounts.password.length", PASSWORD_CHARACTERS)}
          value={password}
          onInput={({ currentTarget }) => onChange(currentTarget.value)}
        />
      </label>
      <button type="button" class="small" onClick={() => onChange(suggestedPassword())}>
        {say("accounts.password.suggest")}
      </button>
    </div>
  );
}
