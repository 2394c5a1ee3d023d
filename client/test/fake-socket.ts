import type { Socket } from "../src/app/connection/connection";
import { type DocumentState, type Parameters, PROTOCOL_VERSION, type ServerMessage } from "../src/wire/generated";

/** A socket whose server is the test. */
export class FakeSocket implements Socket {
  binaryType = "";
  onopen: ((event: Event) => void) | null = null;
  onmessage: ((event: MessageEvent) => void) | null = null;
  onclose: ((event: CloseEvent) => void) | null = null;
  sent: { type: string; client?: string; id?: number; sequence?: number; kind?: number; rows?: number[] }[] = [];
  closed = false;
  send(text: string) {
    this.sent.push(JSON.parse(text));
  }
  close() {
    this.closed = true;
  }
  say(message: ServerMessage) {
    this.arrive(JSON.stringify(message));
  }
  arrive(data: unknown) {
    this.onmessage?.({ data } as MessageEvent);
  }
  end(code: number, reason = "") {
    this.onclose?.({ code, reason } as CloseEvent);
  }
  begin() {
    this.onopen?.({} as Event);
  }
  welcome(acknowledged = 0) {
    this.begin();
    const state = { step: 0 } as DocumentState;
    const parameters = {} as Parameters;
    const head = { protocol: PROTOCOL_VERSION, session: "s", epoch: 1, resumed: false };
    this.say({ type: "welcome", ...head, acknowledged, parameters, state });
  }
  /** A frame of the test is one byte, its sequence; then how long decoding takes, its kind and its epoch. */
  frame(sequence: number, turns: number, kind = 1, epoch = 1) {
    this.arrive(new Uint8Array([sequence, turns, kind, epoch]).buffer);
  }
  get received() {
    return this.sent.flatMap(({ type, sequence, kind = 1 }) => (type === "received" && kind === 1 ? [sequence] : []));
  }
  get commands() {
    return this.sent.flatMap((message) => (message.type === "command" ? [message.id] : []));
  }
}
