import { useEffect, useState } from "preact/hooks";
import type { ServerStatus } from "../../../wire/generated";
import { explained } from "../../problems/explained";
import { ask } from "../../requests/request";
import type { Studio } from "../../studio";
import { countText } from "../../words/measure-text";
import { say } from "../../words/say";

/** How often it is looked again, in milliseconds. */
const AGAIN = 3000;
/** The largest sessions that are listed. */
const LISTED = 12;

/** How the server is, for owners (`SV2`): its memory, and what takes it. */
export function ServerSection({ studio }: { studio: Studio }) {
  const [status, setStatus] = useState<ServerStatus | null>(null);
  const [trouble, setTrouble] = useState("");
  const may = studio.rights.maySeeServer;
  useEffect(() => {
    if (!may) {
      return undefined;
    }
    let timer: ReturnType<typeof setTimeout> | undefined;
    let isOpen = true;
    const look = async () => {
      try {
        const found = await ask<ServerStatus>("GET", "/api/v1/status");
        setStatus(found);
        setTrouble("");
      } catch (error) {
        setTrouble(await explained(error));
      }
      if (isOpen) {
        timer = setTimeout(() => void look(), AGAIN);
      }
    };
    void look();
    return () => {
      isOpen = false;
      clearTimeout(timer);
    };
  }, [may]);
  if (!may || (status === null && trouble === "")) {
    return null;
  }
  return (
    <section class="account" aria-label={say("server.title")}>
      <h3>{say("server.title")}</h3>
      {trouble !== "" && <p role="alert">{trouble}</p>}
      {status !== null && <Figures status={status} own={studio.link.session.value} />}
    </section>
  );
}

function Figures({ status, own }: { status: ServerStatus; own: string | null }) {
  const memory = say("server.memory", { taken: mebibytes(status.taken_bytes), all: mebibytes(status.memory_bytes) });
  return (
    <>
      <p>
        {say("server.up", {
          version: status.version,
          hours: countText(Math.floor(status.up_seconds / 3600)),
          minutes: Math.floor(status.up_seconds / 60) % 60,
          sockets: countText(status.sockets),
        })}
      </p>
      <p>
        {memory} <progress aria-label={memory} max={status.memory_bytes} value={status.taken_bytes} />
      </p>
      {status.refused > 0 && <p>{say("server.refused", { count: countText(status.refused) })}</p>}
      <ul class="quiet">
        {status.sessions.slice(0, LISTED).map((session) => (
          <li key={session.name} data-session={session.name}>
            {say("server.session", {
              memory: mebibytes(session.memory_bytes),
              metamers: countText(session.metamers),
              people: session.people,
            })}
            {session.name === own && say("server.session.own")}
            {session.paused !== undefined && say(`server.session.${session.paused}`)}
          </li>
        ))}
      </ul>
      {status.sessions.length > LISTED && (
        <p class="quiet">{say("server.more", { count: countText(status.sessions.length - LISTED) })}</p>
      )}
    </>
  );
}

function mebibytes(bytes: number): string {
  return `${countText(Math.ceil(bytes / 1024 / 1024))} MiB`;
}
