import { may } from "../../access/rights";
import type { Studio } from "../../studio";
import { type Companion, companions } from "../../together/people";
import { language, say } from "../../words/say";

/** So many people are shown by their first letters; of the others there is a number. */
const SHOWN = 4;

/** Who else is here, and whose camera is followed. */
export function CompanyChips({ studio }: { studio: Studio }) {
  const { together, layout } = studio;
  const all = companions(together.people.value);
  if (all.length === 0) {
    return null;
  }
  const followed = all.find(({ device }) => device.device === together.followed.value);
  const people = [...new Map(all.map((one) => [one.person.person, one])).values()];
  const names = new Intl.ListFormat(language.value).format(
    people.map(({ name, person }) => `${name} (${say(`together.role.${person.role}`)})`),
  );
  return (
    <>
      <button
        type="button"
        class="people-chip"
        aria-label={say("together.show", { names })}
        title={say("together.show", { names })}
        onClick={() => {
          layout.sheet.value = "people";
        }}
      >
        {people.slice(0, SHOWN).map((one) => (
          <Badge key={one.person.person} one={one} />
        ))}
        {people.length > SHOWN && <span class="person-badge">+{people.length - SHOWN}</span>}
      </button>
      {followed && (
        <p class="chip" style={{ "--person": followed.colour }} data-following={followed.device.device}>
          <i class="person-dot" />
          {say("together.following", { name: followed.name })}
          <button type="button" class="chip-stop" onClick={() => studio.together.listener?.follow(null)}>
            {say("together.stop")}
          </button>
        </p>
      )}
    </>
  );
}

/** Somebody by the first letter of their name, in their colour. */
function Badge({ one: { person, name, colour } }: { one: Companion }) {
  // Who may draw has a full badge, who may only look or comment a hollow one.
  const mayDraw = may(person.role, "EditSession");
  const isHere = person.devices.some(({ state }) => state === "here");
  return (
    <span
      class="person-badge"
      style={{ "--person": colour }}
      data-state={isHere ? "here" : "away"}
      data-draws={mayDraw}
    >
      {[...name][0]?.toUpperCase()}
    </span>
  );
}
