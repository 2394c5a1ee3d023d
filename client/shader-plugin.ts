import { type ESTree, type Plugin, Visitor } from "vite";

/** Takes comments, indentation, empty lines and needless spaces out of shaders: texts of many lines in `src/scene` are nothing else. */
export function leanShaders(): Plugin {
  return {
    name: "espalier-lean-shaders",
    apply: "build",
    transform(code, id) {
      if (!/[\\/]src[\\/]scene[\\/]/.test(id) || !code.includes("`")) {
        return null;
      }
      const texts: ESTree.TemplateElement[] = [];
      new Visitor({
        TemplateLiteral({ quasis }) {
          if (quasis.some(({ value }) => value.raw.includes("\n"))) {
            texts.push(...quasis);
          }
        },
      }).visit(this.parse(code));
      const shortened = texts.reduceRight(
        (rest, { start, end, value }) => rest.slice(0, start) + leanShader(value.raw) + rest.slice(end),
        code,
      );
      return { code: shortened, map: null };
    },
  };
}

/** A part of a shader, between values that are put in, without what only people read. */
export function leanShader(text: string): string {
  return (
    text
      .replace(/\/\*.*?\*\//gs, "")
      // A comment that goes on behind a value that is put in stays.
      .replace(/\/\/.*(?=\n)/g, "")
      .replace(/[ \t]+(?=\n)/g, "")
      .replace(/\n\s+/g, "\n")
      // A preprocessor's lines need their spaces.
      .replace(/\n(?!#).*/g, (line) => line.replace(/ ?([=*/,;<>{}()?:]) ?/g, "$1"))
  );
}
