import { useEffect, useState } from "preact/hooks";
import { type ExportFormat, MAX_NAME_CHARACTERS } from "../../../wire/generated";
import { type ExportChoice, framesOf, framesOffered, moves, POINTS } from "../../library/export-choice";
import { USUAL_SIZES } from "../../library/picture-size";
import { ask } from "../../requests/request";
import { type Key, say } from "../../words/say";
import { Segments } from "../controls/segments";
import { SizeField } from "./size-field";

const LODS = ["0", "1", "2", "3", "set"] as const;
const LIGHTMAPS = ["", "512", "1024", "2048", "4096"] as const;
/** The most bones of a plant; some programs take 64, most 256. */
const BONES = ["", "64", "256", "1024"] as const;
const CLOUDS = ["100000", POINTS, "5000000", "20000000"] as const;
const CAMERAS = ["", "seen"] as const;
const SWITCHES = ["quantised", "compressed", "instanced", "hull", "by_limb", "wind_weights"] as const;
const TEXTS = ["author", "licence"] as const;

interface OptionsProps {
  readonly format: ExportFormat;
  readonly choice: ExportChoice;
  readonly choose: (part: Partial<ExportChoice>) => void;
  /** Whether the page shows the tree, so that pictures can be taken from where it looks. */
  readonly sees?: boolean;
}

/** What the format can be asked for. */
export function ExportOptions({ format, choice, choose, sees = false }: OptionsProps) {
  const has = (option: string) => format.options.includes(option);
  return (
    <>
      {has("lod") && (
        <Segments
          legend={say("exports.lod")}
          name="lod"
          values={LODS}
          chosen={choice.lod}
          text={(lod) => say(`exports.lod.${lod}` as Key)}
          onChoose={(lod) => choose({ lod })}
        />
      )}
      {has("lightmap") && (
        <Segments
          legend={say("exports.lightmap")}
          name="lightmap"
          values={LIGHTMAPS}
          chosen={choice.lightmap ?? ""}
          text={(texels) => texels || say("exports.lightmap.none")}
          onChoose={(lightmap) => choose({ lightmap })}
        />
      )}
      {has("sway") && (
        <Segments
          legend={say("exports.sway")}
          name="sway"
          values={BONES}
          chosen={choice.sway ?? ""}
          text={(bones) => bones || say("exports.sway.none")}
          onChoose={(sway) => choose({ sway })}
        />
      )}
      {has("frames") && (
        <Segments
          legend={say("exports.frames")}
          name="frames"
          values={framesOffered(format)}
          chosen={framesOf(choice, format)}
          text={(frames) => (frames === "1" ? say("exports.frames.one") : frames)}
          onChoose={(frames) => choose({ frames })}
        />
      )}
      {has("points") && (
        <Segments
          legend={say("exports.points")}
          name="points"
          values={CLOUDS}
          chosen={choice.points ?? POINTS}
          text={(points) => String(Number(points) / 1e6)}
          onChoose={(points) => choose({ points })}
        />
      )}
      {sees && has("target") && (
        <Segments
          legend={say("exports.camera")}
          name="camera"
          values={CAMERAS}
          chosen={choice.camera ?? ""}
          text={(camera) => say(camera === "seen" ? "exports.camera.seen" : "exports.camera.whole")}
          onChoose={(camera) => choose({ camera })}
        />
      )}
      {has("size") && (
        <SizeField
          usual={sees && choice.camera === "seen" ? null : (USUAL_SIZES[format.ending] ?? null)}
          chosen={choice.size ?? ""}
          onChoose={(size) => choose({ size })}
        />
      )}
      {SWITCHES.filter(has).map((option) => (
        <label key={option} class="switch">
          <input
            type="checkbox"
            disabled={option === "instanced" && moves(choice, format)}
            checked={choice.on.includes(option)}
            onChange={({ currentTarget: { checked } }) =>
              choose({ on: [...choice.on.filter((other) => other !== option), ...(checked ? [option] : [])] })
            }
          />
          <span>{say(`exports.${option}`)}</span>
        </label>
      ))}
      {TEXTS.filter(has).map((option) => (
        <label key={option} class="field">
          <span>{say(`exports.${option}`)}</span>
          <input
            type="text"
            value={choice[option]}
            maxLength={MAX_NAME_CHARACTERS}
            autocomplete="off"
            onInput={(event) => choose({ [option]: event.currentTarget.value })}
          />
        </label>
      ))}
    </>
  );
}

/** What the server said last that it writes: a sheet that is opened again need not wait for it. */
let known: readonly ExportFormat[] | undefined;

/** What the server writes: undefined until it has answered, null where it has not. */
export function useFormats() {
  const [formats, set] = useState<readonly ExportFormat[] | null | undefined>(known);
  const load = () => {
    set(known);
    ask<ExportFormat[]>("GET", "/api/v1/formats").then(
      (answer) => {
        known = answer;
        set(answer);
      },
      () => set(known ?? null),
    );
  };
  useEffect(load, []);
  return [formats, load] as const;
}
