import type { MemberRole, TreeMember } from "../../../../wire/generated";
import type { Gifts } from "../../../library/gifts/gifts";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { RoleSelect } from "../accounts/role-select";

/** What somebody can be given something as, the least first. */
const MEMBER_ROLES = ["viewer", "commenter", "editor", "owner"] as const satisfies readonly MemberRole[];

/** As what somebody can give: owners of the server alone give something to own (`AC22`). */
export function rolesToGive(studio: Studio): readonly MemberRole[] {
  return studio.rights.mayShare ? MEMBER_ROLES : MEMBER_ROLES.filter((role) => role !== "owner");
}

interface GiftRowProps {
  readonly studio: Studio;
  readonly gifts: Gifts;
  readonly member: TreeMember;
  /** They have it no longer. */
  readonly onTaken: () => void;
}

/** Who was given it: what they may do with it, and a way to take it back. */
export function GiftRow({ studio, gifts, member, onTaken }: GiftRowProps) {
  const { name, group, role } = member;
  const isTheirs = rolesToGive(studio).includes(role as MemberRole);
  /** Whether they have it so; they may be gone by now. */
  const give = async (as: MemberRole) => {
    const giving = await gifts.give({ name, group, role: as });
    if (giving === "nobody") {
      studio.toasts.show(say(group ? "gifts.nobody.group" : "gifts.nobody.user", { name }));
    }
    return giving === "given";
  };
  const show = (text: string) =>
    studio.toasts.show(text, { label: say("gifts.undo"), act: () => void give(role as MemberRole) });
  const allow = async (next: MemberRole) => {
    if (await give(next)) {
      show(mayText(member, next));
    }
  };
  const takeBack = async () => {
    if (await gifts.takeBack(member)) {
      show(say("gifts.taken", { name }));
      onTaken();
    }
  };
  return (
    <li class="account-row gift-row" data-member={name}>
      <div class="account-head">
        <div>
          <strong>{name}</strong>
          {group && <span class="quiet gift-group">{say("gifts.group")}</span>}
        </div>
        <RoleSelect
          label={say("accounts.role.of", { name })}
          roles={isTheirs ? rolesToGive(studio) : [role as MemberRole]}
          chosen={role as MemberRole}
          disabled={!isTheirs}
          onChoose={(next) => void allow(next)}
        />
        <button
          type="button"
          class="small"
          aria-label={say("gifts.take-back.which", { name })}
          disabled={!isTheirs}
          onClick={() => void takeBack()}
        >
          {say("gifts.take-back")}
        </button>
      </div>
    </li>
  );
}

/** What somebody may from now on. */
export function mayText({ name, group = false }: { name: string; group?: boolean }, role: MemberRole): string {
  return say(group ? "accounts.groups.may" : "accounts.people.may", { name, role: say(`accounts.role.${role}`) });
}
