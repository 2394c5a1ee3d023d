import { inflateSync } from "node:zlib";

/** Something on a page, in points from its lower left corner. */
export interface Area {
  readonly left: number;
  readonly right: number;
  readonly bottom: number;
  readonly top: number;
}

/** A page as a printer gets it. */
export interface PrintedPage {
  readonly size: Area;
  /** Its letters in the order in which they are drawn, without blanks. */
  readonly text: string;
  /** The pictures that are drawn on it. */
  readonly pictures: readonly Area[];
  /** Letters and pictures of which something lies outside the page, or outside of what cuts off what is drawn there. */
  readonly cut: readonly string[];
}

type Matrix = readonly [a: number, b: number, c: number, d: number, e: number, f: number];

interface Font {
  readonly letters: ReadonlyMap<number, string>;
  /** In thousandths of its size. */
  readonly widths: ReadonlyMap<number, number>;
}

const IDENTITY: Matrix = [1, 0, 0, 1, 0, 0];
/** So far apart places may be that are the same, in points. */
const NEAR = 1;

/** The pages of a PDF file as Chromium writes it: objects one after the other, letters by numbers of two bytes. */
export function printedPages(file: Buffer): PrintedPage[] {
  const objects = objectsOf(file);
  const of = (number: string | undefined) => objects.get(Number(number)) ?? { head: "", stream: "" };
  const pages = /\/Kids \[([^\]]*)\]/g;
  const kids = [...objects.values()].flatMap(({ head }) => [...head.matchAll(pages)].map(([, all]) => all ?? ""));
  return kids
    .flatMap((all) => [...all.matchAll(/(\d+) 0 R/g)])
    .map(([, number]) => of(number).head)
    .filter((head) => /\/Type \/Page\b/.test(head))
    .map((head) => {
      const fonts = new Map<string, Font>();
      for (const [, name, number] of named(head, "Font")) {
        const font = of(number).head;
        const unicode = /\/ToUnicode (\d+) 0 R/.exec(font)?.[1];
        const below = of(/\/DescendantFonts \[(\d+) 0 R\]/.exec(font)?.[1]).head;
        fonts.set(name!, { letters: lettersOf(of(unicode).stream), widths: widthsOf(below) });
      }
      const isPicture = new Map(
        named(head, "XObject").map(([, name, number]) => [name!, of(number).head.includes("/Subtype /Image")]),
      );
      const [left = 0, bottom = 0, right = 0, top = 0] = numbers(/\/MediaBox \[([^\]]*)\]/.exec(head)?.[1] ?? "");
      const drawing = of(/\/Contents (\d+) 0 R/.exec(head)?.[1]).stream;
      return drawn(drawing, { left, bottom, right, top }, fonts, isPicture);
    });
}

/** What stands in a dictionary of a page's resources, by its name. */
function named(head: string, kind: string): RegExpMatchArray[] {
  const all = new RegExp(`/${kind} <<([^>]*)>>`).exec(head)?.[1] ?? "";
  return [...all.matchAll(/\/(\w+) (\d+) 0 R/g)];
}

function objectsOf(file: Buffer): Map<number, { readonly head: string; readonly stream: string }> {
  const objects = new Map<number, { head: string; stream: string }>();
  const text = file.toString("latin1");
  const begin = /(\d+) 0 obj\n/g;
  for (let found = begin.exec(text); found !== null; found = begin.exec(text)) {
    const [from, end] = [begin.lastIndex, text.indexOf("endobj", begin.lastIndex)];
    const data = text.indexOf("stream\n", from);
    const hasStream = data >= 0 && data < end;
    const head = text.slice(from, hasStream ? data : end);
    const length = Number(/\/Length (\d+)/.exec(head)?.[1] ?? 0);
    const at = data + "stream\n".length;
    const isText = hasStream && !/\/Image|\/Length1/.test(head);
    const bytes = isText ? file.subarray(at, at + length) : Buffer.alloc(0);
    const stream = isText && head.includes("/FlateDecode") ? inflateSync(bytes) : bytes;
    objects.set(Number(found[1]), { head, stream: stream.toString("latin1") });
    // What is in the data may look like an object.
    begin.lastIndex = hasStream ? at + length : end;
  }
  return objects;
}

/** What the glyphs of a font mean. */
function lettersOf(map: string): Map<number, string> {
  const letters = new Map<number, string>();
  const hex = (text: string) => Number.parseInt(text, 16);
  const word = (text: string) => Buffer.from(text, "hex").swap16().toString("utf16le").normalize("NFKC");
  for (const [, lines] of map.matchAll(/beginbfchar\n([\s\S]*?)endbfchar/g)) {
    for (const [, glyph, text] of lines!.matchAll(/<(\w+)> <(\w+)>/g)) letters.set(hex(glyph!), word(text!));
  }
  for (const [, lines] of map.matchAll(/beginbfrange\n([\s\S]*?)endbfrange/g)) {
    for (const [, first, last, text] of lines!.matchAll(/<(\w+)> <(\w+)> <(\w+)>/g)) {
      for (let glyph = hex(first!); glyph <= hex(last!); glyph += 1) {
        const code = (hex(text!) + glyph - hex(first!)).toString(16).padStart(4, "0");
        letters.set(glyph, word(code));
      }
    }
  }
  return letters;
}

