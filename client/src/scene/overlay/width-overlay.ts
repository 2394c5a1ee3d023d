import { radiusOf, type TreeTable } from "../table/tree-table";
import { INHERIT, type Overlay, type SlotAssignment, type SlotWriter } from "./overlays";

/** What wood is made of, as far as its width goes. */
export interface Girth {
  /** n of d^n = Σ d_i^n. */
  readonly exponent: number;
  /** Of a twig's tip, in internodes. */
  readonly twigDiameter: number;
}

const BRANCH = 0;
const LIMB = 1;
const ABOVE_OTHERS = 2;
const FIRST_BELOW = 3;

/**
 * A limb that is made thicker or slimmer, as it will be if no further width is set: above it every radius becomes
 * r_e (r / r_e)^p, so that twigs stay what they are; below it r^n grows by what the limb's own has grown. The server
 * finds the same radii, which `server/plant/golden/widths.json` holds; where its exponent would leave 1 to 8
 * (`server/plant/src/widths/fit.rs`) the preview only comes near.
 */
export class WidthOverlay implements Overlay {
  readonly slots: number;
  private below: number[] = [];
  /** `others` are the rows whose widths are set as well: nothing changes beyond them. */
  constructor(
    table: TreeTable,
    readonly row: number,
    private readonly others: ReadonlySet<number>,
    private readonly girth: Girth,
    public diameter: number,
  ) {
    for (let at = table.parent[row]!; at >= 0 && table.parent[at]! >= 0 && !others.has(at); at = table.parent[at]!) {
      this.below.push(at);
    }
    this.slots = FIRST_BELOW + this.below.length;
  }

  *assignments(): Iterable<SlotAssignment> {
    yield { row: this.row, slot: LIMB, own: true, above: BRANCH };
    for (const [i, row] of this.below.entries()) yield { row, slot: FIRST_BELOW + i, own: true, above: INHERIT };
    for (const row of this.others) {
      // What lies above another set width is not reached by this one.
      if (row > this.row) yield { row, slot: ABOVE_OTHERS, own: false, above: ABOVE_OTHERS };
    }
  }

  write(table: TreeTable, out: SlotWriter): void {
    const tip = this.girth.twigDiameter / 2;
    const { radius: drawn } = table.girth;
    const [before, after] = [radiusOf(table.radiusCode[this.row]!), this.diameter / 2];
    const exponent = swelling(before / tip, after / tip);
    out.plain(BRANCH);
    out.swelling(BRANCH, exponent, tip ** (1 - exponent));
    out.plain(LIMB);
    out.orientation(LIMB, table.orientations, this.row);
    // A limb that leaves a thick one is drawn a little thicker than it is.
    out.radius(LIMB, after * (drawn[this.row]! / Math.max(before, 1e-6)));
    out.plain(ABOVE_OTHERS);
    const n = this.girth.exponent;
    for (const [i, row] of this.below.entries()) {
      out.plain(FIRST_BELOW + i);
      out.orientation(FIRST_BELOW + i, table.orientations, row);
      out.radius(FIRST_BELOW + i, borne(drawn[row]!, before, after, n));
    }
  }

  over(table: TreeTable): boolean {
    return this.row >= table.rows || table.radiusCode[this.row] === 0;
  }
}

/** The exponent that takes one radius to another, both in radii of a twig's tip; 1 where there is nothing to tell from. */
export function swelling(before: number, after: number): number {
  if (before < 1.02) return 1;
  return Math.max(0.02, Math.log(Math.max(after, 1)) / Math.log(before));
}

/** The radius of wood that bears a limb when the limb's own goes from one to another. */
export function borne(radius: number, before: number, after: number, exponent: number): number {
  const power = radius ** exponent + after ** exponent - before ** exponent;
  return Math.max(power, (0.05 * radius) ** exponent) ** (1 / exponent);
}
