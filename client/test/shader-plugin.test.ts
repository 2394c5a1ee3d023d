import { describe, expect, it } from "vitest";
import { leanShader } from "../shader-plugin";

describe("shaders of the built client", () => {
  it("keep their lines and lose what only people read", () => {
    const source = `
      /** Half of it,
          and no more. */
      float half(float x) { // as said
        #ifdef WHOLE

        return x;  
        #endif
        return 0.5 * x / 1.0;
      }
    `;
    expect(leanShader(source)).toBe("\nfloat half(float x){\n#ifdef WHOLE\nreturn x;\n#endif\nreturn 0.5*x/1.0;\n}\n");
  });

  it("keep a comment that a value is put into, and the space before a value", () => {
    expect(leanShader("const float A = ")).toBe("const float A = ");
    expect(leanShader("1.0; // ")).toBe("1.0; // ");
  });
});
