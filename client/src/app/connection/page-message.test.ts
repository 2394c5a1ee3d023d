import { describe, expect, it, vi } from "vitest";
import { handle, type MessageHandlers, type PageMessage } from "./page-message";

function setUp() {
  const other = vi.fn();
  const widths = vi.fn();
  const handlers = { state: other, widths } as unknown as MessageHandlers;
  return { handlers, other, widths };
}

describe("messages for the page", () => {
  it("each goes to the handler of its type", () => {
    const { handlers, other, widths } = setUp();
    const message: PageMessage = { type: "widths", widths: [] };
    handle(handlers, message);
    expect(widths.mock.calls).toEqual([[message]]);
    expect(other).not.toHaveBeenCalled();
  });

  it("one of a type that is not known changes nothing", () => {
    const { handlers, other, widths } = setUp();
    for (const type of ["weather", "toString"]) {
      handle(handlers, { type } as unknown as PageMessage);
    }
    expect([other.mock.calls, widths.mock.calls]).toEqual([[], []]);
  });
});
