import { randomUUID } from "node:crypto";
import type { Page } from "playwright-core";
import { PROTOCOL_VERSION } from "../../../client/src/wire/generated";

/**
 * Has a page do commands in a session, one after the other, over a WebSocket as the client's own, and waits until all that
 * they ask for is `done`, or only until they are `acknowledged` and may still be growing.
 */
export async function perform(
  page: Page,
  session: string,
  commands: readonly string[],
  awaited: "done" | "acknowledged" = "done",
): Promise<void> {
  const problem = await page.evaluate(
    ({ protocol, client, session, commands, awaited }) =>
      new Promise<string | null>((resolve) => {
        // So many commands may be on their way; the server reads on while it grows.
        const ahead = 64;
        // And so many may wait to be done; a server takes 1,024 of one client at most (LM23).
        const waiting = 900;
        let [sent, taken, done] = [0, 0, 0];
        const socket = new WebSocket(`${location.origin.replace("http", "ws")}/api/v1/sessions/${session}/socket`);
        // Nothing is drawn here: frames that nobody answers are not sent again, and hold nothing up.
        socket.binaryType = "arraybuffer";
        const send = () => {
          while (sent < commands.length && sent - taken < ahead && sent - done < waiting) {
            sent += 1;
            socket.send(`{"type":"command","id":${sent},"command":${commands[sent - 1]}}`);
          }
        };
        const end = (sentence: string | null) => {
          socket.onclose = null;
          socket.close();
          resolve(sentence);
        };
        socket.onopen = () => socket.send(JSON.stringify({ type: "hello", protocol, client }));
        socket.onclose = ({ code, reason }) =>
          end(`the server closed the socket with ${code}, "${reason}", after line ${taken}`);
        socket.onmessage = ({ data }) => {
          if (typeof data !== "string") return;
          const message = JSON.parse(data);
          if (message.type === "refused") end(`line ${message.id}: ${JSON.stringify(message.problem)}`);
          if (message.type === "problem") end(JSON.stringify(message.problem));
          if (message.type === "acknowledged") taken = message.id;
          if (message.type === "done") done = message.id;
          if (["welcome", "acknowledged", "done"].includes(message.type)) send();
          // What was taken may still be refused until it is done.
          if (message.type === awaited && message.id === commands.length) end(null);
        };
      }),
    { protocol: PROTOCOL_VERSION, client: randomUUID(), session, commands, awaited },
  );
  if (problem !== null) throw new Error(problem);
}
