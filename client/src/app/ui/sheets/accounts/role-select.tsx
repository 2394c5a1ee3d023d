import { ROLES, type Role } from "../../../../wire/generated";
import { say } from "../../../words/say";
import { Pick } from "../library/pick";

/** What somebody may have by themselves, the least first. */
export const USER_ROLES: readonly Role[] = ["none", ...ROLES];

interface RoleSelectProps<Chosen extends Role> {
  readonly label: string;
  /** Whether the label is shown above it. */
  readonly isLabelled?: boolean;
  readonly roles: readonly Chosen[];
  readonly chosen: Chosen;
  readonly disabled?: boolean;
  readonly onChoose: (role: Chosen) => void;
}

/** One of the roles, by what it allows. */
export function RoleSelect<Chosen extends Role>(props: RoleSelectProps<Chosen>) {
  const { label, isLabelled = false, roles, chosen, disabled = false, onChoose } = props;
  // What somebody has is shown also where nobody is given it any more.
  const offered = roles.includes(chosen) ? roles : [...roles, chosen];
  const options = offered.map((role) => [role, say(`accounts.role.${role}`)] as const);
  const pick = <Pick label={label} value={chosen} options={options} disabled={disabled} onPick={onChoose} />;
  return isLabelled ? (
    <div class="field">
      <span aria-hidden="true">{label}</span>
      {pick}
    </div>
  ) : (
    pick
  );
}
