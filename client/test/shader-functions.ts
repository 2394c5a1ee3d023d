import GLSL from "glsl-transpiler";

/** Vectors are lists of numbers. */
export type ShaderValue = number | readonly number[];

/** The functions of a shader as JavaScript, in double precision, for uniforms of these values. */
export function shaderFunctions<Functions>(
  source: string,
  names: readonly (keyof Functions & string)[],
  uniforms: Readonly<Record<string, ShaderValue>> = {},
): Functions {
  const script = GLSL({ version: "300 es", uniform: (name) => `uniforms.${name}` })(source);
  return new Function("uniforms", `${script}\nreturn { ${names.join(", ")} };`)(uniforms);
}
