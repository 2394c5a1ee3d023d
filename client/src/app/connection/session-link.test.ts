import { signal } from "@preact/signals";
import { afterEach, describe, expect, it, vi } from "vitest";
import { FakeSocket } from "../../../test/fake-socket";
import { Virtual } from "../../../test/virtual-clock";
import { CloseCode } from "../../wire/generated";
import type { Hindrance } from "../page/hindrance";
import { RequestFailed } from "../requests/request";
import { type SessionEvents, SessionLink } from "./session-link";

/** A server of sessions that begins them under the names given, one after the other; silent when they run out. */
function serveSessions(known: readonly string[], fresh: readonly string[]) {
  const names = [...fresh];
  const asked: string[] = [];
  vi.stubGlobal("fetch", async (path: string, { method }: { method: string }) => {
    asked.push(`${method} ${path}`);
    const name = method === "POST" ? names.shift() : known.find((session) => path.endsWith(`/${session}`));
    if (name === undefined && method === "POST") {
      throw new TypeError("nobody answers");
    }
    return new Response(JSON.stringify({ session: name }), { status: name === undefined ? 404 : 200 });
  });
  return { asked, names };
}

function storage(): Storage {
  const items = new Map<string, string>();
  return {
    getItem: (key: string) => items.get(key) ?? null,
    setItem: (key: string, value: string) => void items.set(key, value),
    removeItem: (key: string) => void items.delete(key),
  } as unknown as Storage;
}

function setUp(
  path = "/",
  {
    last = null as string | null,
    store = storage(),
    begun = false,
    rights = async () => ({ mayBegin: true, onlyTree: null as string | null }),
  } = {},
) {
  const sockets: { address: string; socket: FakeSocket }[] = [];
  const clock = new Virtual();
  const location = { pathname: path, protocol: "https:", host: "trees", reload: vi.fn(), replace: vi.fn() };
  const visit = (_: unknown, __: string, to?: string | URL | null) => {
    location.pathname = String(to);
  };
  const hindrance = signal<Hindrance | null>(null);
  const lastSession = signal<string | null>(last);
  const calls: string[] = [];
  const messages: string[] = [];
  const tells = (name: string) => () => void calls.push(name);
  const nothing = () => {};
  const events: SessionEvents = {
    opened: tells("opened"),
    leaving: tells("leaving"),
    lost: tells("lost"),
    parted: tells("parted"),
    failed: tells("failed"),
    choosing: tells("choosing"),
    rows: nothing,
    settled: nothing,
    message: ({ type }) => void messages.push(type),
    aside: nothing,
    refused: nothing,
    rekeyed: nothing,
    renumbered: nothing,
  };
  const link = new SessionLink({
    page: {
      location,
      history: { pushState: vi.fn(visit), replaceState: vi.fn(visit) },
      store,
      clock,
      openSocket: (address) => {
        const socket = new FakeSocket();
        sockets.push({ address, socket });
        return socket;
      },
    },
    rows: { held: () => undefined, apply: nothing, clear: nothing, sum: async () => ({ rows: 0, crc32: 0 }) },
    hindrance,
    dark: () => false,
    lastSession,
    rights,
    begun: () => begun,
    events,
  });
  const newest = () => sockets.at(-1)!.socket;
  const addresses = () => sockets.map(({ address }) => address.split("/").at(-2));
  return { link, clock, location, hindrance, lastSession, calls, messages, store, sockets, newest, addresses };
}

afterEach(() => vi.unstubAllGlobals());

