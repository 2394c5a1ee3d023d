import { parseAst } from "vite";
import { describe, expect, it } from "vitest";
import { leanModule } from "../three-plugin";

const lean = (code: string) => leanModule(code, parseAst(code));

describe("three.js of the built client", () => {
  it("asks nothing that is known when the client is built", () => {
    const code = "const a = object.isSkinnedMesh === true ? b.isVideoTexture : material.isRawShaderMaterial;";
    expect(lean(code).lean).toBe("const a = false === true ? false : true;");
  });

  it("asks materials for nothing that only other materials have, and others for everything", () => {
    expect(lean("f(material.envMap, scene.envMap, material.alphaTest);").lean).toBe(
      "f(false, scene.envMap, material.alphaTest);",
    );
  });

  it("names what would make something known untrue, and keeps it", () => {
    const { lean: kept, makes } = lean("this.isSprite = true; this.isVideoTexture = false;");
    expect(kept).toBe("this.isSprite = true; this.isVideoTexture = false;");
    expect(makes).toEqual(["isSprite"]);
  });

  it("leaves methods and the bodies of idle functions out", () => {
    const code =
      "class A { lerp() { return a.isSprite; } add() { return 1; } } function uploadCubeTexture(t) { t.isLOD; }";
    expect(lean(code).lean).toBe("class A {  add() { return 1; } } function uploadCubeTexture(t) {}");
  });

  it("changes what lies in another change once", () => {
    expect(lean("object.isMesh.isLine.isPoints;").lean).toBe("false;");
  });
});
