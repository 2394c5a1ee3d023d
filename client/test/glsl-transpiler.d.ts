declare module "glsl-transpiler" {
  interface Options {
    version?: "100 es" | "300 es";
    /** What a uniform is in JavaScript. */
    uniform?: (name: string) => string;
  }
  export default function GLSL(options: Options): (source: string) => string;
}