describe("the session a page opens with", () => {
  it("is the one its address names", async () => {
    const { asked } = serveSessions([], []);
    const { link, sockets, lastSession } = setUp("/s/oak");
    await link.start();
    expect(sockets.map(({ address }) => address)).toEqual(["wss://trees/api/v1/sessions/oak/socket"]);
    expect([link.session.peek(), lastSession.peek(), asked]).toEqual(["oak", "oak", []]);
  });

  it("else that of last time, if it is still there", async () => {
    serveSessions(["elm"], ["new"]);
    const there = setUp("/", { last: "elm" });
    await there.link.start();
    expect([there.link.session.peek(), there.location.pathname]).toEqual(["elm", "/s/elm"]);
    const gone = setUp("/", { last: "ash" });
    await gone.link.start();
    expect([gone.link.session.peek(), gone.location.pathname]).toEqual(["new", "/s/new"]);
  });

  it("is asked for again while no server answers", async () => {
    const { names } = serveSessions([], []);
    const { link, clock, hindrance } = setUp();
    await link.start();
    expect([hindrance.peek(), link.session.peek()]).toEqual(["no-server", null]);
    names.push("late");
    clock.pass(2000);
    await vi.waitFor(() => expect(link.session.peek()).toBe("late"));
    expect(hindrance.peek()).toBeNull();
  });

  it("AC2: is asked for at the door by whoever is not let in", async () => {
    const refused = { code: "refused", reason: "not-let-in", message: "Ask for the code." } as const;
    const { asked } = serveSessions([], []);
    const first = setUp("/", { rights: () => Promise.reject(new RequestFailed(401, refused)) });
    await first.link.start();
    expect([first.location.replace.mock.calls, first.hindrance.peek(), asked]).toEqual([[["/pair"]], null, []]);
    const named = setUp("/s/oak");
    await named.link.start();
    named.newest().end(CloseCode.CannotOpen, "not-let-in: Ask for the code.");
    expect(named.location.replace).toHaveBeenCalledWith("/pair?to=%2Fs%2Foak");
  });

  it("is asked for again where the server does not say who is here", async () => {
    const { asked } = serveSessions([], ["late"]);
    const answers = [Promise.reject(new RequestFailed(0, { code: "unavailable", message: "Silence." }))];
    const { link, clock, hindrance } = setUp("/", {
      rights: () => answers.shift() ?? Promise.resolve({ mayBegin: true, onlyTree: null }),
    });
    await link.start();
    expect([hindrance.peek(), asked]).toEqual(["no-server", []]);
    clock.pass(2000);
    await vi.waitFor(() => expect(link.session.peek()).toBe("late"));
  });

  it("AC5: is that of the only tree for a guest, whatever was open before", async () => {
    const asked: string[] = [];
    vi.stubGlobal("fetch", async (path: string, { method, body = "" }: { method: string; body?: string }) => {
      asked.push(`${method} ${path} ${body}`);
      return new Response(JSON.stringify({ session: "oak" }), { status: 201 });
    });
    const rights = async () => ({ mayBegin: false, onlyTree: "ash" });
    for (const last of [null, "elm"]) {
      const { link, hindrance, location } = setUp("/", { last, rights });
      await link.start();
      expect([link.session.peek(), location.pathname, hindrance.peek()]).toEqual(["oak", "/s/oak", null]);
    }
    expect(asked).toEqual(Array(2).fill('POST /api/v1/sessions {"tree":"ash"}'));
  });

  it("AC5: is said not to be had where a guest's tree is gone, and asked for again where nobody answers", async () => {
    const refused = { code: "refused", reason: "forbidden", detail: "You may not do this here." };
    const rights = async () => ({ mayBegin: false, onlyTree: "ash" });
    vi.stubGlobal("fetch", async () => new Response(JSON.stringify(refused), { status: 403 }));
    const guest = setUp("/", { rights });
    await guest.link.start();
    expect([guest.hindrance.peek(), guest.link.refusal.peek()]).toEqual(["cannot-open", "You may not do this here."]);
    const { names } = serveSessions([], []);
    const waiting = setUp("/", { rights });
    await waiting.link.start();
    expect(waiting.hindrance.peek()).toBe("no-server");
    names.push("oak");
    waiting.clock.pass(2000);
    await vi.waitFor(() => expect(waiting.link.session.peek()).toBe("oak"));
  });

  it("AC5: is that of last time, or one they choose, for whoever may only look at trees", async () => {
    const { asked } = serveSessions(["elm"], ["never"]);
    const rights = async () => ({ mayBegin: false, onlyTree: null });
    const first = setUp("/", { rights });
    await first.link.start();
    first.clock.pass(60_000);
    expect([first.hindrance.peek(), first.link.session.peek(), first.calls]).toEqual(["only-look", null, ["choosing"]]);
    expect(asked, "nothing is asked for that they may not have").toEqual([]);
    const again = setUp("/", { last: "elm", rights });
    await again.link.start();
    expect([again.link.session.peek(), again.hindrance.peek(), again.calls.includes("choosing")]).toEqual([
      "elm",
      null,
      false,
    ]);
    const gone = setUp("/", { last: "ash", rights });
    await gone.link.start();
    expect(gone.hindrance.peek()).toBe("only-look");
    expect(asked).toEqual(["GET /api/v1/sessions/elm", "GET /api/v1/sessions/ash"]);
  });

  it("is not put in place of one that was opened meanwhile", async () => {
    serveSessions([], ["slow"]);
    const { link, location, addresses } = setUp();
    const started = link.start();
    location.pathname = "/s/oak";
    link.navigated();
    await started;
    expect([link.session.peek(), location.pathname, addresses()]).toEqual(["oak", "/s/oak", ["oak"]]);
  });
});

