import { expect, test } from "vitest";
import { theBrowser } from "./shared";

test("the browser draws with WebGL2", async () => {
  const browser = await theBrowser();
  try {
    const page = await browser.newPage();
    const pixel = await page.evaluate(() => {
      const gl = document.createElement("canvas").getContext("webgl2");
      if (!gl) return null;
      gl.clearColor(0, 0.5, 1, 1);
      gl.clear(gl.COLOR_BUFFER_BIT);
      const out = new Uint8Array(4);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, out);
      return [...out];
    });
    expect(pixel).toEqual([0, 128, 255, 255]);
  } finally {
    await browser.close();
  }
});
