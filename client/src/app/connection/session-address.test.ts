import { describe, expect, it } from "vitest";
import { pathOf, sessionInPath } from "./session-address";

describe("session address", () => {
  it("a path names its session", () => {
    expect(sessionInPath("/s/glade")).toBe("glade");
    expect(sessionInPath("/s/glade/")).toBe("glade");
    expect(sessionInPath(pathOf("a b/c"))).toBe("a b/c");
  });

  it("other paths name none", () => {
    for (const path of ["/", "/s/", "/s/a/b", "/api/v1/sessions", "/s/%E0%A4%A"]) {
      expect(sessionInPath(path), path).toBeNull();
    }
  });
});