describe("another session", () => {
  it("is opened under an address of its own, and the way back works", async () => {
    serveSessions([], ["new"]);
    const { link, location, calls, addresses } = setUp("/s/oak");
    await link.start();
    expect(await link.change()).toMatchObject({ session: "new" });
    expect([link.session.peek(), location.pathname]).toEqual(["new", "/s/new"]);
    location.pathname = "/s/oak";
    link.navigated();
    expect(addresses()).toEqual(["oak", "new", "oak"]);
    expect(calls.filter((name) => name === "opened").length).toBe(3);
  });

  it("is begun once, however often somebody taps", async () => {
    const { asked } = serveSessions([], ["one", "two"]);
    const { link } = setUp("/s/oak");
    await link.start();
    expect(await Promise.all([link.change(), link.change()])).toMatchObject([{ session: "one" }, null]);
    expect(asked).toEqual(["POST /api/v1/sessions"]);
    expect(await link.change(), "and later again").not.toBeNull();
  });

  it("that is not to be had leaves everything as it is", async () => {
    serveSessions([], []);
    const { link, calls, location } = setUp("/s/oak");
    await link.start();
    expect(await link.change()).toBeNull();
    expect([link.session.peek(), location.pathname, calls.at(-1)]).toEqual(["oak", "/s/oak", "failed"]);
  });

  it("CM1: what was unsent goes out on the way back", async () => {
    serveSessions([], ["new"]);
    const { link, location, newest, calls } = setUp("/s/oak");
    await link.start();
    link.submit({ kind: "undo" });
    await link.change();
    expect(calls, "nobody was there to take it").toContain("parted");
    newest().welcome();
    expect(newest().commands).toEqual([]);
    location.pathname = "/s/oak";
    link.navigated();
    newest().welcome();
    expect(newest().commands).toEqual([1]);
  });
});

describe("a replay", () => {
  it("RP1: is a copy of the session on a socket of its own, which leaves nothing behind", async () => {
    serveSessions([], []);
    const { link, newest, sockets, lastSession, store, calls } = setUp("/s/oak");
    await link.start();
    newest().welcome();
    link.replay(true);
    expect(sockets.at(-1)!.address).toBe("wss://trees/api/v1/sessions/oak/replay");
    expect([link.replaying.value, link.session.value, lastSession.value]).toEqual([true, "oak", "oak"]);
    newest().welcome();
    link.submit({ kind: "go_to", step: 0 });
    link.leaving();
    const after = setUp("/s/oak", { store });
    await after.link.start();
    after.newest().welcome();
    expect(after.newest().commands, "nothing of it goes to the session").toEqual([]);
    link.replay(false);
    expect(sockets.at(-1)!.address).toBe("wss://trees/api/v1/sessions/oak/socket");
    newest().welcome();
    expect([link.replaying.value, newest().commands]).toEqual([false, []]);
    expect(calls).not.toContain("parted");
  });

  it("PS3: leaves the page in the session, as the device that it is, to say so and to be told who else is there", async () => {
    serveSessions([], []);
    const { link, newest, sockets, messages } = setUp("/s/oak");
    await link.start();
    newest().welcome();
    const keys = () => sockets.map(({ socket }) => socket.sent.flatMap(({ client }) => client ?? [])[0]);
    link.replay(true);
    expect(sockets.slice(1).map(({ address }) => address.split("/").at(-1))).toEqual(["socket", "replay"]);
    const [, seat, replay] = sockets.map(({ socket }) => socket);
    replay!.welcome();
    expect(link.present.value, "the copy is not the session").toBe(false);
    seat!.welcome();
    expect(link.present.value).toBe(true);
    expect(keys()[1]).toBe(keys()[0]);
    expect(keys()[2]).not.toBe(keys()[0]);
    link.tell({ type: "here", away: true });
    link.tell({ type: "ping", nonce: 7 });
    expect(seat!.sent.map(({ type }) => type)).toEqual(["hello", "here"]);
    expect(replay!.sent.map(({ type }) => type)).toEqual(["hello", "ping"]);
    messages.splice(0);
    seat!.say({ type: "people", people: [], more: 0, you: 1 });
    seat!.say({ type: "widths", widths: [] });
    expect(messages, "of what is done there the copy shows nothing").toEqual(["people"]);
    seat!.end(1006);
    expect(link.present.value).toBe(false);
    link.replay(false);
    newest().welcome();
    expect(keys().at(-1)).toBe(keys()[0]);
    expect([link.present.value, replay!.closed]).toEqual([true, true]);
  });

  it("CM1: what was unsent before goes out meanwhile, and once", async () => {
    serveSessions([], []);
    const { link, sockets, newest } = setUp("/s/oak");
    await link.start();
    newest().welcome();
    link.submit({ kind: "undo" });
    link.replay(true);
    const seat = sockets.at(-2)!.socket;
    seat.welcome();
    expect(seat.commands).toEqual([1]);
    seat.say({ type: "acknowledged", id: 1 });
    link.replay(false);
    newest().welcome(1);
    expect(newest().commands).toEqual([]);
  });

  it("CM1: what was unsent before it goes out after it", async () => {
    serveSessions([], []);
    const { link, newest } = setUp("/s/oak");
    await link.start();
    link.submit({ kind: "undo" });
    link.replay(true);
    newest().welcome();
    expect(newest().commands).toEqual([]);
    link.replay(false);
    newest().welcome();
    expect(newest().commands).toEqual([1]);
  });
});

