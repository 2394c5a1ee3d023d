import type { Device, Person } from "../../../wire/generated";
import { personColour } from "../../document/timeline/authors";
import type { Studio } from "../../studio";
import type { Governing } from "../../together/governing";
import { companions, isReplaying, nameOf } from "../../together/people";
import { descriptorOf, TOOL_NAMES } from "../../tools/tools";
import { say } from "../../words/say";
import { KeptOutAndHeir, PersonActs, useGoverning } from "./governing";

/** Who has the tree open, where they are, and what they do; to follow them, or to bring them here. */
export function PeopleSheet({ studio }: { studio: Studio }) {
  const { together, layout, rights, toasts } = studio;
  const here = together.people.value;
  const others = companions(here);
  const governing = useGoverning(studio);
  const close = () => {
    layout.sheet.value = null;
  };
  const gather = () => {
    if (together.listener?.gather()) {
      toasts.show(say("together.gather.done"));
      close();
    }
  };
  return (
    <div class="stack">
      {others.length === 0 && <p>{say("together.alone")}</p>}
      <ul class="people">
        {here?.people.map((person) => (
          <PersonRow
            key={person.person}
            studio={studio}
            person={person}
            you={here.you}
            close={close}
            governing={governing}
          />
        ))}
      </ul>
      {here !== null && here.more > 0 && <p class="quiet">{say("together.more", { count: here.more })}</p>}
      {rights.mayGovern && <KeptOutAndHeir governing={governing} />}
      <label class="field">
        <span>{say("together.name")}</span>
        <input
          type="text"
          maxLength={80}
          value={studio.settings.author.value}
          onChange={({ currentTarget }) => {
            studio.settings.author.value = currentTarget.value.trim();
          }}
        />
      </label>
      {others.length > 0 && rights.mayChange.value && (
        <>
          <div class="actions">
            <button type="button" class="primary" onClick={gather}>
              {say("together.gather")}
            </button>
          </div>
          <p class="quiet">{say("together.gather.advice")}</p>
        </>
      )}
    </div>
  );
}

interface PersonRowProps {
  readonly studio: Studio;
  readonly person: Person;
  /** This page's own device. */
  readonly you: number;
  readonly close: () => void;
  readonly governing: Governing;
}

function PersonRow({ studio, person, you, close, governing }: PersonRowProps) {
  const isYou = person.devices.some(({ device }) => device === you);
  const name = nameOf(person);
  const { followed } = studio.together;
  return (
    <li style={{ "--person": personColour(person.person) }} data-person={person.person}>
      <i class="person-dot" />
      <div>
        <strong>{isYou ? say("together.you", { name }) : name}</strong>
        <span class="quiet">
          {say(`together.role.${person.role}`)}
          {person.devices.length > 1 && ` · ${say("together.devices", { count: person.devices.length })}`}
        </span>
        {person.devices.map((device, i) => (
          <p class="person-device" key={device.device} data-state={device.state}>
            {person.devices.length > 1 && (
              <span>
                {device.device === you ? say("together.device.this") : say("together.device", { number: i + 1 })}
              </span>
            )}
            <span class="quiet">{doing(studio, device)}</span>
            {device.device !== you && !isReplaying(device) && (
              <button
                type="button"
                class="small"
                aria-pressed={followed.value === device.device}
                onClick={() => {
                  const isFollowed = followed.peek() === device.device;
                  studio.together.listener?.follow(isFollowed ? null : device.device);
                  if (!isFollowed) {
                    close();
                  }
                }}
              >
                {say(followed.value === device.device ? "together.stop" : "together.follow")}
              </button>
            )}
          </p>
        ))}
        {!isYou && studio.rights.mayGovern && (
          <PersonActs studio={studio} person={person} name={name} governing={governing} />
        )}
      </div>
    </li>
  );
}

/** Where somebody is, and what they do there. */
function doing(studio: Studio, device: Device): string {
  const { state, tool, follows } = device;
  if (isReplaying(device)) {
    return say("together.replays");
  }
  if (state !== "here") {
    return say(`together.${state}`);
  }
  const followed = companions(studio.together.people.value).find(({ device }) => device.device === follows);
  const own = follows !== undefined && follows === studio.together.people.value?.you;
  if (followed || own) {
    const people = studio.together.people.value?.people ?? [];
    const person = people.find(({ devices }) => devices.some(({ device }) => device === follows));
    return say("together.follows", { name: person ? nameOf(person) : "" });
  }
  if (tool === "grammar") {
    return say("together.here.writes");
  }
  const known = TOOL_NAMES.find((name) => name === tool);
  return known ? say("together.here.tool", { tool: say(descriptorOf(known).label) }) : say("together.here");
}
