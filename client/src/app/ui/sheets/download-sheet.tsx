import { useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS } from "../../../wire/generated";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { usualName } from "./name-field";

const FORMATS = ["png", "glb", "json"] as const;
type Format = (typeof FORMATS)[number];

/** Pixels along the longer side of a picture for a large screen. */
const LARGE = 3840;

/** Names and gives the tree as a file: a picture of the view, a model, or its skeleton. */
export function DownloadSheet({ studio }: { studio: Studio }) {
  const [name, setName] = useState(() => studio.trees.name.peek() ?? usualName());
  const [format, setFormat] = useState<Format>("png");
  const sizes = sizesOf(studio.stage.pixels());
  const [chosen, setChosen] = useState(0);
  const size = sizes[chosen] ?? sizes[0];

  const download = (event: Event) => {
    event.preventDefault();
    // How far it is stands beside the tree, where it can be given up.
    studio.layout.sheet.value = null;
    if (format !== "png") {
      void studio.exports.file(format, name);
    } else if (size) {
      void studio.exports.png(name, size);
    }
  };

  return (
    <form class="stack" onSubmit={download}>
      <label class="field">
        <span>{say("sheets.save.name")}</span>
        <input
          type="text"
          value={name}
          maxLength={MAX_NAME_CHARACTERS}
          autocomplete="off"
          enterkeyhint="done"
          onFocus={(event) => event.currentTarget.select()}
          onInput={(event) => setName(event.currentTarget.value)}
        />
      </label>
      <fieldset class="segments stacked">
        <legend>{say("sheets.download.format")}</legend>
        {FORMATS.map((value) => (
          <label key={value}>
            <input type="radio" name="format" checked={format === value} onChange={() => setFormat(value)} />
            <span>{say(`sheets.download.${value}`)}</span>
          </label>
        ))}
      </fieldset>
      <p class="quiet">{say(`sheets.download.${format}.text`)}</p>
      {format === "png" && (
        <fieldset class="segments stacked">
          <legend>{say("sheets.download.size")}</legend>
          {sizes.map(({ width, height }, i) => (
            <label key={width}>
              <input type="radio" name="size" checked={chosen === i} onChange={() => setChosen(i)} />
              <span>
                {width} × {height}
              </span>
            </label>
          ))}
        </fieldset>
      )}
      <div class="actions">
        <button type="submit" class="primary" disabled={format === "png" && size === undefined}>
          {say("sheets.download.act")}
        </button>
      </div>
    </form>
  );
}

/** The picture as large as on the screen, twice that, and for a large screen; none where there is no picture. */
function sizesOf(pixels: { readonly width: number; readonly height: number } | null) {
  if (!pixels) {
    return [];
  }
  const { width, height } = pixels;
  const large = LARGE / Math.max(width, height);
  const scales = [1, 2, large].filter((scale, i) => i === 0 || scale > 1).sort((a, b) => a - b);
  return [...new Set(scales)].map((scale) => ({
    width: Math.round(width * scale),
    height: Math.round(height * scale),
  }));
}
