import type { ServerMessage } from "../../wire/generated";

/** Messages of the server that the connection itself answers or keeps account of. */
type ConnectionMessageType = "loading" | "welcome" | "acknowledged" | "refused" | "checksum";

/** The others, which say what the page has to show. */
export type PageMessage = Exclude<ServerMessage, { type: ConnectionMessageType }>;

/** What the page does with each message: a row for each type, or it does not compile. */
export type MessageHandlers = {
  readonly [Type in PageMessage["type"]]: (message: Extract<PageMessage, { type: Type }>) => void;
};

/** Hands a message to the handler of its type; a type that this page does not know is left alone. */
export function handle(handlers: MessageHandlers, message: PageMessage): void {
  if (Object.hasOwn(handlers, message.type)) {
    // The row of a type takes the messages of that type, which TypeScript does not follow through the look-up.
    (handlers[message.type] as (message: PageMessage) => void)(message);
  }
}