describe("a page that goes", () => {
  it("CM1: leaves what is unsent to the page after it", async () => {
    const before = setUp("/s/oak");
    await before.link.start();
    before.newest().welcome();
    before.link.submit({ kind: "undo" });
    before.link.leaving();
    const after = setUp("/s/oak", { store: before.store });
    await after.link.start();
    after.newest().welcome();
    expect(after.newest().commands).toEqual([1]);
  });

  it("HS4: takes it back when it returns, so that no copy of the tab finds it", async () => {
    const { link, store, newest, calls } = setUp("/s/oak");
    await link.start();
    newest().welcome();
    link.submit({ kind: "undo" });
    link.leaving();
    expect(calls).toContain("leaving");
    link.returning();
    const copy = setUp("/s/oak", { store });
    await copy.link.start();
    copy.newest().welcome();
    expect(copy.newest().commands).toEqual([]);
  });
});

describe("what is in the way", () => {
  it("no server, after a few attempts, until there is one", async () => {
    const { link, hindrance, clock, newest } = setUp("/s/oak");
    await link.start();
    newest().end(1006);
    expect(hindrance.peek()).toBeNull();
    clock.pass(300);
    newest().end(1006);
    expect(hindrance.peek()).toBe("no-server");
    clock.pass(600);
    newest().welcome();
    expect([hindrance.peek(), link.phase.peek()]).toEqual([null, "connected"]);
  });

  it("nothing, where there is a tree to look at meanwhile", async () => {
    const { link, hindrance, clock, newest, calls } = setUp("/s/oak", { begun: true });
    await link.start();
    newest().welcome();
    for (let i = 0; i < 4; i++) {
      newest().end(1006);
      clock.pass(10_000);
    }
    expect([hindrance.peek(), calls.filter((name) => name === "lost")]).toEqual([null, ["lost"]]);
  });

  it("HS3: a session nobody knows, which is then not come back to", async () => {
    const { link, hindrance, lastSession, newest, calls } = setUp("/s/oak");
    await link.start();
    link.submit({ kind: "undo" });
    newest().end(CloseCode.UnknownSession);
    expect([hindrance.peek(), lastSession.peek()]).toEqual(["unknown-session", null]);
    link.leave();
    expect(calls, "nothing of it is kept").not.toContain("parted");
  });

  it("HS6: a session that cannot be opened, with the reason", async () => {
    const { link, hindrance, lastSession, newest, clock } = setUp("/s/oak");
    await link.start();
    newest().end(CloseCode.CannotOpen, "session-damaged: The session is damaged: 7.");
    clock.pass(600_000);
    expect(hindrance.peek()).toBe("cannot-open");
    await vi.waitFor(() => expect(link.refusal.peek()).toBe("The record of this tree is damaged."));
    expect(lastSession.peek(), "it is not come back to").toBeNull();
  });

  it("OP5: a session that the server did not outlive waits for an owner", async () => {
    for (const [reason, waits] of [
      ["session-waits", true],
      ["session-damaged", false],
    ] as const) {
      const { link, hindrance, newest } = setUp("/s/oak");
      await link.start();
      newest().end(CloseCode.CannotOpen, `${reason}: The server failed twice.`);
      await vi.waitFor(() => expect(link.refusal.peek()).not.toBe(""));
      expect([hindrance.peek(), link.waits.peek()]).toEqual(["cannot-open", waits]);
    }
  });

  it("HS1: another version, answered by loading the page once", async () => {
    const store = storage();
    const [before, after] = [setUp("/s/oak", { store }), setUp("/s/oak", { store })];
    for (const { link, newest } of [before, after]) {
      await link.start();
      newest().end(CloseCode.VersionMismatch);
    }
    expect([before.location.reload.mock.calls.length, after.location.reload.mock.calls.length]).toEqual([1, 0]);
    expect(after.hindrance.peek()).toBe("version");
  });
});
