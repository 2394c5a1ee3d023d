/** Texts of the parts that are loaded later, in one language; made by `words-plugin.ts`. */
declare module "virtual:later-words/*" {
  const texts: Readonly<Record<string, string>>;
  export default texts;
}
