import { describe, expect, it } from "vitest";
import { LiveText } from "./live-text";

const idle = { typing: false, waiting: false };

/** A text of one's own that is in force. */
function planted(text: string): LiveText {
  const live = new LiveText();
  live.type(text);
  live.send();
  live.tell(text, idle);
  return live;
}

describe("a text that several people set", () => {
  it("takes over what others set while nobody types here", () => {
    const live = planted("mine");
    expect([live.tell("theirs", idle), live.text]).toEqual(["adopt", "theirs"]);
  });

  it("keeps what is typed and not sent, and offers the other", () => {
    const live = planted("mine");
    live.type("mine, longer");
    expect(live.tell("theirs", idle)).toBe("conflict");
    expect([live.text, live.theirs]).toEqual(["mine, longer", "theirs"]);
    live.keepMine();
    expect([live.text, live.theirs, live.isAhead]).toEqual(["mine, longer", null, true]);
  });

  it("keeps what was sent while the bout of typing is not over", () => {
    const live = planted("mine");
    expect(live.tell("theirs", { typing: true, waiting: false })).toBe("conflict");
    expect(live.takeTheirs()).toBe("mine");
    expect([live.text, live.isAhead]).toEqual(["theirs", false]);
  });

  it("minds no late answers to what it sent itself", () => {
    const live = planted("a");
    live.type("ab");
    live.send();
    live.type("abc");
    live.send();
    expect(live.tell("ab", { typing: true, waiting: true })).toBe("same");
    expect(live.tell("abc", { typing: true, waiting: false })).toBe("same");
    expect([live.text, live.isAhead, live.theirs]).toEqual(["abc", false, null]);
  });

  it("follows undo back to a text of its own, in the middle of a bout as well", () => {
    const live = planted("a");
    live.type("ab");
    live.send();
    live.tell("ab", idle);
    expect([live.tell("a", { typing: true, waiting: false }), live.text]).toEqual(["adopt", "a"]);
  });

  it("keeps what was sent and refused, whenever the server tells the one before again", () => {
    for (const order of ["told", "refused"]) {
      const live = planted("a");
      live.type("too large");
      live.send();
      if (order === "refused") live.refuse("too large");
      expect([live.tell("a", idle), live.text]).toEqual(["same", "too large"]);
      live.refuse("too large");
      expect([live.tell("a", idle), live.text, live.isAhead, live.theirs]).toEqual(["same", "too large", true, null]);
      expect([live.tell("theirs", idle), live.text]).toEqual(["conflict", "too large"]);
    }
  });

  it("goes on with what a page before left", () => {
    const live = new LiveText();
    live.restore("longer", "short");
    expect([live.tell("short", idle), live.text, live.isAhead]).toEqual(["same", "longer", true]);
    expect([live.tell("theirs", idle), live.theirs]).toEqual(["conflict", "theirs"]);
  });

  it("lets a conflict go once both have the same text", () => {
    const live = planted("mine");
    live.type("mine!");
    live.tell("theirs", idle);
    live.type("theirs");
    expect([live.tell("theirs", idle), live.theirs]).toEqual(["same", null]);
  });

  it("loses nothing when another session is opened", () => {
    const live = planted("mine");
    live.type("not sent");
    live.forget();
    expect([live.tell("of that session", idle), live.text]).toEqual(["conflict", "not sent"]);
    const calm = planted("mine");
    calm.forget();
    expect([calm.tell("of that session", idle), calm.text]).toEqual(["adopt", "of that session"]);
  });
});
