import { useState } from "preact/hooks";
import {
  type ChangedSize,
  MOST_PIXELS,
  PICTURE_SIZES,
  type PictureSize,
  sizeIn,
  sizeText,
  withSide,
} from "../../library/picture-size";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";
import { Segments } from "../controls/segments";
import { TypedNumber } from "../controls/typed-number";

interface SizeFieldProps {
  /** How large pictures are where nothing else is chosen; null where that is as the page shows it. */
  readonly usual: PictureSize | null;
  /** What is chosen, as options have it; empty for the usual size. */
  readonly chosen: string;
  readonly onChoose: (size: string) => void;
}

/** How many pixels a picture of the server's has across and down: the usual ones, those of screens, or others. */
export function SizeField({ usual, chosen, onChoose }: SizeFieldProps) {
  const offered: readonly string[] = ["", ...PICTURE_SIZES];
  const [asksOwn, setAsksOwn] = useState(false);
  const isOwn = asksOwn || !offered.includes(chosen);
  const size = sizeIn(chosen) ?? usual ?? { width: 1000, height: 1000 };
  /** What was typed and is not possible; null where it is as it was typed. */
  const [kept, setKept] = useState<ChangedSize["kept"]>(null);
  const set = (side: "width" | "height") => (pixels: number) => {
    const changed = withSide(size, side, pixels);
    setKept(changed.kept);
    onChoose(sizeText(changed.size));
  };
  return (
    <>
      <Segments
        legend={say("sheets.download.size")}
        name="picture-size"
        values={[...offered, "own"]}
        chosen={isOwn ? "own" : chosen}
        text={(one) => textOf(one, usual)}
        onChoose={(one) => {
          setAsksOwn(one === "own");
          setKept(null);
          onChoose(one === "own" ? sizeText(size) : one);
        }}
      />
      {isOwn && (
        <div class="own-size">
          {(["width", "height"] as const).map((side) => (
            <div key={side} class="field">
              <span aria-hidden="true">{say(`exports.size.${side}`)}</span>
              <TypedNumber
                label={say(`exports.size.${side}`)}
                unit=""
                // What lies beyond the limits is cut, and said, here.
                least={1}
                most={MOST_PIXELS}
                step={1}
                staysOnEnter
                value={size[side]}
                onCommit={set(side)}
              />
            </div>
          ))}
        </div>
      )}
      {isOwn && kept !== null && (
        <p class="quiet" role="status">
          {say(`exports.size.${kept.to}`, {
            pixels: numberText(kept.pixels, 1),
            all: numberText(MOST_PIXELS / 1_000_000, 1),
          })}
        </p>
      )}
    </>
  );
}

function textOf(one: string, usual: PictureSize | null): string {
  if (one === "own") {
    return say("exports.size.own");
  }
  const size = one === "" ? usual : sizeIn(one);
  return size ? `${size.width} × ${size.height}` : say("exports.size.seen");
}
