import { describe, expect, it } from "vitest";
import type { ListedToken } from "../../wire/generated";
import { RequestFailed } from "../requests/request";
import { Programs } from "./programs";
import { suggestedPassword } from "./suggested-password";

function desk() {
  const tokens: ListedToken[] = [{ id: "other", name: "Backup", role: "viewer", of: "Bo", since: "", until: "" }];
  const failures: unknown[] = [];
  let refusal: Error | null = null;
  const programs = new Programs({
    api: {
      listTokens: async (whose) => tokens.filter(({ of }) => whose === "all" || of === "Ada"),
      makeToken: async ({ name, role }) => {
        if (refusal) {
          throw refusal;
        }
        const id = `t${tokens.length}`;
        tokens.unshift({ id, name, role, of: "Ada", since: "", until: "" });
        return { id, token: "esp_secret" };
      },
      revokeToken: async (id) => {
        const at = tokens.findIndex((token) => token.id === id);
        if (at < 0) {
          throw new RequestFailed(404, { code: "not_found", message: "gone" });
        }
        tokens.splice(at, 1);
      },
    },
    failed: (error) => failures.push(error),
  });
  return { programs, tokens, failures, refuse: (error: Error) => (refusal = error) };
}

describe("programs that act as somebody", () => {
  it("AC21: a token is known while it is shown, and goes when it is revoked", async () => {
    const { programs, failures } = desk();
    expect(await programs.make({ name: "Farm", role: "viewer" })).toBe(true);
    expect(programs.fresh.value).toEqual({ id: "t1", token: "esp_secret", name: "Farm" });
    expect(programs.list.value?.map(({ name }) => name)).toEqual(["Farm"]);
    await programs.revoke("t1");
    expect([programs.fresh.value, programs.list.value]).toEqual([null, []]);
    // By somebody else, in another place.
    await programs.revoke("t1");
    expect(failures).toEqual([]);
  });

  it("AC21: everybody's are listed where that is asked, and not those of before meanwhile", async () => {
    const { programs } = desk();
    await programs.look();
    expect(programs.list.value).toEqual([]);
    const looking = programs.look("all");
    expect(programs.list.value).toBeNull();
    await looking;
    expect(programs.list.value?.map(({ name }) => name)).toEqual(["Backup"]);
  });

  it("a token that is refused is none", async () => {
    const { programs, failures, refuse } = desk();
    refuse(new RequestFailed(403, { code: "refused", message: "no" }));
    expect(await programs.make({ name: "Farm", role: "editor" })).toBe(false);
    expect([programs.fresh.value, failures.length, programs.making.value]).toEqual([null, 1, false]);
  });
});

describe("a suggested password", () => {
  it("has 16 letters and digits in parts, each value of a byte as likely", () => {
    expect(suggestedPassword(new Uint8Array(16).fill(0))).toBe("aaaa-aaaa-aaaa-aaaa");
    expect(suggestedPassword(new Uint8Array(16).map((_, i) => 31 + 32 * (i % 8)))).toBe("9999-9999-9999-9999");
    expect(suggestedPassword()).toMatch(/^[a-z2-9]{4}(-[a-z2-9]{4}){3}$/);
    expect(suggestedPassword()).not.toBe(suggestedPassword());
  });
});
