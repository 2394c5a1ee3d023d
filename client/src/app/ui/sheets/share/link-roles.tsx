import type { LinkRole, TreeLink } from "../../../../wire/generated";
import { LINK_ROLES } from "../../../library/links/lasting";
import { say } from "../../../words/say";

interface LinkRolesProps {
  readonly link: Pick<TreeLink, "name" | "role">;
  /** They may do that from now on. */
  readonly onChange: (role: LinkRole) => Promise<void>;
}

/** Ways to let somebody who was invited do more or less, which holds at once. */
export function LinkRoles({ link: { name, role }, onChange }: LinkRolesProps) {
  return LINK_ROLES.filter((other) => other !== role).map((other) => {
    const what = say(`links.let.${other}`);
    return (
      <button
        key={other}
        type="button"
        class="small"
        aria-label={say("links.let.which", { what, name })}
        onClick={() => void onChange(other)}
      >
        {what}
      </button>
    );
  });
}