function widthsOf(font: string): Map<number, number> {
  const widths = new Map<number, number>();
  const all = font.slice(font.indexOf("/W [") + 4);
  for (const [, first, list] of all.matchAll(/(\d+) \[([^\]]*)\]/g)) {
    for (const [i, width] of numbers(list!).entries()) widths.set(Number(first) + i, width);
  }
  return widths;
}

function numbers(text: string): number[] {
  return text.trim().split(/\s+/).map(Number);
}

/** Does what the commands of a page say, as far as letters, pictures, and what cuts them off are concerned. */
function drawn(
  commands: string,
  size: Area,
  fonts: ReadonlyMap<string, Font>,
  isPicture: ReadonlyMap<string, boolean>,
): PrintedPage {
  let [ctm, clip, path] = [IDENTITY, size, null as Area | null];
  const kept: [Matrix, Area][] = [];
  let [line, at, font, height] = [IDENTITY, IDENTITY, undefined as Font | undefined, 0];
  let text = "";
  const [pictures, cut]: [Area[], string[]] = [[], []];
  const put = (what: string, area: Area) => {
    if (!isWithin(area, clip)) cut.push(`${what} at ${JSON.stringify(area)} in ${JSON.stringify(clip)}`);
  };
  const point = (x: number, y: number) => {
    path = around(path, boxOf(ctm, x, y, x, y));
  };
  let operands: string[] = [];
  for (const [word] of commands.matchAll(/<<(?:[^>]|>(?!>))*>>|<[\dA-F]*>|\((?:\\.|[^\\)])*\)|\[[^\]]*\]|[^\s<([]+/g)) {
    if (/^[<([/\d.+-]/.test(word)) {
      operands.push(word);
      continue;
    }
    const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0] = operands.map(Number);
    if (word === "q") kept.push([ctm, clip]);
    else if (word === "Q") [ctm, clip] = kept.pop() ?? [ctm, clip];
    else if (word === "cm") ctm = times([a, b, c, d, e, f], ctm);
    else if (word === "re") path = around(path, boxOf(ctm, a, b, a + c, b + d));
    else if (word === "m" || word === "l") point(a, b);
    else if (word === "c")
      for (const [x, y] of [
        [a, b],
        [c, d],
        [e, f],
      ] as const)
        point(x, y);
    else if ((word === "W" || word === "W*") && path !== null) clip = common(clip, path);
    else if (/^(n|f|F|f\*|S|s|B|b|B\*|b\*)$/.test(word)) path = null;
    else if (word === "BT") [line, at] = [IDENTITY, IDENTITY];
    else if (word === "Tm") line = at = [a, b, c, d, e, f];
    else if (word === "Td") line = at = times([1, 0, 0, 1, a, b], line);
    else if (word === "Tf") [font, height] = [fonts.get(operands[0]!.slice(1)), Number(operands[1])];
    else if (word === "Tj") {
      for (const [glyph] of operands[0]!.matchAll(/[\dA-F]{4}/g)) {
        const number = Number.parseInt(glyph, 16);
        const letter = font?.letters.get(number) ?? `glyph ${number}`;
        const width = ((font?.widths.get(number) ?? 0) * height) / 1000;
        text += letter;
        if (letter.trim() !== "") put(letter, boxOf(times(at, ctm), 0, 0, width, 0.7 * height));
        at = times([1, 0, 0, 1, width, 0], at);
      }
    } else if (word === "Do" && isPicture.get(operands[0]!.slice(1)) === true) {
      const area = boxOf(ctm, 0, 0, 1, 1);
      pictures.push(area);
      put("a picture", area);
    }
    operands = [];
  }
  return { size, text: text.replace(/\s/g, ""), pictures, cut };
}

/** One after the other. */
function times([a, b, c, d, e, f]: Matrix, [A, B, C, D, E, F]: Matrix): Matrix {
  return [a * A + b * C, a * B + b * D, c * A + d * C, c * B + d * D, e * A + f * C + E, e * B + f * D + F];
}

function boxOf([a, b, c, d, e, f]: Matrix, x0: number, y0: number, x1: number, y1: number): Area {
  const corners = [
    [x0, y0],
    [x1, y0],
    [x0, y1],
    [x1, y1],
  ] as const;
  const xs = corners.map(([x, y]) => a * x + c * y + e);
  const ys = corners.map(([x, y]) => b * x + d * y + f);
  return { left: Math.min(...xs), right: Math.max(...xs), bottom: Math.min(...ys), top: Math.max(...ys) };
}

function around(one: Area | null, other: Area): Area {
  if (one === null) return other;
  return {
    left: Math.min(one.left, other.left),
    right: Math.max(one.right, other.right),
    bottom: Math.min(one.bottom, other.bottom),
    top: Math.max(one.top, other.top),
  };
}

function common(one: Area, other: Area): Area {
  return {
    left: Math.max(one.left, other.left),
    right: Math.min(one.right, other.right),
    bottom: Math.max(one.bottom, other.bottom),
    top: Math.min(one.top, other.top),
  };
}

function isWithin({ left, right, bottom, top }: Area, whole: Area): boolean {
  return (
    left >= whole.left - NEAR && right <= whole.right + NEAR && bottom >= whole.bottom - NEAR && top <= whole.top + NEAR
  );
}
