import { useEffect, useMemo, useState } from "preact/hooks";
import {
  DEFAULT_APPEARANCE,
  DEFAULT_PARAMETERS,
  type ExportFormat,
  MAX_NAME_CHARACTERS,
  type SavedTree,
} from "../../../wire/generated";
import { cameraOptions } from "../../library/export-camera";
import { type ExportChoice, optionsOf, PICTURE } from "../../library/export-choice";
import { amountOf, bytesExpected } from "../../library/export-size";
import { isDrawn, MOST_DRAWN, pixelsDrawn } from "../../library/picture-size";
import type { Studio } from "../../studio";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";
import { Segments } from "../controls/segments";
import { isWorthShowing } from "../timeline/has-timeline";
import { ExportOptions, useFormats } from "./export-options";
import { BackBar } from "./library/back-bar";
import { usualName } from "./name-field";

/** Pixels along the longer side of a picture for a large screen. */
const LARGE = 3840;

/** Names and gives the tree on the page, or one of the library, as a file. */
export function DownloadSheet({ studio }: { studio: Studio }) {
  const { taken } = studio.layout;
  const tree = taken.value;
  useEffect(
    () => () => {
      taken.value = null;
    },
    [taken],
  );
  return tree === null ? <OnPage studio={studio} /> : <OfLibrary studio={studio} tree={tree} />;
}

/** A tree of the library, without opening it: what the server writes. */
function OfLibrary({ studio, tree }: { studio: Studio; tree: SavedTree }) {
  const [name, setName] = useState(tree.name);
  const [formats, askAgain] = useFormats();
  const choice = studio.settings.exportChoice.value;
  const choose = (part: Partial<ExportChoice>) => {
    studio.settings.exportChoice.value = { ...choice, ...part };
  };
  const format = formats?.find(({ ending }) => ending === choice.format) ?? formats?.[0];
  const download = (event: Event) => {
    event.preventDefault();
    if (format) {
      // How far it is stands beside the tree, where it can be given up.
      studio.layout.sheet.value = null;
      void studio.exports.file(format.ending, name, optionsOf(choice, format), tree);
    }
  };
  return (
    <form class="stack" onSubmit={download}>
      <BackBar studio={studio} title={tree.name} />
      <Named name={name} onName={setName} />
      {formats && format && (
        <>
          <Segments
            legend={say("sheets.download.format")}
            name="format"
            values={formats.map(({ ending }) => ending)}
            chosen={format.ending}
            text={(ending) => say(formats.find((format) => format.ending === ending)?.label ?? "exports.picture")}
            onChoose={(format) => choose({ format })}
          />
          <p class="quiet">{say(format.text)}</p>
          <ExportOptions format={format} choice={choice} choose={choose} />
          <TooMuch format={format} options={optionsOf(choice, format)} />
        </>
      )}
      {formats === undefined && <p class="quiet">{say("exports.asking")}</p>}
      {formats === null && <Lost askAgain={askAgain} />}
      <div class="actions">
        <button
          type="submit"
          class="primary"
          disabled={format === undefined || !isDrawn(format, optionsOf(choice, format))}
        >
          {say("sheets.download.act")}
        </button>
      </div>
    </form>
  );
}

interface TooMuchProps {
  readonly format: ExportFormat;
  readonly options: ReadonlyMap<string, string>;
}

/** Why the server would not make pictures of so many pixels. */
function TooMuch({ format, options }: TooMuchProps) {
  const millions = (pixels: number) => numberText(pixels / 1e6, 1);
  return isDrawn(format, options) ? null : (
    <p role="alert">
      {say("exports.size.too-much", { count: millions(pixelsDrawn(format, options)), most: millions(MOST_DRAWN) })}
    </p>
  );
}

interface NamedProps {
  readonly name: string;
  readonly onName: (name: string) => void;
}

/** What the file is called. */
function Named({ name, onName }: NamedProps) {
  return (
    <label class="field">
      <span>{say("sheets.save.name")}</span>
      <input
        type="text"
        value={name}
        maxLength={MAX_NAME_CHARACTERS}
        autocomplete="off"
        enterkeyhint="done"
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => onName(event.currentTarget.value)}
      />
    </label>
  );
}

