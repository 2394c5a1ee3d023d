import { expect, test } from "vitest";
import { takeDrawingFaults } from "./drawing-faults";
import { SMALL } from "./screens";
import { until } from "./server";
import { theBrowser } from "./shared";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Waits for a fault, and takes all there are. */
async function faultsOf(page: { waitForTimeout(time: number): Promise<void> }): Promise<string> {
  const faults: string[] = [];
  await until("a fault is found", () => faults.push(...takeDrawingFaults()) > 0);
  await page.waitForTimeout(500);
  return [...faults, ...takeDrawingFaults()].join("\n");
}

test("a call of WebGL that is not allowed has its test fail, on any page of the browser", async () => {
  const browser = await theBrowser();
  const page = await (await browser.newContext()).newPage();
  await page.evaluate(() => {
    const gl = document.createElement("canvas").getContext("webgl2")!;
    gl.useProgram(gl.createProgram());
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  });
  expect(await faultsOf(page)).toMatch(/INVALID_OPERATION/);
  await browser.close();
});

test("a shader that does not compile has its test fail", async () => {
  const { tablet } = await workshop.fresh({ ...SMALL, watched: true });
  await tablet.page.addInitScript(() => {
    const { prototype } = WebGL2RenderingContext;
    const { shaderSource } = prototype;
    prototype.shaderSource = function (shader, text) {
      const isLight = this.getShaderParameter(shader, this.SHADER_TYPE) === this.FRAGMENT_SHADER;
      shaderSource.call(this, shader, isLight ? `${text}\nthis is no shader` : text);
    };
  });
  takeDrawingFaults();
  await tablet.page.reload();
  expect(await faultsOf(tablet.page)).toMatch(/WebGL/);
  // It goes on drawing until it is closed.
  await tablet.close();
  takeDrawingFaults();
});