/** The server does not say what it writes. */
function Lost({ askAgain }: { readonly askAgain: () => void }) {
  return (
    <p class="quiet">
      {say("exports.lost")}{" "}
      <button type="button" onClick={askAgain}>
        {say("exports.again")}
      </button>
    </p>
  );
}

/** The tree on the page: a picture of the view, or what the server writes. */
function OnPage({ studio }: { studio: Studio }) {
  // What the tree is called may be known later than the sheet is opened; what somebody has typed stays.
  const [typed, setName] = useState<string | null>(null);
  const [usual] = useState(() => usualName(studio));
  const name = typed ?? studio.trees.name.value ?? usual;
  const [formats, askAgain] = useFormats();
  const choice = studio.settings.exportChoice.value;
  const choose = (part: Partial<ExportChoice>) => {
    studio.settings.exportChoice.value = { ...choice, ...part };
  };
  const format = formats?.find(({ ending }) => ending === choice.format);
  // Whether the server writes what was chosen last is not known yet; nothing else is shown as chosen meanwhile.
  const awaited = formats === undefined && choice.format !== PICTURE;
  const screen = studio.stage.pixels();
  const options = format && optionsOf(choice, format, viewOf(studio, screen));
  const sizes = sizesOf(screen);
  const [chosen, setChosen] = useState(0);
  const size = sizes[chosen] ?? sizes[0];
  const amount = useMemo(() => amountOf(studio.table, studio.appearance.peek() ?? DEFAULT_APPEARANCE), [studio]);

  const download = (event: Event) => {
    event.preventDefault();
    // How far it is stands beside the tree, where it can be given up.
    studio.layout.sheet.value = null;
    if (format && options) {
      void studio.exports.file(format.ending, name, options);
    } else if (size) {
      void studio.exports.png(name, size);
    }
  };

  const replay = () => {
    studio.layout.sheet.value = null;
    studio.link.replay(true);
  };

  return (
    <form class="stack" onSubmit={download}>
      <Named name={name} onName={setName} />
      <Segments
        legend={say("sheets.download.format")}
        name="format"
        values={[PICTURE, ...(formats ?? []).map(({ ending }) => ending)]}
        chosen={format || awaited ? choice.format : PICTURE}
        text={(ending) => say(formats?.find((format) => format.ending === ending)?.label ?? "exports.picture")}
        onChoose={(format) => choose({ format })}
      />
      <p class="quiet">{say(awaited ? "exports.asking" : (format?.text ?? "exports.picture.text"))}</p>
      {formats === null && <Lost askAgain={askAgain} />}
      {format ? (
        <>
          <ExportOptions format={format} choice={choice} choose={choose} sees={screen !== null} />
          {options && <TooMuch format={format} options={options} />}
        </>
      ) : (
        !awaited && (
          <Segments
            legend={say("sheets.download.size")}
            name="size"
            values={sizes.map((_, i) => String(i))}
            chosen={String(chosen)}
            text={(i) => `${sizes[Number(i)]?.width} × ${sizes[Number(i)]?.height}`}
            onChoose={(i) => setChosen(Number(i))}
          />
        )
      )}
      <div class="actions">
        {format && options && (
          <p class="quiet">
            {say("exports.about", {
              megabytes: numberText(Math.max(0.1, bytesExpected(format, options, amount) / 1e6), 0.1),
            })}
          </p>
        )}
        <button
          type="submit"
          class="primary"
          disabled={format && options ? !isDrawn(format, options) : awaited || size === undefined}
        >
          {say("sheets.download.act")}
        </button>
      </div>
      {isWorthShowing(studio.time.timeline.value) && (
        <div class="actions">
          <button type="button" class="small" onClick={replay}>
            {say("replay.from-download")}
          </button>
        </div>
      )}
    </form>
  );
}

interface Pixels {
  readonly width: number;
  readonly height: number;
}

/** The camera of the page for a picture that the server makes; none where the page shows nothing. */
function viewOf(studio: Studio, screen: Pixels | null) {
  const camera = studio.stage.view?.camera;
  const { internode_length: metres } = studio.parameters.peek() ?? DEFAULT_PARAMETERS;
  return camera && screen && cameraOptions(camera.rig.view, screen, metres);
}

/** The picture as large as on the screen, twice that, and for a large screen; none where there is no picture. */
function sizesOf(pixels: Pixels | null) {
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
